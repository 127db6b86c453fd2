// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { fill, h } from '../dom';
import { attributeRow, type AttributeRow } from './attribute_row';
import type { PlotList } from './plots';
import { openSwap } from './swap';
import { isComponent, type Chosen, type Selection } from './tree';

// The attributes of what is chosen in the tree.
export function inspector(app: App, selection: Selection, plots: PlotList): HTMLElement {
  const box = h('div', { className: 'inspector' });
  const rows = new Map<string, AttributeRow>();
  const build = (chosen: Chosen | null): void => {
    rows.clear();
    if (!chosen) {
      fill(
        box,
        h(
          'p',
          { className: 'muted' },
          'Choose a component above to see and change its attributes.',
        ),
      );
      return;
    }
    const inputs = chosen.attributes.filter((attribute) => !attribute.output);
    const outputs = chosen.attributes.filter((attribute) => attribute.output);
    // what can be changed at once comes first
    inputs.sort(
      (a, b) => Number(!!b.runtime) - Number(!!a.runtime) || Number(!!b.isSet) - Number(!!a.isSet),
    );
    const make = (attribute: Chosen['attributes'][0]): HTMLElement => {
      const row = attributeRow(app, chosen.path, attribute, plots);
      rows.set(`${chosen.path}.${attribute.name}`, row);
      return row.element;
    };
    fill(
      box,
      header(app, chosen),
      ...inputs.map(make),
      outputs.length > 0 && h('h3', {}, 'Outputs'),
      ...outputs.map(make),
    );
    refreshOutputs();
  };
  const refreshOutputs = (): void => {
    const values = app.model.status?.values ?? {};
    for (const [path, row] of rows) {
      const value = values[path];
      if (value !== undefined) row.showNumber(value);
    }
  };
  selection.on('changed', build);
  app.model.on('attributes', ({ values }) => {
    for (const [path, text] of Object.entries(values)) rows.get(path)?.showText(text);
  });
  app.model.on('status', refreshOutputs);
  app.model.on('hello', () => build(selection.chosen));
  build(null);
  return box;
}

function header(app: App, chosen: Chosen): HTMLElement {
  const box = h('div', { className: 'inspector-head' }, h('h2', {}, chosen.name));
  if (!isComponent(chosen)) {
    box.append(h('p', { className: 'muted' }, 'Node'));
    return box;
  }
  const place = chosen.file
    ? `${chosen.file.split('/').pop()}${chosen.line ? `:${chosen.line}` : ''}`
    : '';
  box.append(
    h(
      'p',
      { className: 'muted' },
      chosen.type,
      place && h('span', { title: chosen.file ?? '' }, ` · ${place}`),
    ),
  );
  if (chosen.doc) box.append(h('p', { className: 'doc' }, chosen.doc));
  if (chosen.swappable) {
    box.append(
      h(
        'button',
        {
          className: 'swap',
          disabled: !app.model.steers,
          onclick: () => void openSwap(app, chosen),
          title: 'Another component in its place, in the running scene',
        },
        'Swap…',
      ),
    );
  }
  return box;
}
