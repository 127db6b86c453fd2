// SPDX-License-Identifier: Apache-2.0
import type { Attribute } from '../protocol';
import { parseQuantity } from '../quantity';

// Between a place on a slider (0 to 1) and a value.
export interface SliderScale {
  low: number;
  high: number;
  value(place: number): number;
  place(value: number): number;
}

// The range is the declared one; where an end is open, a decade round the default and the value.
// Ranges over more than two decades are logarithmic. Null where a slider makes no sense.
export function sliderScale(attribute: Attribute, value: number): SliderScale | null {
  const usual = parseQuantity(attribute.default ?? '', attribute.unit ?? '');
  const known = [value, usual].filter((x) => Number.isFinite(x));
  if (known.length === 0) return null;
  const size = Math.max(...known.map(Math.abs)) || 1;
  const { min, max } = attribute;
  const positive = min !== undefined && min >= 0;
  const above = min === 0 && attribute.exclusiveMin === true && value > 0;
  let low: number;
  let high: number;
  if (min !== undefined && max !== undefined && !(above && max / value > 1e4)) {
    [low, high] = [above ? Math.min(value, max / 1e3) : min, max];
  } else if (positive) {
    const sizes = known.filter((x) => x > 0);
    low = min > 0 ? min : above ? Math.min(...sizes) / 10 : 0;
    high = max !== undefined ? Math.min(max, 10 * size) : 10 * size;
  } else {
    low = min ?? -3 * size;
    high = max ?? 3 * size;
  }
  if (!(high > low) || !Number.isFinite(low) || !Number.isFinite(high)) return null;
  const logarithmic = low > 0 && (above || high / low > 100);
  if (logarithmic) {
    const ratio = Math.log(high / low);
    return {
      low,
      high,
      value: (place) => low * Math.exp(ratio * place),
      place: (x) => clamp(Math.log(x / low) / ratio),
    };
  }
  return {
    low,
    high,
    value: (place) => low + (high - low) * place,
    place: (x) => clamp((x - low) / (high - low)),
  };
}

function clamp(place: number): number {
  return Number.isFinite(place) ? Math.min(1, Math.max(0, place)) : 0;
}
