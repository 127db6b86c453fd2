// SPDX-License-Identifier: Apache-2.0
import { request, type App } from '../app';
import { h, setText } from '../dom';
import type { Attribute } from '../protocol';
import { displayUnit, formatQuantity, parseQuantity, quantityText } from '../quantity';
import type { PlotList } from './plots';
import { sliderScale } from './slider_scale';

export interface AttributeRow {
  element: HTMLElement;
  showText(text: string): void;
  showNumber(value: number): void;
}

const slideInterval = 80; // ms between two values of a slider that is moved

// One attribute: its name, its state, and what sets it.
export function attributeRow(
  app: App,
  owner: string,
  attribute: Attribute,
  plots: PlotList,
): AttributeRow {
  const path = `${owner}.${attribute.name}`;
  const dot = h('span', { className: 'dot', title: 'Set in the scene' });
  const back = h(
    'button',
    {
      className: 'quiet back',
      title: `Back to the default: ${attribute.default ?? ''}`,
    },
    '↺',
  );
  const name = h('label', { className: 'name', title: tooltip(attribute) }, attribute.name);
  const head = h('div', { className: 'attribute-head' }, name);
  if (!attribute.output && !attribute.runtime) {
    head.append(
      h(
        'span',
        { className: 'badge', title: 'The scene is read again with the new value' },
        'restart',
      ),
    );
  }
  head.append(dot, back);
  const element = h('div', { className: 'attribute', data: { path } }, head);

  const mark = (): void => {
    dot.hidden = !attribute.isSet;
    const isDefault = attribute.value === attribute.default || !attribute.isSet;
    back.hidden =
      isDefault ||
      attribute.output === true ||
      attribute.default === undefined ||
      !!attribute.required;
  };
  const send = (text: string): void => {
    void request(app, { type: 'set', path, value: text }).then((done) => {
      if (done) app.model.noteSet(path, text);
      else control.show(attribute.value);
    });
  };
  const control = attribute.output
    ? outputControl(attribute, path, plots)
    : inputControl(attribute, send, !app.model.steers);
  control.element.id = `set:${path}`;
  back.onclick = () => send(attribute.default ?? '');
  back.disabled = !app.model.steers;
  if (control.element instanceof HTMLInputElement && control.element.type === 'checkbox') {
    name.prepend(control.element);
  } else {
    element.append(control.element);
  }
  mark();
  return {
    element,
    showText(text) {
      attribute.value = text;
      control.show(text);
      mark();
    },
    showNumber(value) {
      if (attribute.output) control.show(formatQuantity(value, attribute.unit ?? '', 5));
    },
  };
}

interface Control {
  element: HTMLElement;
  show(text: string): void;
}

function tooltip(attribute: Attribute): string {
  const lines = [
    attribute.doc ?? '',
    `${attribute.type}${attribute.unit ? `, ${attribute.unit}` : ''}`,
  ];
  if (attribute.default !== undefined && !attribute.required)
    lines.push(`default: ${attribute.default || 'empty'}`);
  if (attribute.min !== undefined)
    lines.push(`${attribute.exclusiveMin ? 'above' : 'at least'} ${attribute.min}`);
  if (attribute.max !== undefined)
    lines.push(`${attribute.exclusiveMax ? 'below' : 'at most'} ${attribute.max}`);
  return lines.filter((line) => line).join('\n');
}

function inputControl(
  attribute: Attribute,
  send: (text: string) => void,
  disabled: boolean,
): Control {
  if (attribute.choices?.length) return choiceControl(attribute, send, disabled);
  if (/^(true or false|bool)/.test(attribute.type)) return checkControl(attribute, send, disabled);
  if (/^(number|whole number|float|double|int)$/.test(attribute.type)) {
    return numberControl(attribute, send, disabled);
  }
  return textControl(attribute, send, disabled);
}

function choiceControl(
  attribute: Attribute,
  send: (text: string) => void,
  disabled: boolean,
): Control {
  const select = h(
    'select',
    { disabled },
    ...attribute.choices!.map((choice) => h('option', { value: choice }, choice)),
  );
  select.value = attribute.value;
  select.addEventListener('change', () => send(select.value));
  return {
    element: select,
    show: (text) => {
      select.value = text;
    },
  };
}

