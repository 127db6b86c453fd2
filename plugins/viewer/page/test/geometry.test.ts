// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Ray, Vector3 } from 'three';
import { enclosedVolume, type Body } from '../src/model';
import { firstHit, freeze } from '../src/touch/hits';
import { bladePose, pressPose, pushedPose } from '../src/touch/poses';
import { cuttingSide, kindOf } from '../src/tool_kind';
import { smoothNormals, splitCorners } from '../src/view/corners';

const cube = Float32Array.from([
  0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,
]);
const cubeTriangles = Uint32Array.from([
  0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4,
  3, 4, 7,
]);

test('edgesOfACubeStaySharp', () => {
  const drawn = splitCorners(cube, cubeTriangles, null);
  assert.equal(drawn.points.length, 24);
  const position = new Float32Array(72);
  drawn.points.forEach((p, v) => position.set(cube.subarray(3 * p, 3 * p + 3), 3 * v));
  const normals = new Float32Array(72);
  smoothNormals(position, drawn.index, normals);
  for (let v = 0; v < 24; v++) {
    const n = [...normals.subarray(3 * v, 3 * v + 3)].map(Math.abs).sort();
    assert.deepEqual(n, [0, 0, 1]);
  }
});

test('wallsHaveVerticesOfTheirOwnAndComeLast', () => {
  const flat = Float32Array.from([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
  const triangles = Uint32Array.from([0, 1, 2, 0, 2, 3]);
  assert.equal(splitCorners(flat, triangles, null).points.length, 4);
  const drawn = splitCorners(flat, triangles, Uint8Array.from([1, 0]));
  assert.equal(drawn.points.length, 6);
  assert.equal(drawn.outerTriangles, 1);
  assert.deepEqual(
    [...drawn.index.subarray(0, 3)].map((v) => drawn.points[v]),
    [0, 2, 3],
  );
});

test('volumeOfACubeIsOne', () => {
  assert.ok(Math.abs(enclosedVolume(cube, cubeTriangles) - 1) < 1e-12);
});

test('raysMeetTheNearestTriangle', () => {
  const body = { topology: { triangles: cubeTriangles }, position: cube } as unknown as Body;
  const surfaces = freeze([body]);
  const hit = firstHit(new Ray(new Vector3(0.3, 0.4, 5), new Vector3(0, 0, -1)), surfaces)!;
  assert.ok(hit.point.distanceTo(new Vector3(0.3, 0.4, 1)) < 1e-12);
  assert.ok(hit.normal.z > 0.5);
  assert.equal(firstHit(new Ray(new Vector3(3, 0, 5), new Vector3(0, 0, -1)), surfaces), null);
});

test('aProbeTouchesWithItsLowestPoint', () => {
  const pose = pressPose(new Vector3(1, 2, 3), new Vector3(0, 0, 1), 0.2, 0.5);
  assert.ok(pose.p.distanceTo(new Vector3(1, 2, 3.3)) < 1e-12);
  assert.ok(new Vector3(0, 0, 1).applyQuaternion(pose.q).z > 0.999999);
});

test('aBladeLooksWhereItGoes', () => {
  for (const side of [1, -1] as const) {
    const along = new Vector3(0, 1, 0);
    const pose = bladePose(new Vector3(), new Vector3(0, 0, 1), along, 0.1, side);
    const cuts = new Vector3(side, 0, 0).applyQuaternion(pose.q);
    assert.ok(cuts.dot(along) > 0.95, 'cuts along the stroke');
    const handle = new Vector3(0, 0, 1).applyQuaternion(pose.q);
    assert.ok(handle.z > 0.95 && handle.dot(along) < 0, 'handle up and back');
    assert.ok(Math.abs(new Vector3(0, 1, 0).applyQuaternion(pose.q).dot(along)) < 1e-9);
    assert.ok(Math.abs(pose.p.z + 0.1) < 1e-12);
  }
});

test('aSlitKnifeLiesFlat', () => {
  const along = new Vector3(1, 0, 0);
  const pose = pushedPose(new Vector3(), new Vector3(0, 0, 1), along, 0);
  const blade = new Vector3(0, 1, 0).applyQuaternion(pose.q);
  const axis = new Vector3(0, 0, -1).applyQuaternion(pose.q);
  assert.ok(axis.dot(along) > 0.9, 'points where it goes');
  assert.ok(Math.abs(blade.dot(along)) < 0.5 && Math.abs(blade.z) > 0.9, 'flat to the surface');
});

test('toolsAreKnownByTheirShape', () => {
  const tool = { path: '/t', type: 'T', device: '', mouse: true, radius: 0, samples: [] };
  const withEdge = (...corners: [number, number][]) => ({
    ...tool,
    edge: corners.map(([x, z]): [number, number, number] => [x, 0, z]),
  });
  assert.equal(kindOf({ ...withEdge(), radius: 1, type: 'ProbeTool' }), 'probe');
  assert.equal(kindOf({ ...withEdge(), radius: 1, type: 'GripTool' }), 'grip');
  assert.equal(kindOf(withEdge([0.1, 1], [0, 0])), 'blade');
  assert.equal(kindOf(withEdge([0, 1], [0, 0])), 'blade');
  assert.equal(kindOf(withEdge([0.5, 1], [0, 0], [-0.5, 1])), 'pushed');
  assert.equal(kindOf(withEdge([1, 0], [0, 1], [-1, 0], [0, -1], [1, 0])), 'punch');
  assert.equal(cuttingSide(withEdge([-0.1, 1], [0, 0])), -1);
});
