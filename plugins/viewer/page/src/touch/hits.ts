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

// The first triangle that a ray meets.
export function firstHit(ray: THREE.Ray, surfaces: FrozenSurface[]): Hit | null {
  const corners = new THREE.Triangle();
  const at = new THREE.Vector3();
  let nearest = Infinity;
  let hit: Hit | null = null;
  for (const surface of surfaces) {
    const { position, triangles } = surface;
    for (let t = 0; t < triangles.length; t += 3) {
      corners.a.fromArray(position, 3 * triangles[t]!);
      corners.b.fromArray(position, 3 * triangles[t + 1]!);
      corners.c.fromArray(position, 3 * triangles[t + 2]!);
      if (!ray.intersectTriangle(corners.a, corners.b, corners.c, false, at)) continue;
      const distance = at.distanceTo(ray.origin);
      if (distance === 0 || distance >= nearest) continue;
      nearest = distance;
      hit = { surface, point: at.clone(), normal: normalAt(surface, t, corners, at, ray.direction) };
    }
  }
  return hit;
}

// The side that is seen is the outer one; where there is no normal, it is the way back to the eye.
function normalAt(
  surface: FrozenSurface,
  t: number,
  corners: THREE.Triangle,
  at: THREE.Vector3,
  direction: THREE.Vector3,
): THREE.Vector3 {
  const weights = corners.getBarycoord(at, new THREE.Vector3());
  const out = new THREE.Vector3();
  const corner = new THREE.Vector3();
  weights?.toArray().forEach((weight, k) => {
    corner.fromArray(surface.normals, 3 * surface.triangles[t + k]!);
    out.addScaledVector(corner, weight);
  });
  if (out.lengthSq() < 0.01) return out.copy(direction).negate();
  if (out.dot(direction) > 0) out.negate();
  return out.normalize();
}
