// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import './style.css';
import { scriptInterface } from './api';
import type { App } from './app';
import { Connection } from './connection';
import { h } from './dom';
import { layOut } from './layout';
import { Model } from './model';
import { readOptions, type Options } from './options';
import { pickParticle } from './picking';
import { sendPictureWhenComplete } from './picture';
import { Rates } from './rates';
import { ViewSettings } from './settings';
import { Themes } from './theme';
import { ToolChoice } from './touch/choice';
import { Gestures } from './touch/gestures';
import { PoseSender } from './touch/sender';
import { isSent } from './view/colouring';
import { Stage } from './view/stage';
import { World } from './view/world';

start(readOptions(window.location.search));

function start(options: Options): void {
  const area = h('main', { className: 'stage' });
  document.body.append(area);
  const notices = h('div', { className: 'notices', aria: { live: 'polite' } });
  area.append(notices);
  const themes = new Themes(options.theme);
  const scheme = window.location.protocol === 'https:' ? 'wss' : 'ws';
  const connection = new Connection(
    `${scheme}://${window.location.host}/socket?token=${encodeURIComponent(options.token)}`,
  );
  const model = new Model();
  const settings = new ViewSettings();
  const world = new World(area);
  const stage = new Stage(world, model, settings);
  const choice = new ToolChoice(model, connection);
  const app: App = {
    connection,
    model,
    settings,
    world,
    stage,
    choice,
    tell: (text) => tell(notices, text),
  };
  const rates = new Rates();
  world.afterDrawing.push((cost) => rates.noteDrawn(cost));
  model.on('frame', () => rates.noteFrame());

  takeOptions(app, options);
  const background = (): void => world.setBackground(themes.colour('canvas'));
  themes.on('changed', background);
  background();
  connect(app, area);
  askForWhatIsShown(app, options.picture === null);
  if (!options.picture) {
    layOut(app, area, themes, rates);
    touch(app);
  } else {
    document.body.classList.add('bare');
  }
  fitToArea(app, area, options);
  if (options.picture) sendPictureWhenComplete(app, options.picture);

  const problems: string[] = [];
  connection.on('error', (text) => problems.push(text));
  window.stroma = scriptInterface(app, problems);
  connection.open();
}

function takeOptions(app: App, options: Options): void {
  if (options.colour !== null) app.settings.set('colour', options.colour);
  if (options.walls !== null) app.settings.set('walls', options.walls);
  if (options.particles !== null) app.settings.set('particles', options.particles);
  if (options.context !== null) app.settings.set('context', options.context);
  const camera = options.camera;
  if (!camera) return;
  // placed after the first scene has set its own view
  let placed = false;
  app.model.on('scene', () => {
    if (placed) return;
    placed = true;
    app.world.camera.place(
      new THREE.Vector3(...camera.slice(0, 3)),
      new THREE.Vector3(...camera.slice(3, 6)),
      camera[6],
    );
  });
}

function connect(app: App, area: HTMLElement): void {
  const ended = h('div', { className: 'ended', hidden: true, aria: { role: 'status' } });
  area.append(ended);
  app.connection.on('message', (message) => app.model.take(message));
  app.connection.on('binary', (message) => app.model.takeBinary(message));
  app.connection.on('open', () => {
    ended.hidden = true;
  });
  app.connection.on('closed', ({ everOpen }) => {
    ended.hidden = false;
    ended.replaceChildren(
      h('strong', {}, everOpen ? 'Simulation ended' : 'No simulation here'),
      h(
        'span',
        {},
        everOpen
          ? 'The page connects again when it is back.'
          : 'Is the address complete, with its token?',
      ),
    );
  });
}

// Tells the viewer which fields and particles are to be sent, now and after each change.
function askForWhatIsShown(app: App, watches: boolean): void {
  const look = (): void => {
    for (const body of app.model.bodies.values()) {
      const { colour } = app.settings.values;
      app.connection.send({
        type: 'look',
        body: body.info.id,
        field: isSent(body, colour) ? colour : '',
        particles: app.stage.particlesShown(),
      });
    }
  };
  app.model.on('scene', look);
  app.settings.on('changed', (name) => {
    if (name === 'colour' || name === 'particles') look();
  });
  if (watches) {
    app.model.on('hello', () => app.connection.send({ type: 'watch', timing: true, energy: true }));
  }
}

function touch(app: App): void {
  const sender = new PoseSender(app.connection);
  const gestures = new Gestures(app.stage, app.choice, sender);
  gestures.onClick = (x, y) => {
    if (!app.choice.tool) void pickParticle(app, x, y);
  };
  app.choice.on('changed', () => {
    const tool = app.choice.tool;
    app.world.camera.setLeftOrbits(tool === null);
    app.world.canvas.classList.toggle('acting', tool !== null);
    app.stage.tools.choose(tool?.path ?? null);
    app.stage.tools.update(app.model.tools);
    app.world.draw();
  });
  app.choice.on('refused', (text) => app.tell(text));
}

// The canvas fills its area, or has the size that a picture is to have.
function fitToArea(app: App, area: HTMLElement, options: Options): void {
  const picture = options.picture;
  if (picture) {
    app.world.resize(picture.width, picture.height, 1);
    return;
  }
  const fit = (): void => {
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    app.world.resize(area.clientWidth, area.clientHeight, ratio);
  };
  new ResizeObserver(fit).observe(area);
  fit();
}

function tell(notices: HTMLElement, text: string): void {
  const notice = h('p', {}, text);
  notices.append(notice);
  while (notices.children.length > 4) notices.firstElementChild!.remove();
  setTimeout(() => notice.remove(), 6000);
}
