// SPDX-License-Identifier: Apache-2.0
import type { Body } from '../model';
import type { SceneInfo } from '../protocol';

// What bodies are coloured by: "" (tissue), "piece", "texture", or the name of a field, published by
// the simulation or derived here from what is seen ("displacement", "speed").
export interface ColourChoice {
  name: string;
  unit: string;
  label: string;
}

export const derivedFields: ColourChoice[] = [
  { name: 'displacement', unit: 'm', label: 'displacement' },
  { name: 'speed', unit: 'm/s', label: 'speed' },
];

export function colourChoices(scene: SceneInfo, hasTexture: boolean): ColourChoice[] {
  const choices: ColourChoice[] = [{ name: '', unit: '', label: 'tissue' }];
  if (hasTexture) choices.push({ name: 'texture', unit: '', label: 'texture' });
  const fields = new Map<string, ColourChoice>();
  for (const body of scene.bodies) {
    for (const field of body.fields) {
      fields.set(field.name, {
        name: field.name,
        unit: field.unit ?? '',
        label: readable(field.name),
      });
    }
  }
  for (const field of derivedFields) if (!fields.has(field.name)) fields.set(field.name, field);
  choices.push(...fields.values());
  if (!fields.has('piece')) choices.push({ name: 'piece', unit: '', label: 'piece' });
  return choices;
}

// "volumeRatio" to "volume ratio".
export function readable(name: string): string {
  if (name === 'vonMises') return 'von Mises stress';
  return name
    .replace(/[_-]+/g, ' ')
    .replace(/([a-z])([A-Z])/g, (_, a: string, b: string) => `${a} ${b.toLowerCase()}`)
    .trim();
}

// Whether the simulation has to send the field of this name for the body.
export function isSent(body: Body, name: string): boolean {
  return body.info.fields.some((field) => field.name === name);
}

// The value at each point of a body; null where it has none.
export function valuesOf(body: Body, name: string): Float32Array | null {
  if (isSent(body, name)) return body.fieldName === name ? body.field : null;
  const { position, topology, velocity } = body;
  if (!position || !topology) return null;
  if (name === 'displacement') {
    if (topology.rest.length !== position.length) return null;
    return lengths(position, topology.rest);
  }
  if (name === 'speed') return velocity ? lengths(velocity) : new Float32Array(position.length / 3);
  return null;
}

function lengths(a: Float32Array, b?: Float32Array): Float32Array {
  const out = new Float32Array(a.length / 3);
  for (let i = 0; i < out.length; i++) {
    out[i] = Math.hypot(
      a[3 * i]! - (b ? b[3 * i]! : 0),
      a[3 * i + 1]! - (b ? b[3 * i + 1]! : 0),
      a[3 * i + 2]! - (b ? b[3 * i + 2]! : 0),
    );
  }
  return out;
}
