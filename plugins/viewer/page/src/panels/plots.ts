// SPDX-License-Identifier: Apache-2.0
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import type { App } from '../app';
import { fill, h } from '../dom';
import { enclosedVolume } from '../model';
import { displayUnit, formatNumber, parseQuantity, type DisplayUnit } from '../quantity';
import type { Themes } from '../theme';

const mostSamples = 1500;
const plotHeight = 110;

interface Series {
  unit: string;
  times: number[];
  values: number[];
}

interface Plot {
  path: string;
  element: HTMLElement;
  chart: uPlot | null;
  unit: DisplayUnit;
}

// Values over simulated time: every number that comes is kept, those chosen are drawn.
export class PlotList {
  readonly element: HTMLElement;
  private readonly series = new Map<string, Series>();
  private readonly plots = new Map<string, Plot>();
  private readonly list = h('div', { className: 'plots' });
  private readonly adder = h('select', { aria: { label: 'Add a plot' } });
  private drawnAt = 0;
  private offered = '';

  constructor(
    private readonly app: App,
    private readonly themes: Themes,
  ) {
    this.adder.addEventListener('change', () => {
      const series = this.series.get(this.adder.value);
      if (series) this.add(this.adder.value, series.unit);
      this.adder.value = '';
    });
    this.element = h('div', {}, this.list, this.adder);
    app.model.on('status', () => this.take());
    app.model.on('attributes', ({ values }) => this.takeOutputs(values));
    app.model.on('scene', (scene) => {
      if (scene.file !== this.file) this.series.clear();
      this.file = scene.file;
    });
    themes.on('changed', () => this.rebuild());
    this.offer();
  }

  private file = '';

  add(path: string, unit: string): void {
    if (this.plots.has(path)) return;
    if (!this.series.has(path)) this.series.set(path, { unit, times: [], values: [] });
    const close = h(
      'button',
      { className: 'quiet', title: 'Remove', onclick: () => this.remove(path) },
      '×',
    );
    const element = h(
      'figure',
      { className: 'plot' },
      h('figcaption', {}, h('span', { title: path }, shortName(path)), close),
    );
    this.plots.set(path, { path, element, chart: null, unit: { text: unit, factor: 1 } });
    this.list.append(element);
    this.element.closest('details')?.setAttribute('open', '');
    this.offer();
    this.draw();
  }

  remove(path: string): void {
    const plot = this.plots.get(path);
    plot?.chart?.destroy();
    plot?.element.remove();
    this.plots.delete(path);
    this.offer();
  }

  private take(): void {
    const { status, frame } = this.app.model;
    if (!status) return;
    const units = this.units();
    for (const [path, value] of Object.entries(status.values)) {
      this.note(path, units.get(path) ?? '', status.time, value);
    }
    if (status.kinetic !== undefined) this.note('kinetic energy', 'J', status.time, status.kinetic);
    if (status.potential !== undefined)
      this.note('potential energy', 'J', status.time, status.potential);
    this.note('real-time factor', '', status.time, status.realTimeFactor);
    for (const body of frame ? this.app.model.surfaces() : []) {
      if (!body.position || !body.topology?.triangles.length) continue;
      const volume = enclosedVolume(body.position, body.topology.triangles);
      this.note(`volume of ${body.info.path}`, 'm^3', frame!.time, volume);
    }
    const now = performance.now();
    if (now - this.drawnAt < 200) return;
    this.drawnAt = now;
    this.offer();
    this.draw();
  }

  // Outputs come as texts; of a vector the length is kept.
  private takeOutputs(values: Record<string, string>): void {
    const { status } = this.app.model;
    if (!status) return;
    for (const { path, attribute } of this.app.model.everyAttribute()) {
      const text = attribute.output ? values[path] : undefined;
      if (text === undefined) continue;
      const size = sizeOf(text, attribute.unit ?? '');
      if (Number.isFinite(size)) this.note(path, attribute.unit ?? '', status.time, size);
    }
  }

  private note(path: string, unit: string, time: number, value: number): void {
    let series = this.series.get(path);
    if (!series) this.series.set(path, (series = { unit, times: [], values: [] }));
    // back in time: what was after it is forgotten
    while (series.times.length && series.times[series.times.length - 1]! >= time) {
      series.times.pop();
      series.values.pop();
    }
    series.times.push(time);
    series.values.push(value);
    if (series.times.length > mostSamples) {
      series.times.splice(0, mostSamples / 5);
      series.values.splice(0, mostSamples / 5);
    }
  }

  private units(): Map<string, string> {
    const out = new Map<string, string>();
    for (const { path, attribute } of this.app.model.everyAttribute()) {
      if (attribute.output) out.set(path, attribute.unit ?? '');
    }
    return out;
  }

  private offer(): void {
    const names = [...this.series.keys()].filter((path) => !this.plots.has(path)).sort();
    if (names.join('\n') === this.offered && this.adder.options.length) return;
    if (document.activeElement === this.adder) return;
    this.offered = names.join('\n');
    fill(
      this.adder,
      h(
        'option',
        { value: '' },
        names.length ? 'Plot a value…' : 'Values come with the first steps',
      ),
      ...names.map((path) => h('option', { value: path }, path)),
    );
  }

  private draw(): void {
    for (const plot of this.plots.values()) {
      const series = this.series.get(plot.path);
      if (!series || series.times.length < 2 || !plot.element.isConnected) continue;
      const unit = displayUnit(Math.max(0, ...series.values.map(Math.abs)), series.unit);
      if (plot.chart && unit.text !== plot.unit.text) {
        plot.chart.destroy();
        plot.chart = null;
      }
      plot.unit = unit;
      plot.chart ??= this.makeChart(plot);
      plot.chart.setData([series.times, series.values.map((value) => value / unit.factor)]);
    }
  }

  private makeChart(plot: Plot): uPlot {
    const { unit } = plot;
    const muted = this.themes.colour('muted');
    const grid = { stroke: this.themes.colour('line'), width: 1 };
    const font = '11px system-ui, sans-serif';
    return new uPlot(
      {
        width: Math.max(150, this.list.clientWidth || 230),
        height: plotHeight,
        legend: { show: false },
        cursor: { y: false },
        scales: { x: { time: false } },
        axes: [
          { stroke: muted, grid, ticks: grid, font, size: 22, space: 45 },
          {
            stroke: muted,
            grid,
            ticks: grid,
            font,
            size: 52,
            space: 24,
            label: unit.text,
            labelSize: unit.text ? 14 : 0,
            labelFont: font,
            labelGap: 0,
            values: (_, ticks) => ticks.map((tick) => formatNumber(tick, 3)),
          },
        ],
        series: [{}, { stroke: this.themes.colour('accent'), width: 1.5, points: { show: false } }],
      },
      [[], []],
      plot.element,
    );
  }

  private rebuild(): void {
    for (const plot of this.plots.values()) {
      plot.chart?.destroy();
      plot.chart = null;
    }
    this.draw();
  }
}

// A number, or the length of a vector such as "0 0 1.5 N".
function sizeOf(text: string, unit: string): number {
  const single = parseQuantity(text, unit);
  if (Number.isFinite(single)) return single;
  const parts = text.trim().split(/\s+/);
  const last = parseQuantity(parts.slice(2).join(' '), unit);
  if (parts.length < 3 || !Number.isFinite(last)) return NaN;
  const scale = Number(parts[2]) ? last / Number(parts[2]) : 1;
  return Math.hypot(Number(parts[0]) * scale, Number(parts[1]) * scale, last);
}

// The last two parts of a path.
function shortName(path: string): string {
  return path.split('/').slice(-2).join('/');
}
