// SPDX-License-Identifier: Apache-2.0

type Child = Node | string | number | null | undefined | false;
type Properties<K extends keyof HTMLElementTagNameMap> = Partial<
  Omit<HTMLElementTagNameMap[K], 'style' | 'dataset'>
> & {
  style?: Partial<CSSStyleDeclaration>;
  data?: Record<string, string>;
  aria?: Record<string, string>;
};

// An element with properties and children.
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties<K> = {} as Properties<K>,
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  const { style, data, aria, ...rest } = properties;
  Object.assign(element, rest);
  if (style) Object.assign(element.style, style);
  for (const [name, value] of Object.entries(data ?? {})) element.dataset[name] = value;
  for (const [name, value] of Object.entries(aria ?? {})) {
    element.setAttribute(name === 'role' ? 'role' : `aria-${name}`, value);
  }
  append(element, children);
  return element;
}

export function append(parent: Element, children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    parent.append(child instanceof Node ? child : String(child));
  }
}

export function fill(parent: Element, ...children: Child[]): void {
  parent.replaceChildren();
  append(parent, children);
}

// A text is written only if it has changed: layout is not disturbed ten times a second.
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

// A panel's section that folds, remembering whether it is open.
export function section(
  title: string,
  key: string,
  open: boolean,
  ...children: Child[]
): HTMLDetailsElement {
  const details = h('details', { className: 'section' }, h('summary', {}, title), ...children);
  const kept = localStorage.getItem(`stroma.open.${key}`);
  details.open = kept === null ? open : kept === '1';
  details.addEventListener('toggle', () => {
    localStorage.setItem(`stroma.open.${key}`, details.open ? '1' : '0');
  });
  return details;
}

const icons: Record<string, string> = {
  play: 'M5 3l9 5.5L5 14z',
  pause: 'M4 3h3v11H4zM10 3h3v11h-3z',
  step: 'M3 3l7 5.5L3 14zM11 3h2.5v11H11z',
  reset: 'M8.5 3a5.5 5.5 0 1 1-5.3 4h1.9a3.7 3.7 0 1 0 3.4-2.2V7.2L4.6 4 8.5.8z',
  camera: 'M2 5h3l1.2-2h4.6L12 5h3v8.5H2zM8.5 6.5a2.7 2.7 0 1 0 0 5.4 2.7 2.7 0 0 0 0-5.4z',
  record: 'M8.5 3.5a5 5 0 1 0 0 10 5 5 0 0 0 0-10z',
  save: 'M7.6 2h1.8v6.2l2.3-2.3 1.3 1.3-4.5 4.5L4 7.2l1.3-1.3 2.3 2.3zM3 13h11v1.8H3z',
  left: 'M2 3h13v11H2zM3.5 4.5v8H6v-8z',
  right: 'M2 3h13v11H2zM11 4.5v8h2.5v-8z',
  sun: 'M8.5 5.3a3.2 3.2 0 1 0 0 6.4 3.2 3.2 0 0 0 0-6.4zM7.7 1h1.6v2.5H7.7zM7.7 13.5h1.6V16H7.7zM1 7.7h2.5v1.6H1zM13.5 7.7H16v1.6h-2.5z',
  help: 'M8.5 1.5a7 7 0 1 0 0 14 7 7 0 0 0 0-14zm-.9 10h1.8v1.8H7.6zm.9-8c1.7 0 3 1 3 2.6 0 1.9-2.1 2.2-2.1 4H7.6c0-2.7 2-2.7 2-4 0-.6-.5-.9-1.1-.9-.7 0-1.2.4-1.2 1.2H5.5c0-1.8 1.3-2.9 3-2.9z',
  close:
    'M4.300 3L8.500 7.200 12.700 3 14 4.300 9.800 8.500l4.200 4.200-1.300 1.300-4.200-4.200L4.300 14 3 12.700l4.200-4.200L3 4.300z',
};

export function icon(name: keyof typeof icons & string): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 17 17');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', icons[name] ?? '');
  path.setAttribute('fill-rule', 'evenodd');
  svg.append(path);
  return svg;
}

// A button that shows an icon, named for those who do not see it.
export function iconButton(name: string, title: string, onclick: () => void): HTMLButtonElement {
  return h(
    'button',
    { className: 'icon-button', title, onclick, aria: { label: title } },
    icon(name),
  );
}
