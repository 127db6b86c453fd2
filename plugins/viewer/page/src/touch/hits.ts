// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Body } from '../model';
import { smoothNormals } from '../view/corners';

// A surface as it is at one moment: what a stroke goes along must not follow what the stroke does.
export interface FrozenSurface {
  body: Body;
  position: Float32Array;
  triangles: Uint32Array;
  normals: Float32Array;
}

export interface Hit {
  surface: FrozenSurface;
  point: THREE.Vector3;
  normal: THREE.Vector3; // unit, smooth, outward
}

export function freeze(bodies: Body[]): FrozenSurface[] {
  const out: FrozenSurface[] = [];
  for (const body of bodies) {
    if (!body.topology || !body.position) continue;
    const position = body.position.slice();
    const { triangles, walls } = body.topology;
    const normals = new Float32Array(position.length);
    smoothNormals(position, walls ? outerOf(triangles, walls) : triangles, normals);
    out.push({ body, position, triangles, normals });
  }
  return out;
}

// Without the sides of incisions, whose normals do not tell how a tool is held.
function outerOf(triangles: Uint32Array, walls: Uint8Array): Uint32Array {
  return triangles.filter((_, corner) => !walls[Math.floor(corner / 3)]);
}

// The first triangle that a ray meets (Möller and Trumbore, 1997).
export function firstHit(ray: THREE.Ray, surfaces: FrozenSurface[]): Hit | null {
  const { x: ox, y: oy, z: oz } = ray.origin;
  const { x: dx, y: dy, z: dz } = ray.direction;
  let nearest = Infinity;
  let found: { surface: FrozenSurface; t: number; u: number; v: number } | null = null;
  for (const surface of surfaces) {
    const { position: p, triangles } = surface;
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t]!,
        b = 3 * triangles[t + 1]!,
        c = 3 * triangles[t + 2]!;
      const ax = p[a]!,
        ay = p[a + 1]!,
        az = p[a + 2]!;
      const e1x = p[b]! - ax,
        e1y = p[b + 1]! - ay,
        e1z = p[b + 2]! - az;
      const e2x = p[c]! - ax,
        e2y = p[c + 1]! - ay,
        e2z = p[c + 2]! - az;
      const hx = dy * e2z - dz * e2y,
        hy = dz * e2x - dx * e2z,
        hz = dx * e2y - dy * e2x;
      const det = e1x * hx + e1y * hy + e1z * hz;
      if (det === 0) continue;
      const sx = ox - ax,
        sy = oy - ay,
        sz = oz - az;
      const u = (sx * hx + sy * hy + sz * hz) / det;
      if (u < 0 || u > 1) continue;
      const qx = sy * e1z - sz * e1y,
        qy = sz * e1x - sx * e1z,
        qz = sx * e1y - sy * e1x;
      const v = (dx * qx + dy * qy + dz * qz) / det;
      if (v < 0 || u + v > 1) continue;
      const distance = (e2x * qx + e2y * qy + e2z * qz) / det;
      if (distance > 0 && distance < nearest) {
        nearest = distance;
        found = { surface, t, u, v };
      }
    }
  }
  if (!found) return null;
  return {
    surface: found.surface,
    point: ray.at(nearest, new THREE.Vector3()),
    normal: normalAt(found.surface, found.t, found.u, found.v, ray.direction),
  };
}

// The side that is seen is the outer one; where there is no normal, it is the way back to the eye.
function normalAt(
  surface: FrozenSurface,
  t: number,
  u: number,
  v: number,
  ray: THREE.Vector3,
): THREE.Vector3 {
  const out = new THREE.Vector3();
  const corner = new THREE.Vector3();
  [1 - u - v, u, v].forEach((weight, k) => {
    corner.fromArray(surface.normals, 3 * surface.triangles[t + k]!);
    out.addScaledVector(corner, weight);
  });
  if (out.lengthSq() < 0.01) return out.copy(ray).negate();
  if (out.dot(ray) > 0) out.negate();
  return out.normalize();
}
