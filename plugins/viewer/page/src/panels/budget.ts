// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { fill, h, setText } from '../dom';
import type { StageTime, Status } from '../protocol';
import { formatNumber } from '../quantity';
import type { Rates } from '../rates';

// Milliseconds of each stage against the step; a click shows the calls.
export function budget(app: App, rates: Rates): { bar: HTMLElement; sheet: HTMLElement } {
  const bars = h('div', { className: 'bars' });
  const mark = h('div', { className: 'mark', title: 'One step of real time' });
  const label = h('span', { className: 'budget-label' });
  const sheet = h('div', { className: 'sheet timing', hidden: true });
  const bar = h(
    'button',
    {
      className: 'budget quiet',
      title: 'Where the time goes (B)',
      id: 'budget',
      onclick: () => {
        sheet.hidden = !sheet.hidden;
        refresh();
      },
    },
    label,
    h('div', { className: 'track' }, bars, mark),
  );

  let shown = 0;
  const refresh = (): void => {
    const { status, scene } = app.model;
    if (!status || !scene) return;
    showBars(status, scene.dt, bars, mark, label);
    if (!sheet.hidden) showSheet(sheet, status, scene.dt, rates);
  };
  app.model.on('status', () => {
    const now = performance.now();
    if (now - shown < 250) return;
    shown = now;
    refresh();
  });
  return { bar, sheet };
}

function showBars(
  status: Status,
  dt: number,
  bars: HTMLElement,
  mark: HTMLElement,
  label: HTMLElement,
): void {
  const stages = status.stages ?? [];
  const step = 1e3 * dt;
  const sum = stages.reduce((total, stage) => total + stage.ms, 0);
  const spent = sum || 1e3 * status.stepTime;
  const whole = Math.max(step, spent) * 1.05;
  mark.style.left = `${(100 * step) / whole}%`;
  setText(label, `${formatNumber(spent, 3)} of ${formatNumber(step, 3)} ms`);
  label.classList.toggle('slow', spent > step);
  const parts = stages.length ? stages : [{ name: 'step', ms: spent, calls: [] }];
  fill(
    bars,
    ...parts.map((stage, i) =>
      h('div', {
        className: 'bar',
        title: `${stage.name}: ${formatNumber(stage.ms, 3)} ms`,
        data: { shade: String(i % 6) },
        style: { width: `${(100 * stage.ms) / whole}%` },
      }),
    ),
  );
}

function showSheet(sheet: HTMLElement, status: Status, dt: number, rates: Rates): void {
  const picture = rates.summary();
  const rows: HTMLElement[] = [];
  for (const stage of status.stages ?? []) rows.push(...stageRows(stage, dt));
  const facts: [string, string][] = [
    [
      'Simulation',
      status.stepTime > 0 ? `${formatNumber(1 / status.stepTime, 3)} steps/s possible` : '–',
    ],
    ['Real time', `${formatNumber(status.realTimeFactor, 3)} ×`],
    [
      'Picture',
      `${formatNumber(picture.rate, 3)} /s, p99 ${formatNumber(picture.p99, 3)} ms to draw`,
    ],
    ['Frames', `${formatNumber(picture.frames, 3)} /s arrive`],
  ];
  if (status.frameCost !== undefined) {
    facts.push([
      'Cost of showing',
      `${formatNumber(status.frameCost, 3)} ms of the simulation's thread`,
    ]);
  }
  for (const [name, values] of Object.entries(status.haptics ?? {})) {
    facts.push([
      name,
      typeof values === 'number'
        ? formatNumber(values, 4)
        : Object.entries(values)
            .map(([k, v]) => `${k} ${formatNumber(v, 3)}`)
            .join(', '),
    ]);
  }
  for (const [path, count] of Object.entries(status.limiters ?? {})) {
    facts.push([path, `limited ${count} times`]);
  }
  facts.push(['Windows', String(status.watchers)]);
  fill(
    sheet,
    h('h2', {}, 'Where the time goes'),
    h(
      'dl',
      { className: 'facts' },
      ...facts.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]),
    ),
    rows.length
      ? h(
          'table',
          {},
          h(
            'thead',
            {},
            h(
              'tr',
              {},
              h('th', {}, 'call'),
              h('th', {}, 'ms a step'),
              h('th', {}, 'p99'),
              h('th', {}, 'of the step'),
            ),
          ),
          h('tbody', {}, ...rows),
        )
      : h('p', { className: 'muted' }, 'Times come with the next steps.'),
  );
}

function stageRows(stage: StageTime, dt: number): HTMLElement[] {
  const share = (ms: number): string => `${formatNumber((100 * ms) / (1e3 * dt), 2)} %`;
  const head = h(
    'tr',
    { className: 'stage' },
    h('th', {}, stage.name),
    h('td', {}, formatNumber(stage.ms, 3)),
    h('td', {}),
    h('td', {}, share(stage.ms)),
  );
  const calls = [...stage.calls]
    .sort((a, b) => b.ms - a.ms)
    .map((call) =>
      h(
        'tr',
        {},
        h('td', {}, `${call.component} `, h('span', { className: 'muted' }, call.label)),
        h('td', {}, formatNumber(call.ms, 3)),
        h('td', {}, formatNumber(call.p99, 3)),
        h('td', {}, share(call.ms)),
      ),
    );
  return [head, ...calls];
}
