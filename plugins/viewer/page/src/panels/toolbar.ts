// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { fill, h, icon, iconButton, setText } from '../dom';
import { formatQuantity } from '../quantity';
import { kindOf, toolName, type ToolKind } from '../tool_kind';

export interface ToolbarActions {
  picture(): void;
  video(): boolean; // whether it records now
  saveScene(): void;
  saveRecording(): void;
  theme(): void;
  help(): void;
  side(which: 'left' | 'right'): void;
}

// The top bar: whose scene this is, what the mouse holds, what can be kept.
export function toolbar(app: App, actions: ToolbarActions): HTMLElement {
  const file = h('span', { className: 'file' });
  const changed = h('button', {
    className: 'changes quiet',
    title: 'Take back the last change (Ctrl+Z)',
    onclick: () => void app.connection.ask({ type: 'undo' }),
  });
  const palette = h('div', { className: 'palette', aria: { role: 'toolbar', label: 'Tools' } });
  const depth = depthSlider(app);
  const video = iconButton('record', 'Record a video (V)', () => {
    video.classList.toggle('recording', actions.video());
  });
  video.id = 'video';

  app.model.on('scene', (scene) => {
    setText(file, scene.file.split('/').pop() ?? '');
    file.title = scene.file;
    document.title = `${file.textContent} · Stroma`;
    showChanges(scene.changes);
  });
  app.model.on('changes', (changes) => showChanges(changes));
  const showChanges = (changes: string[]): void => {
    const count = changes.length;
    changed.hidden = count === 0;
    setText(changed, `${count} change${count === 1 ? '' : 's'} · undo`);
    changed.title = `Take back the last change (Ctrl+Z)\n${changes.join('\n')}`;
  };
  changed.hidden = true;
  const refresh = (): void => showPalette(app, palette);
  app.choice.on('changed', refresh);
  app.model.on('hello', refresh);
  refresh();

  return h(
    'header',
    { className: 'top' },
    h(
      'div',
      { className: 'brand' },
      iconButton('left', 'Scene panel ([)', () => actions.side('left')),
      h('strong', {}, 'Stroma'),
      file,
      changed,
    ),
    h('div', { className: 'middle' }, palette, depth),
    h(
      'div',
      { className: 'keep' },
      iconButton('camera', 'Keep a picture (P)', actions.picture),
      video,
      saveMenu(actions),
      iconButton('sun', 'Light or dark (T)', actions.theme),
      iconButton('help', 'Keys and mouse (?)', actions.help),
      iconButton('right', 'View panel (])', () => actions.side('right')),
    ),
  );
}

function saveMenu(actions: ToolbarActions): HTMLElement {
  const menu = h('details', { className: 'menu' });
  const entry = (text: string, note: string, call: () => void): HTMLElement =>
    h(
      'button',
      {
        onclick: () => {
          menu.open = false;
          call();
        },
      },
      text,
      h('small', {}, note),
    );
  const summary = h('summary', { className: 'icon-button', title: 'Save' });
  summary.append(icon('save'));
  menu.append(
    summary,
    h(
      'div',
      { className: 'menu-list' },
      entry('Scene', 'as XML, with what you changed', actions.saveScene),
      entry('Recording', 'what the mouse did, to be replayed', actions.saveRecording),
    ),
  );
  document.addEventListener('pointerdown', (event) => {
    if (!menu.contains(event.target as Node)) menu.open = false;
  });
  return menu;
}

function depthSlider(app: App): HTMLElement {
  const value = h('output', {});
  const slider = h('input', {
    type: 'range',
    min: '0',
    max: '1000',
    id: 'depth',
    aria: { label: 'Depth' },
  });
  slider.addEventListener('input', () => {
    app.choice.setDepth((Number(slider.value) / 1000) * app.choice.mostDepth);
  });
  const box = h(
    'label',
    { className: 'depth', title: 'How deep the tool goes (wheel while it acts)' },
    'Depth',
    slider,
    value,
  );
  const refresh = (): void => {
    const tool = app.choice.tool;
    box.hidden = !tool || kindOf(tool) === 'grip';
    slider.value = String((1000 * app.choice.depth) / app.choice.mostDepth);
    setText(value, formatQuantity(app.choice.depth, 'm', 3));
  };
  app.choice.on('depth', refresh);
  app.choice.on('changed', refresh);
  refresh();
  return box;
}

function showPalette(app: App, palette: HTMLElement): void {
  const chosen = app.choice.tool;
  const steers = app.model.steers;
  const buttons: HTMLElement[] = [
    button('Orbit', 'Look round (O)', chosen === null, true, () => app.choice.orbit()),
  ];
  const tools = app.choice.tools;
  const names = tools.map(toolName);
  const canEquip = steers && app.model.surfaces().length > 0;
  const offer = (what: 'pull' | 'probe', kind: ToolKind, name: string): void => {
    if (tools.some((tool) => kindOf(tool) === kind)) return;
    buttons.push(
      button(
        name,
        `Adds a ${kind} to the scene`,
        false,
        canEquip,
        () => void app.choice.equip(what),
      ),
    );
  };
  offer('pull', 'grip', 'Pull');
  tools.forEach((tool, i) => {
    if (i === tools.findIndex((one) => kindOf(one) !== 'grip')) offer('probe', 'probe', 'Probe');
    const twice = names.filter((name) => name === names[i]).length > 1;
    const name = twice ? `${names[i]} ${tool.path.split('/').pop()}` : names[i]!;
    const title = tool.mouse
      ? `${tool.path} (${i + 1})`
      : `${tool.path} is moved by ${tool.device || 'nothing'}: take it (${i + 1})`;
    const made = button(
      name,
      title,
      chosen?.path === tool.path,
      steers,
      () => void app.choice.choose(tool),
    );
    made.dataset.tool = tool.path;
    if (!tool.mouse) made.append(h('span', { className: 'take' }, 'take'));
    buttons.push(made);
  });
  if (tools.every((tool) => kindOf(tool) === 'grip')) offer('probe', 'probe', 'Probe');
  fill(palette, ...buttons);
}

function button(
  text: string,
  title: string,
  pressed: boolean,
  enabled: boolean,
  onclick: () => void,
): HTMLButtonElement {
  return h(
    'button',
    { title, onclick, disabled: !enabled, aria: { pressed: String(pressed) } },
    text,
  );
}
