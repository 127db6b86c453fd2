// SPDX-License-Identifier: Apache-2.0
// Binary messages to typed arrays. Pure functions: what is wrong with a message is thrown.
import type { ToolFrame, Vec3 } from './protocol';

export interface ArrayHeader {
  name: string;
  type: 'f32' | 'u32' | 'u8' | 'u16box';
  count: number;
  offset: number;
  low?: Vec3;
  high?: Vec3;
  field?: string;
}

export interface TopologyHeader {
  generation: number;
  body: number;
  revision: number;
  arrays: ArrayHeader[];
}

export interface FrameHeader {
  generation: number;
  time: number;
  step: number;
  bodies: { body: number; revision: number; arrays: ArrayHeader[] }[];
  tools: ToolFrame[];
}

export type BinaryMessage =
  | { kind: 'topology'; header: TopologyHeader; payload: ArrayBuffer; start: number }
  | { kind: 'frame'; header: FrameHeader; payload: ArrayBuffer; start: number };

const elementBytes = { f32: 4, u32: 4, u8: 1, u16box: 2 } as const;

export function decodeMessage(data: ArrayBuffer): BinaryMessage {
  if (data.byteLength < 8) throw new Error('a binary message is too short');
  const view = new DataView(data);
  const kind = view.getUint32(0, true);
  const bytes = view.getUint32(4, true);
  if (bytes % 4 !== 0 || 8 + bytes > data.byteLength) {
    throw new Error('a binary message has a header of wrong size');
  }
  const header: unknown = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 8, bytes)));
  const start = 8 + bytes;
  if (kind === 1) {
    return { kind: 'topology', header: header as TopologyHeader, payload: data, start };
  }
  if (kind === 2) return { kind: 'frame', header: header as FrameHeader, payload: data, start };
  throw new Error(`a binary message is of unknown kind ${kind}`);
}

function checkRange(array: ArrayHeader, message: BinaryMessage): number {
  const size = elementBytes[array.type];
  if (size === undefined) throw new Error(`array '${array.name}' is of unknown type`);
  const from = message.start + array.offset;
  if (array.offset % 4 !== 0 || from + array.count * size > message.payload.byteLength) {
    throw new Error(`array '${array.name}' leaves its message`);
  }
  return from;
}

// The numbers of a plain array, as a view of the message.
export function floats(array: ArrayHeader, message: BinaryMessage): Float32Array {
  if (array.type !== 'f32') throw new Error(`array '${array.name}' is not of type f32`);
  return new Float32Array(message.payload, checkRange(array, message), array.count);
}

export function indices(array: ArrayHeader, message: BinaryMessage): Uint32Array {
  if (array.type !== 'u32') throw new Error(`array '${array.name}' is not of type u32`);
  return new Uint32Array(message.payload, checkRange(array, message), array.count);
}

export function bytes(array: ArrayHeader, message: BinaryMessage): Uint8Array {
  if (array.type !== 'u8') throw new Error(`array '${array.name}' is not of type u8`);
  return new Uint8Array(message.payload, checkRange(array, message), array.count);
}

// Positions, 3 numbers a point, written to `to` if that has the right size, else to a new array.
export function positions(
  array: ArrayHeader,
  message: BinaryMessage,
  to?: Float32Array,
): Float32Array {
  const out = to && to.length === array.count ? to : new Float32Array(array.count);
  if (array.type === 'f32') {
    out.set(floats(array, message));
    return out;
  }
  if (array.type !== 'u16box' || !array.low || !array.high) {
    throw new Error(`array '${array.name}' holds no positions`);
  }
  const packed = new Uint16Array(message.payload, checkRange(array, message), array.count);
  const [lx, ly, lz] = array.low;
  const [hx, hy, hz] = array.high;
  const sx = (hx - lx) / 65535;
  const sy = (hy - ly) / 65535;
  const sz = (hz - lz) / 65535;
  for (let i = 0; i + 2 < packed.length; i += 3) {
    out[i] = lx + sx * packed[i]!;
    out[i + 1] = ly + sy * packed[i + 1]!;
    out[i + 2] = lz + sz * packed[i + 2]!;
  }
  return out;
}

export function findArray(arrays: ArrayHeader[], name: string): ArrayHeader | undefined {
  return arrays.find((array) => array.name === name);
}
