// SPDX-License-Identifier: Apache-2.0
import { h } from '../dom';
import { keys } from '../keyboard';

// The map of keys and of what the mouse does.
export function showHelp(): void {
  const open = document.querySelector<HTMLDialogElement>('dialog.help');
  if (open) return open.close();
  const mouse: [string, string][] = [
    ['Orbit', 'drag orbits, right drag moves, wheel zooms'],
    ['any tool', 'left drag acts; right drag, or Alt and left, orbits'],
    ['Pull', 'drag the tissue'],
    ['Probe', 'press and slide; wheel while pressing goes deeper'],
    ['blades', 'drag the way you cut; wheel while cutting goes deeper'],
  ];
  const dialog = h(
    'dialog',
    { className: 'help' },
    h('h2', {}, 'Keys'),
    h(
      'dl',
      { className: 'keys' },
      ...keys.flatMap(({ label, text }) => [h('dt', {}, h('kbd', {}, label)), h('dd', {}, text)]),
    ),
    h('h2', {}, 'Mouse'),
    h(
      'dl',
      { className: 'keys' },
      ...mouse.flatMap(([name, text]) => [h('dt', {}, name), h('dd', {}, text)]),
    ),
    h(
      'div',
      { className: 'dialog-end' },
      h('a', { href: 'THIRD_PARTY.txt', target: '_blank' }, 'Third-party software'),
      h('button', { autofocus: true, onclick: () => dialog.close() }, 'Close'),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
