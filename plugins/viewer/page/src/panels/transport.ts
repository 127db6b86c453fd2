// SPDX-License-Identifier: Apache-2.0
import { request, type App } from '../app';
import { fill, h, icon, iconButton, setText } from '../dom';
import type { Status } from '../protocol';
import { formatNumber, formatTime } from '../quantity';

const speeds = [0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2];

// The bottom bar's left part: time, and what makes it pass.
export function transport(app: App): HTMLElement {
  const play = iconButton('play', 'Play or pause (space)', () => togglePlay(app));
  play.classList.add('primary');
  play.id = 'play';
  const step = iconButton(
    'step',
    'One step (.)',
    () => void request(app, { type: 'step', count: 1 }),
  );
  const reset = iconButton(
    'reset',
    'Back to the start (R)',
    () => void request(app, { type: 'reset' }),
  );
  const speed = h(
    'select',
    { title: 'Most simulated seconds in a second', aria: { label: 'Speed' } },
    ...speeds.map((value) => h('option', { value: String(value) }, `${value} ×`)),
  );
  speed.value = '1';
  speed.addEventListener(
    'change',
    () => void request(app, { type: 'speed', value: Number(speed.value) }),
  );
  const time = h('output', { className: 'time', title: 'Simulated time' }, formatTime(0));
  const stepNumber = h('small', { className: 'muted' });
  const factor = h('span', {
    className: 'factor',
    title: 'Simulated seconds in a second of the clock',
  });
  const scrubber = rewindScrubber(app);
  const steer = h(
    'button',
    {
      className: 'steer',
      title: 'Another page steers: take over',
      onclick: () => void request(app, { type: 'steer' }),
    },
    'Steer from here',
  );
  const controls = [play, step, reset, speed, scrubber.input];

  const enable = (): void => {
    for (const control of controls) control.disabled = !app.model.steers;
    steer.hidden = app.model.steers || !app.connection.isOpen;
    document.body.classList.toggle('watching', !app.model.steers);
  };
  let playing: boolean | null = null;
  app.model.on('hello', enable);
  app.model.on('status', (status) => {
    enable();
    if (playing !== status.playing) fill(play, icon(status.playing ? 'pause' : 'play'));
    playing = status.playing;
    setText(time, formatTime(status.time));
    setText(stepNumber, `step ${status.step}`);
    showFactor(factor, status);
    const nearest = speeds.reduce((a, b) =>
      Math.abs(b - status.speed) < Math.abs(a - status.speed) ? b : a,
    );
    if (document.activeElement !== speed) speed.value = String(nearest);
    scrubber.show(status);
  });
  enable();
  return h(
    'div',
    { className: 'transport' },
    h('div', { className: 'buttons' }, play, step, reset),
    speed,
    h('div', { className: 'clock' }, time, stepNumber),
    scrubber.box,
    factor,
    steer,
  );
}

export function togglePlay(app: App): void {
  void request(app, { type: app.model.status?.playing ? 'pause' : 'play' });
}

function showFactor(element: HTMLElement, status: Status): void {
  const slow = status.playing && status.realTimeFactor < 0.95 * Math.min(1, status.speed);
  element.classList.toggle('slow', slow);
  if (status.stopped) setText(element, 'stopped');
  else if (!status.playing) setText(element, 'paused');
  else setText(element, `${formatNumber(status.realTimeFactor, 2)} × real time`);
  element.title = status.stopped || 'Simulated seconds in a second of the clock';
}

function rewindScrubber(app: App): {
  box: HTMLElement;
  input: HTMLInputElement;
  show: (status: Status) => void;
} {
  const input = h('input', {
    type: 'range',
    min: '0',
    max: '0',
    step: '1',
    id: 'rewind',
    aria: { label: 'Rewind' },
  });
  const label = h('output', { className: 'muted' });
  let kept: number[] = [];
  let held = false;
  input.addEventListener('pointerdown', () => {
    held = true;
  });
  input.addEventListener('input', () => {
    const time = kept[Number(input.value)];
    if (time !== undefined) setText(label, formatTime(time));
  });
  input.addEventListener('change', () => {
    held = false;
    const time = kept[Number(input.value)];
    if (time !== undefined) void request(app, { type: 'rewind', time });
  });
  const box = h(
    'label',
    { className: 'rewind', title: 'Back to a kept state' },
    'Rewind',
    input,
    label,
  );
  return {
    box,
    input,
    show(status) {
      if (held) return;
      kept = status.kept;
      input.max = String(Math.max(0, kept.length - 1));
      let nearest = 0;
      kept.forEach((time, i) => {
        if (time <= status.time + 1e-9) nearest = i;
      });
      input.value = String(nearest);
      box.classList.toggle('empty', kept.length < 2);
      setText(label, kept.length ? `${kept.length} kept` : 'none kept');
    },
  };
}
