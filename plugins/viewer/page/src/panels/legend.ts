// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { cssGradient, shownEnd, type Range } from '../colours';
import { h, setText } from '../dom';
import { displayUnit, formatNumber, parseQuantity, type DisplayUnit } from '../quantity';
import { derivedFields } from '../view/colouring';

export function unitOfField(app: App, name: string): string {
  for (const body of app.model.scene?.bodies ?? []) {
    const field = body.fields.find((one) => one.name === name);
    if (field) return field.unit ?? '';
  }
  return derivedFields.find((field) => field.name === name)?.unit ?? '';
}

export function legendUnit(range: Range, unit: string): DisplayUnit {
  return displayUnit(Math.max(Math.abs(range.low), Math.abs(range.high)), unit);
}

// The colours with their values and unit; the ends can be fixed.
export function legend(app: App): HTMLElement {
  const scale = h('div', { className: 'scale', style: { background: cssGradient() } });
  const low = h('input', { type: 'text', className: 'number', aria: { label: 'Lowest value' } });
  const high = h('input', { type: 'text', className: 'number', aria: { label: 'Highest value' } });
  const unitText = h('span', { className: 'muted' });
  const auto = h('input', { type: 'checkbox', checked: true, id: 'range-auto' });
  const box = h(
    'div',
    { className: 'legend', hidden: true },
    scale,
    h('div', { className: 'ends' }, low, unitText, high),
    h(
      'label',
      { className: 'check', title: 'The range of what is seen now, or fixed' },
      auto,
      'Range of what is seen',
    ),
  );

  auto.addEventListener('change', () => {
    app.settings.set('range', auto.checked || !app.stage.range ? null : { ...app.stage.range });
  });
  const fix = (): void => {
    const unit = unitOfField(app, app.settings.values.colour);
    const shown = app.stage.range ? legendUnit(app.stage.range, unit) : { text: unit, factor: 1 };
    const read = (text: string): number => {
      const bare = Number(text.replace('−', '-'));
      return Number.isFinite(bare) ? bare * shown.factor : parseQuantity(text, unit);
    };
    const range = { low: read(low.value), high: read(high.value) };
    if (range.low < range.high) app.settings.set('range', range);
    refresh();
  };
  low.addEventListener('change', fix);
  high.addEventListener('change', fix);

  const refresh = (): void => {
    const { colour, range } = app.settings.values;
    const now = app.stage.range;
    box.hidden = !now || colour === '';
    auto.checked = range === null;
    if (!now) return;
    const unit = legendUnit(now, unitOfField(app, colour));
    setText(unitText, unit.text || '–');
    if (document.activeElement !== low)
      low.value = formatNumber(shownEnd(now.low, now) / unit.factor, 3);
    if (document.activeElement !== high)
      high.value = formatNumber(shownEnd(now.high, now) / unit.factor, 3);
  };
  app.world.afterDrawing.push(refresh);
  return box;
}
