// SPDX-License-Identifier: Apache-2.0
import { request, type App } from './app';
import { keepPicture, saveText, VideoRecorder } from './capture';
import { h, section } from './dom';
import { listenToKeys } from './keyboard';
import { budget } from './panels/budget';
import { diagnostics } from './panels/diagnostics';
import { showHelp } from './panels/help';
import { hintLine } from './panels/hint';
import { inspector } from './panels/inspector';
import { PlotList } from './panels/plots';
import { stoppedBanner } from './panels/stopped';
import { summary } from './panels/summary';
import { toolbar } from './panels/toolbar';
import { togglePlay, transport } from './panels/transport';
import { Selection, tree } from './panels/tree';
import { viewPanel } from './panels/view_panel';
import type { Rates } from './rates';
import type { Themes } from './theme';

const narrow = 900; // pixels below which the side panels begin closed

// Puts the panels round the canvas and connects the keys.
export function layOut(app: App, area: HTMLElement, themes: Themes, rates: Rates): void {
  const selection = new Selection();
  const plots = new PlotList(app, themes);
  const video = new VideoRecorder(app);
  const time = budget(app, rates);
  const problems = diagnostics(app);
  const toggleVideo = (): boolean => video.toggle();

  const top = toolbar(app, {
    picture: () => keepPicture(app),
    video: toggleVideo,
    saveScene: () => void saveText(app, 'scene'),
    saveRecording: () => void saveText(app, 'recording'),
    theme: () => themes.toggle(),
    help: showHelp,
    side: (which) => toggleSide(which),
  });
  const left = h(
    'aside',
    { className: 'side left' },
    section('Scene', 'scene', true, summary(app), tree(app, selection)),
    section('Attributes', 'attributes', true, inspector(app, selection, plots)),
  );
  const right = viewPanel(app, plots);
  const bottom = h('footer', { className: 'bottom' }, transport(app), problems.badge, time.bar);
  area.append(problems.banner, stoppedBanner(app), hintLine(app), time.sheet, problems.sheet);
  document.body.append(top, left, area, right, bottom);
  if (window.innerWidth < narrow) document.body.classList.add('no-left', 'no-right');

  listenToKeys((action, event) => {
    switch (action) {
      case 'play':
        return togglePlay(app);
      case 'step':
        return void request(app, { type: 'step', count: 1 });
      case 'reset':
        return void request(app, { type: 'reset' });
      case 'rewind':
        return rewindBy(app, event.key === 'ArrowLeft' ? -1 : 1);
      case 'undo':
        return void request(app, { type: 'undo' });
      case 'orbit':
        return app.choice.orbit();
      case 'tool':
        return chooseNumber(app, Number(event.key));
      case 'home':
        return app.stage.goToView();
      case 'colour':
        return nextColour();
      case 'surface':
      case 'particles':
      case 'ghost':
      case 'forces':
        return app.settings.set(action, !app.settings.values[action]);
      case 'budget':
        return time.bar.click();
      case 'diagnostics':
        problems.sheet.hidden = !problems.sheet.hidden;
        return;
      case 'picture':
        return keepPicture(app);
      case 'video':
        return document.getElementById('video')?.click();
      case 'theme':
        return themes.toggle();
      case 'left':
      case 'right':
        return toggleSide(action);
      case 'help':
        return showHelp();
    }
  });
}

function toggleSide(which: 'left' | 'right'): void {
  document.body.classList.toggle(`no-${which}`);
}

function chooseNumber(app: App, number: number): void {
  const tool = app.choice.tools[number - 1];
  if (tool && app.model.steers) void app.choice.choose(tool);
}

function nextColour(): void {
  const select = document.getElementById('colour') as HTMLSelectElement | null;
  if (!select?.options.length) return;
  select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
  select.dispatchEvent(new Event('change'));
}

function rewindBy(app: App, by: -1 | 1): void {
  const status = app.model.status;
  if (!status?.kept.length) return;
  const others = status.kept.filter((time) => by * (time - status.time) > 1e-9);
  const time = by < 0 ? others[others.length - 1] : others[0];
  if (time !== undefined) void request(app, { type: 'rewind', time });
}
