// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { h, setText } from '../dom';
import { kindOf } from '../tool_kind';

const hints = {
  grip: 'Drag the tissue to pull it. Right button or Alt orbits.',
  probe:
    'Press to touch, drag to slide, wheel while pressing goes deeper. Right button or Alt orbits.',
  blade:
    'Drag the way you cut; the wheel while cutting sets the depth. Right button or Alt orbits.',
  pushed: 'Drag the way the blade is pushed in. Right button or Alt orbits.',
  punch:
    'Press to set the ring down, wheel while pressing goes deeper. Right button or Alt orbits.',
};

// What the mouse does now.
export function hintLine(app: App): HTMLElement {
  const line = h('p', { className: 'hint', id: 'hint' });
  const refresh = (): void => {
    const tool = app.choice.tool;
    if (!app.model.scene) setText(line, '');
    else if (tool) setText(line, hints[kindOf(tool)]);
    else if (!app.model.steers)
      setText(line, 'Drag to look round. Another page steers this simulation.');
    else if (app.choice.tools.some((one) => one.mouse)) {
      setText(
        line,
        'Drag to look round, wheel to zoom. Choose a tool above to touch the tissue. Keys: ?',
      );
    } else
      setText(
        line,
        'Drag to look round, wheel to zoom. Pull and Probe above give the mouse a tool. Keys: ?',
      );
  };
  app.choice.on('changed', refresh);
  app.model.on('hello', refresh);
  let steers = false;
  app.model.on('status', () => {
    if (steers !== app.model.steers) refresh();
    steers = app.model.steers;
  });
  return line;
}
