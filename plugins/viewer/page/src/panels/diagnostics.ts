// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { fill, h, iconButton, setText } from '../dom';
import type { Diagnostic } from '../protocol';

// Problems of the scene file, with their place and the line they are in.
export function diagnostics(app: App): {
  sheet: HTMLElement;
  badge: HTMLElement;
  banner: HTMLElement;
} {
  const list = h('div', { className: 'diagnostic-list' });
  const sheet = h(
    'div',
    { className: 'sheet diagnostics', hidden: true, id: 'diagnostics' },
    h(
      'div',
      { className: 'sheet-head' },
      h('h2', {}, 'Diagnostics'),
      iconButton('close', 'Close (D)', () => {
        sheet.hidden = true;
      }),
    ),
    list,
  );
  const badge = h('button', {
    className: 'quiet badge-button',
    title: 'Diagnostics (D)',
    onclick: () => {
      sheet.hidden = !sheet.hidden;
    },
  });
  const banner = h(
    'div',
    { className: 'banner', hidden: true, id: 'broken', aria: { role: 'alert' } },
    h(
      'span',
      {},
      h('strong', {}, 'The scene has an error.'),
      ' The last good scene keeps running.',
    ),
    iconButton('close', 'Hide', () => {
      banner.hidden = true;
    }),
  );

  const refresh = (): void => {
    const { items, broken } = app.model.diagnostics;
    const errors = items.filter((item) => item.severity === 'error').length;
    const warnings = items.length - errors;
    banner.hidden = !broken;
    badge.hidden = items.length === 0;
    badge.classList.toggle('error', errors > 0);
    setText(
      badge,
      [count(errors, 'error'), count(warnings, 'note')].filter((text) => text).join(', '),
    );
    fill(list, ...items.map(entry));
    if (broken) sheet.hidden = false;
    else if (items.length === 0) sheet.hidden = true;
  };
  app.model.on('diagnostics', refresh);
  refresh();
  return { sheet, badge, banner };
}

function count(number: number, what: string): string {
  return number ? `${number} ${what}${number > 1 ? 's' : ''}` : '';
}

function entry(item: Diagnostic): HTMLElement {
  const place = [item.file?.split('/').pop(), item.line, item.column]
    .filter((part) => part)
    .join(':');
  return h(
    'article',
    { className: `diagnostic ${item.severity}` },
    h('p', {}, h('span', { className: 'severity' }, item.severity), ' ', item.message),
    place &&
      h(
        'p',
        { className: 'place', title: item.file ?? '' },
        place,
        item.id && h('span', { className: 'muted' }, `  ${item.id}`),
      ),
    item.excerpt && h('pre', {}, item.excerpt),
    item.hint && h('p', { className: 'hint-text' }, item.hint),
  );
}
