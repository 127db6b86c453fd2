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
export function section(title: string, key: string, open: boolean, ...children: Child[]): HTMLDetailsElement {
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
  undo: 'M6.5 3v3h3a4 4 0 0 1 0 8H5v-1.8h4.500a2.200 2.200 0 0 0 0-4.400h-3v3L2 6.900z',
  camera: 'M2 5h3l1.200-2h4.600L12 5h3v8.500H2zM8.500 6.500a2.700 2.700 0 1 0 0 5.400 2.700 2.700 0 0 0 0-5.400z',
  record: 'M8.500 3.500a5 5 0 1 0 0 10 5 5 0 0 0 0-10z',
  save: 'M7.600 2h1.800v6.200l2.300-2.300 1.300 1.300-4.500 4.500L4 7.200l1.300-1.300 2.300 2.300zM3 13h11v1.800H3z',
  left: 'M2 3h13v11H2zM3.500 4.500v8H6v-8z',
  right: 'M2 3h13v11H2zM11 4.500v8h2.500v-8z',
  sun: 'M8.500 5.300a3.200 3.200 0 1 0 0 6.400 3.200 3.200 0 0 0 0-6.400zM7.700 1h1.600v2.500H7.700zM7.700 13.500h1.600V16H7.700zM1 7.700h2.500v1.600H1zM13.500 7.700H16v1.600h-2.500z',
  help: 'M8.500 1.500a7 7 0 1 0 0 14 7 7 0 0 0 0-14zm-.9 10h1.800v1.800H7.600zm.9-8c1.700 0 3 1 3 2.600 0 1.900-2.100 2.200-2.100 4H7.600c0-2.700 2-2.700 2-4 0-.6-.5-.9-1.100-.9-.700 0-1.200.400-1.200 1.200H5.500c0-1.800 1.300-2.900 3-2.900z',
  home: 'M8.500 2L15 8h-1.800v6H9.800v-4H7.200v4H3.800V8H2z',
  close: 'M4.300 3L8.500 7.200 12.700 3 14 4.300 9.800 8.500l4.200 4.200-1.300 1.300-4.200-4.200L4.300 14 3 12.700l4.200-4.200L3 4.300z',
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
  return h('button', { className: 'icon-button', title, onclick, aria: { label: title } }, icon(name));
}
