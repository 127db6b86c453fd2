// SPDX-License-Identifier: Apache-2.0

// How often the picture is drawn and frames arrive, over the last two seconds.
export class Rates {
  private drawn: { at: number; cost: number }[] = [];
  private arrived: number[] = [];

  noteDrawn(cost: number): void {
    this.drawn.push({ at: performance.now(), cost });
    if (this.drawn.length > 400) this.drawn.splice(0, 200);
  }

  noteFrame(): void {
    this.arrived.push(performance.now());
    if (this.arrived.length > 400) this.arrived.splice(0, 200);
  }

  summary(): { rate: number; p99: number; frames: number } {
    const since = performance.now() - 2000;
    const drawn = this.drawn.filter(({ at }) => at > since);
    const costs = drawn.map(({ cost }) => cost).sort((a, b) => a - b);
    return {
      rate: drawn.length / 2,
      p99: costs.length ? costs[Math.min(costs.length - 1, Math.floor(0.99 * costs.length))]! : 0,
      frames: this.arrived.filter((at) => at > since).length / 2,
    };
  }
}
