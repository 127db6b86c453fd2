// SPDX-License-Identifier: Apache-2.0
import type { Range } from './colours';
import { Emitter } from './events';
import type { VectorChoice } from './view/vectors';

export type Axis = 'off' | 'x' | 'y' | 'z';

export interface ViewValues {
  colour: string;
  range: Range | null; // null: of what is seen
  surface: boolean;
  particles: boolean;
  walls: boolean;
  ghost: boolean;
  context: boolean;
  forces: boolean;
  vectors: VectorChoice;
  trueLength: boolean;
  slice: Axis;
  sliceAt: number; // 0 to 1 along the bounds
  sliceFlip: boolean;
}

// How the scene is looked at; everything that shows it listens for changes.
export class ViewSettings extends Emitter<{ changed: keyof ViewValues }> {
  readonly values: ViewValues = {
    colour: '',
    range: null,
    surface: true,
    particles: false,
    walls: true,
    ghost: false,
    context: true,
    forces: true,
    vectors: 'none',
    trueLength: false,
    slice: 'off',
    sliceAt: 0.5,
    sliceFlip: false,
  };

  set<K extends keyof ViewValues>(name: K, value: ViewValues[K]): void {
    if (this.values[name] === value) return;
    this.values[name] = value;
    this.emit('changed', name);
  }
}
