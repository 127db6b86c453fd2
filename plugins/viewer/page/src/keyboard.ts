// SPDX-License-Identifier: Apache-2.0

export interface Key {
  label: string; // as the map shows it
  match(event: KeyboardEvent): boolean;
  text: string;
  action: string;
}

const plain =
  (key: string) =>
  (event: KeyboardEvent): boolean =>
    event.key.toLowerCase() === key && !event.ctrlKey && !event.metaKey && !event.altKey;

export const keys: Key[] = [
  { label: 'space', match: plain(' '), text: 'play or pause', action: 'play' },
  { label: '.', match: plain('.'), text: 'one step', action: 'step' },
  { label: 'R', match: plain('r'), text: 'back to the start', action: 'reset' },
  {
    label: '← →',
    match: (e) => plain('arrowleft')(e) || plain('arrowright')(e),
    text: 'to the kept state before or after',
    action: 'rewind',
  },
  {
    label: 'Ctrl Z',
    match: (e) => (e.ctrlKey || e.metaKey) && e.key.toLowerCase() === 'z',
    text: 'take back the last change',
    action: 'undo',
  },
  { label: 'O', match: plain('o'), text: 'orbit', action: 'orbit' },
  {
    label: '1 … 9',
    match: (e) => /^[1-9]$/.test(e.key) && !e.ctrlKey && !e.metaKey && !e.altKey,
    text: 'the tool of this number',
    action: 'tool',
  },
  { label: 'H', match: plain('h'), text: 'the whole scene', action: 'home' },
  { label: 'C', match: plain('c'), text: 'next colouring', action: 'colour' },
  { label: 'S', match: plain('s'), text: 'surface', action: 'surface' },
  { label: 'N', match: plain('n'), text: 'particles', action: 'particles' },
  { label: 'G', match: plain('g'), text: 'rest shape', action: 'ghost' },
  { label: 'F', match: plain('f'), text: 'forces', action: 'forces' },
  { label: 'B', match: plain('b'), text: 'where the time goes', action: 'budget' },
  { label: 'D', match: plain('d'), text: 'diagnostics', action: 'diagnostics' },
  { label: 'P', match: plain('p'), text: 'keep a picture', action: 'picture' },
  { label: 'V', match: plain('v'), text: 'record a video, or end it', action: 'video' },
  { label: 'T', match: plain('t'), text: 'light or dark', action: 'theme' },
  { label: '[', match: plain('['), text: 'scene panel', action: 'left' },
  { label: ']', match: plain(']'), text: 'view panel', action: 'right' },
  { label: '?', match: (e) => e.key === '?', text: 'this map', action: 'help' },
  { label: 'Esc', match: plain('escape'), text: 'lay the tool down', action: 'orbit' },
];

// Calls what a key stands for, unless the person is writing or setting something.
export function listenToKeys(act: (action: string, event: KeyboardEvent) => void): void {
  window.addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    if (target.closest('input[type=text], textarea, select, dialog')) return;
    if (target.closest('input[type=range]') && event.key.startsWith('Arrow')) return;
    if (event.key === ' ' && target.closest('button, summary')) return;
    const key = keys.find((one) => one.match(event));
    if (!key) return;
    event.preventDefault();
    act(key.action, event);
  });
}
