// SPDX-License-Identifier: Apache-2.0
import { request, type App } from '../app';
import { fill, h } from '../dom';
import type { ComponentInfo } from '../protocol';

// Puts another component in the place of this one: of another type with what attributes they share,
// or an element written as XML.
export async function openSwap(app: App, component: ComponentInfo): Promise<void> {
  const answer = await app.connection.ask({ type: 'alternatives', path: component.path });
  if (!answer.done) return app.tell(answer.text ?? 'Nothing may take its place.');
  const dialog = h('dialog', { className: 'swap-dialog' });
  const swap = async (by: string): Promise<void> => {
    if (await request(app, { type: 'replace', path: component.path, with: by })) dialog.close();
  };
  const xml = h('textarea', {
    rows: 4,
    spellcheck: false,
    value: `<${component.type} name="${component.name}"/>`,
  });
  const types = (answer.types ?? []).filter((type) => type !== component.type);
  fill(
    dialog,
    h('h2', {}, `Instead of ${component.type}`),
    h(
      'p',
      { className: 'muted' },
      'The scene goes on from its state where the new component allows it. Undo with Ctrl+Z.',
    ),
    h(
      'div',
      { className: 'choices' },
      ...types.map((type) => h('button', { onclick: () => void swap(type) }, type)),
    ),
    types.length === 0 && h('p', {}, 'No other type that is known may take its place.'),
    h('h3', {}, 'Or an element of your own'),
    xml,
    h(
      'div',
      { className: 'dialog-end' },
      h('button', { onclick: () => dialog.close() }, 'Cancel'),
      h('button', { className: 'primary', onclick: () => void swap(xml.value) }, 'Put it in'),
    ),
  );
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
