// SPDX-License-Identifier: Apache-2.0
// Numbers with units, as the inspector shows and reads them. Values go to the simulation with
// their SI unit, so that the units of a scene's bare numbers do not matter.

const prefixes: [string, number][] = [
  ['n', 1e-9],
  ['µ', 1e-6],
  ['m', 1e-3],
  ['', 1],
  ['k', 1e3],
  ['M', 1e6],
  ['G', 1e9],
];
const factors: Record<string, number> = {
  n: 1e-9,
  u: 1e-6,
  µ: 1e-6,
  μ: 1e-6,
  m: 1e-3,
  c: 1e-2,
  d: 1e-1,
  k: 1e3,
  M: 1e6,
  G: 1e9,
};
// Units that are read more easily with a prefix.
const prefixed = new Set(['m', 's', 'N', 'Pa', 'J', 'W', 'Hz', 'rad', 'm/s']);

export interface DisplayUnit {
  text: string;
  factor: number; // SI in one of it
}

// The unit in which a number near `size` (SI) is shown.
export function displayUnit(size: number, unit: string): DisplayUnit {
  const magnitude = Math.abs(size);
  if (unit === 'kg' && magnitude > 0 && magnitude < 1) {
    return magnitude < 1e-3 ? { text: 'mg', factor: 1e-6 } : { text: 'g', factor: 1e-3 };
  }
  if (!prefixed.has(unit) || !(magnitude > 0) || !Number.isFinite(magnitude)) {
    return { text: unit, factor: 1 };
  }
  let best = prefixes[3]!;
  for (const prefix of prefixes) {
    if (unit === 's' && prefix[1] > 1) break;
    if (unit === 'm' && prefix[1] > 1) break;
    if (magnitude >= prefix[1] * 0.9999 || prefix === prefixes[0]) best = prefix;
  }
  return { text: best[0] + unit, factor: best[1] };
}

// Up to `digits` significant digits, without needless zeros.
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? '–' : value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const magnitude = Math.abs(value);
  const text =
    magnitude >= 1e6 || magnitude < 1e-4
      ? value
          .toExponential(digits - 1)
          .replace(/\.?0+e/, 'e')
          .replace('e+', 'e')
      : String(Number(value.toPrecision(digits)));
  return text.replace('-', '−');
}

export function formatQuantity(value: number, unit: string, digits = 4): string {
  const shown = displayUnit(value, unit);
  const number = formatNumber(value / shown.factor, digits);
  return shown.text ? `${number} ${shown.text}` : number;
}

// The number (SI, or what `unit` says) that a text such as "500 kPa" means; NaN where it is no
// single number with this unit.
export function parseQuantity(text: string, unit: string): number {
  const match = /^\s*([-+−]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$/.exec(text);
  if (!match) return NaN;
  const value = Number(match[1]!.replace('−', '-'));
  const suffix = match[2]!;
  if (suffix === '' || suffix === unit) return value;
  if (unit === 'kg' && suffix === 'g') return value * 1e-3;
  if (unit === 'kg' && suffix === 'mg') return value * 1e-6;
  if (unit !== '' && suffix.endsWith(unit)) {
    const factor = factors[suffix.slice(0, suffix.length - unit.length)];
    return factor === undefined ? NaN : value * factor;
  }
  return NaN;
}

// What is sent for a number.
export function quantityText(value: number, unit: string): string {
  const number = String(Number(value.toPrecision(7)));
  return unit ? `${number} ${unit}` : number;
}

export function formatTime(seconds: number): string {
  return `${seconds.toFixed(3)} s`;
}
