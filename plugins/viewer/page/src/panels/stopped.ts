// SPDX-License-Identifier: Apache-2.0
import { request, type App } from '../app';
import { h, setText } from '../dom';

// Says why the simulation cannot go on, and what leads out of it.
export function stoppedBanner(app: App): HTMLElement {
  const why = h('span', {});
  const rewind = h(
    'button',
    {
      onclick: () => {
        const kept = app.model.status?.kept ?? [];
        const time = kept[Math.max(0, kept.length - 2)];
        if (time !== undefined) void request(app, { type: 'rewind', time });
      },
    },
    'Rewind',
  );
  const reset = h('button', { onclick: () => void request(app, { type: 'reset' }) }, 'Reset');
  const banner = h(
    'div',
    { className: 'banner stopped', hidden: true, aria: { role: 'alert' } },
    h('strong', {}, 'The simulation stopped. '),
    why,
    rewind,
    reset,
  );
  app.model.on('status', ({ stopped, kept }) => {
    banner.hidden = stopped === '';
    setText(why, stopped);
    rewind.disabled = !app.model.steers || kept.length === 0;
    reset.disabled = !app.model.steers;
  });
  return banner;
}