function checkControl(
  attribute: Attribute,
  send: (text: string) => void,
  disabled: boolean,
): Control {
  const isTrue = (text: string): boolean => text === 'true' || text === '1';
  const box = h('input', { type: 'checkbox', checked: isTrue(attribute.value), disabled });
  box.addEventListener('change', () => send(box.checked ? 'true' : 'false'));
  return {
    element: box,
    show: (text) => {
      box.checked = isTrue(text);
    },
  };
}

function textControl(
  attribute: Attribute,
  send: (text: string) => void,
  disabled: boolean,
): Control {
  const field = h('input', {
    type: 'text',
    value: attribute.value,
    disabled: disabled || attribute.long === true,
    spellcheck: false,
    title: attribute.long ? 'Too long to be changed here' : attribute.value,
  });
  field.addEventListener('change', () => send(field.value));
  return {
    element: field,
    show: (text) => {
      if (document.activeElement !== field) field.value = text;
    },
  };
}

function numberControl(
  attribute: Attribute,
  send: (text: string) => void,
  disabled: boolean,
): Control {
  const unit = attribute.unit ?? '';
  const whole = attribute.type === 'whole number';
  let value = parseQuantity(attribute.value, unit);
  let scale = sliderScale(attribute, value);
  const field = h('input', { type: 'text', className: 'number', disabled, spellcheck: false });
  const slider = h('input', {
    type: 'range',
    min: '0',
    max: '1000',
    disabled,
    aria: { label: attribute.name },
  });
  const pretty = (x: number): string =>
    Number.isFinite(x) ? formatQuantity(x, unit, 5).replace('−', '-') : attribute.value;
  const show = (): void => {
    if (document.activeElement !== field) field.value = pretty(value);
    if (scale) slider.value = String(1000 * scale.place(value));
    slider.hidden = !scale;
  };

  let waiting: number | undefined;
  const sendSoon = (): void => {
    waiting ??= window.setTimeout(() => {
      waiting = undefined;
      send(quantityText(value, unit));
    }, slideInterval);
  };
  slider.addEventListener('input', () => {
    value = scale!.value(Number(slider.value) / 1000);
    value = whole ? Math.round(value) : Number(value.toPrecision(3));
    field.value = pretty(value);
    // what needs the scene to be read again is sent when the slider is let go
    if (attribute.runtime) sendSoon();
  });
  slider.addEventListener('change', () => {
    if (!attribute.runtime) send(quantityText(value, unit));
  });
  field.addEventListener('change', () => {
    const bare = /^\s*[-+]?[\d.]+(e[-+]?\d+)?\s*$/i.test(field.value);
    const shown = displayUnit(value, unit);
    const asked = bare ? Number(field.value) * shown.factor : parseQuantity(field.value, unit);
    // what is not understood here the simulation judges
    send(Number.isFinite(asked) ? quantityText(asked, unit) : field.value);
    field.blur();
  });
  field.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
    event.preventDefault();
    if (!Number.isFinite(value)) return;
    const by = event.key === 'ArrowUp' ? 1 : -1;
    value = whole ? value + by : Number((value * (1 + 0.05 * by)).toPrecision(3));
    field.value = pretty(value);
    send(quantityText(value, unit));
  });
  show();
  return {
    element: h('div', { className: 'number-control' }, slider, field),
    show(text) {
      const now = parseQuantity(text, unit);
      if (waiting !== undefined) return;
      value = now;
      if (!scale || now < scale.low || now > scale.high) scale = sliderScale(attribute, now);
      if (Number.isFinite(now)) show();
      else field.value = text;
    },
  };
}

function outputControl(attribute: Attribute, path: string, plots: PlotList): Control {
  const value = h('output', { className: 'value' });
  const show = (text: string): void => {
    const number = parseQuantity(text, attribute.unit ?? '');
    setText(
      value,
      Number.isFinite(number) ? formatQuantity(number, attribute.unit ?? '', 5) : text || '–',
    );
  };
  show(attribute.value);
  const plot = h(
    'button',
    {
      className: 'quiet',
      title: 'Plot it over time',
      onclick: () => plots.add(path, attribute.unit ?? ''),
    },
    'plot',
  );
  plot.hidden = !/number/.test(attribute.type);
  return { element: h('div', { className: 'output' }, value, plot), show };
}
