// SPDX-License-Identifier: Apache-2.0
// The perceptual colour map "viridis" (van der Walt and Smith, 2015), 17 of its colours with linear
// interpolation between them: legible to the colour-blind and when printed in grey.

const table = [
  0x440154, 0x481467, 0x482677, 0x453781, 0x3f4788, 0x39558c, 0x32648e, 0x2d718e, 0x287d8e,
  0x238a8d, 0x1f968b, 0x29af7f, 0x3dbc74, 0x56c667, 0x84d44b, 0xb8de29, 0xfde725,
];

// Well-told-apart colours of pieces (Okabe and Ito, 2008).
export const pieceColours = [
  0x56b4e9, 0xe69f00, 0x009e73, 0xf0e442, 0xcc79a7, 0xd55e00, 0x0072b2, 0x999999,
];

export type Rgb = [number, number, number];

export function rgbOf(hex: number): Rgb {
  return [((hex >> 16) & 255) / 255, ((hex >> 8) & 255) / 255, (hex & 255) / 255];
}

const colours = table.map(rgbOf);

// The colour (sRGB, 0 to 1) of a value between 0 and 1; what lies outside is clamped.
export function viridis(value: number): Rgb {
  const place = Math.min(1, Math.max(0, Number.isNaN(value) ? 0 : value)) * (colours.length - 1);
  const below = Math.min(colours.length - 2, Math.floor(place));
  const part = place - below;
  const a = colours[below]!;
  const b = colours[below + 1]!;
  return [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + (b[2] - a[2]) * part];
}

export function toLinear(c: number): number {
  return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
}

// 256 entries of linear-light r, g, b: what a vertex colour holds.
export const linearTable = (() => {
  const out = new Float32Array(256 * 3);
  for (let i = 0; i < 256; i++) {
    viridis(i / 255).forEach((c, k) => (out[3 * i + k] = toLinear(c)));
  }
  return out;
})();

export function cssGradient(): string {
  const stops = colours.map((c) => `rgb(${c.map((x) => Math.round(x * 255)).join(' ')})`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

export interface Range {
  low: number;
  high: number;
}

// An end of a range as it is written: what is nothing against the whole is 0.
export function shownEnd(end: number, range: Range): number {
  return Math.abs(end) < 1e-3 * Math.abs(range.high - range.low) ? 0 : end;
}

// Range of the finite values, widened where it is a point; null where there are none.
export function rangeOf(values: ArrayLike<number>): Range | null {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; i++) {
    const value = values[i]!;
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return null;
  return { low, high };
}

// Writes the linear colour of each value to `to`, 3 numbers each.
export function paint(values: ArrayLike<number>, range: Range, to: Float32Array): void {
  const scale = range.high > range.low ? 255 / (range.high - range.low) : 0;
  for (let i = 0; i < values.length; i++) {
    const place = Math.round((values[i]! - range.low) * scale);
    const k = 3 * (place > 0 ? (place < 255 ? place : 255) : 0);
    to[3 * i] = linearTable[k]!;
    to[3 * i + 1] = linearTable[k + 1]!;
    to[3 * i + 2] = linearTable[k + 2]!;
  }
}
