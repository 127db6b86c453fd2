// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  bytes,
  decodeMessage,
  findArray,
  floats,
  indices,
  positions,
  type ArrayHeader,
} from '../src/decode';

// A message as the viewer packs it.
function pack(kind: number, header: object, payload: Uint8Array): ArrayBuffer {
  let text = JSON.stringify(header);
  while (text.length % 4) text += ' ';
  const out = new Uint8Array(8 + text.length + payload.length);
  const view = new DataView(out.buffer);
  view.setUint32(0, kind, true);
  view.setUint32(4, text.length, true);
  out.set(new TextEncoder().encode(text), 8);
  out.set(payload, 8 + text.length);
  return out.buffer;
}

const f32: ArrayHeader = { name: 'rest', type: 'f32', count: 3, offset: 0 };
const u32: ArrayHeader = { name: 'triangles', type: 'u32', count: 3, offset: 12 };
const u8: ArrayHeader = { name: 'walls', type: 'u8', count: 1, offset: 24 };
const topology = (): ArrayBuffer => {
  const payload = new Uint8Array(28);
  payload.set(new Uint8Array(Float32Array.of(0.5, -1, 2).buffer), 0);
  payload.set(new Uint8Array(Uint32Array.of(0, 2, 1).buffer), 12);
  payload[24] = 1;
  return pack(1, { generation: 1, body: 4, revision: 7, arrays: [f32, u32, u8] }, payload);
};

test('topologyKeepsItsNumbers', () => {
  const message = decodeMessage(topology());
  assert.equal(message.kind, 'topology');
  assert.deepEqual([...floats(f32, message)], [0.5, -1, 2]);
  assert.deepEqual([...indices(u32, message)], [0, 2, 1]);
  assert.deepEqual([...bytes(u8, message)], [1]);
  assert.equal(findArray([f32, u32], 'triangles'), u32);
});

test('boxedPositionsAreWithinHalfAStep', () => {
  const low: [number, number, number] = [-1, 0, 3e-3];
  const high: [number, number, number] = [1, 10, 4e-3];
  const truth = [-0.123, 7.77, 3.21e-3, 1, 0, 4e-3];
  const packed = Uint16Array.from(truth, (x, i) =>
    Math.round(((x - low[i % 3]!) / (high[i % 3]! - low[i % 3]!)) * 65535),
  );
  const array: ArrayHeader = { name: 'position', type: 'u16box', count: 6, offset: 0, low, high };
  const header = {
    generation: 1,
    time: 0,
    step: 0,
    bodies: [{ body: 1, revision: 1, arrays: [array] }],
    tools: [],
  };
  const message = decodeMessage(pack(2, header, new Uint8Array(packed.buffer)));
  const found = positions(array, message);
  truth.forEach((x, i) => {
    const step = (high[i % 3]! - low[i % 3]!) / 65535;
    assert.ok(Math.abs(found[i]! - x) <= 0.5 * step + 1e-6 * Math.abs(x), `${found[i]} for ${x}`);
  });
});

test('positionsAreWrittenInPlaceWhereTheyFit', () => {
  const message = decodeMessage(topology());
  const kept = new Float32Array(3);
  assert.equal(positions(f32, message, kept), kept);
  assert.deepEqual([...kept], [0.5, -1, 2]);
});

test('damagedMessagesAreRefused', () => {
  assert.throws(() => decodeMessage(new ArrayBuffer(4)), /too short/);
  const wrongSize = topology();
  new DataView(wrongSize).setUint32(4, 4000, true);
  assert.throws(() => decodeMessage(wrongSize), /wrong size/);
  const wrongKind = topology();
  new DataView(wrongKind).setUint32(0, 9, true);
  assert.throws(() => decodeMessage(wrongKind), /unknown kind 9/);
  const message = decodeMessage(topology());
  assert.throws(() => floats({ ...f32, count: 300 }, message), /leaves its message/);
  assert.throws(() => floats({ ...f32, offset: 2 }, message), /leaves its message/);
  assert.throws(() => indices(f32, message), /not of type u32/);
});
