// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Body } from '../model';

export type VectorChoice = 'none' | 'displacement' | 'velocity';

const mostArrows = 1200;

// Arrows at some points of a body: a shaft and two strokes for the head.
export class VectorsView {
  readonly lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;

  constructor() {
    this.lines = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: 0xd9822b }),
    );
    this.lines.frustumCulled = false;
    this.lines.visible = false;
  }

  setClipping(planes: THREE.Plane[]): void {
    this.lines.material.clippingPlanes = planes;
  }

  // The longest arrow is `longest` metres, or as long as what it shows where `trueLength`.
  update(bodies: Body[], choice: VectorChoice, longest: number, trueLength: boolean): void {
    this.lines.visible = choice !== 'none';
    if (choice === 'none') return;
    const out: number[] = [];
    for (const body of bodies) {
      const vectors = vectorsOf(body, choice);
      if (vectors && body.position) addArrows(body.position, vectors, longest, trueLength, out);
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry();
    this.lines.geometry.setAttribute('position', new THREE.Float32BufferAttribute(out, 3));
  }
}

function vectorsOf(body: Body, choice: VectorChoice): Float32Array | null {
  if (choice === 'velocity') return body.velocity;
  const rest = body.topology?.rest;
  if (!rest || !body.position || rest.length !== body.position.length) return null;
  const { positionStep } = body;
  return body.position.map((x, i) => {
    const way = x - rest[i]!;
    return Math.abs(way) > positionStep ? way : 0;
  });
}

function addArrows(
  position: Float32Array,
  vectors: Float32Array,
  longest: number,
  trueLength: boolean,
  out: number[],
): void {
  const count = position.length / 3;
  const stride = Math.max(1, Math.ceil(count / mostArrows));
  let largest = 0;
  for (let i = 0; i < vectors.length; i += 3) {
    largest = Math.max(largest, Math.hypot(vectors[i]!, vectors[i + 1]!, vectors[i + 2]!));
  }
  if (largest === 0) return;
  const scale = trueLength ? 1 : longest / largest;
  const from = new THREE.Vector3();
  const along = new THREE.Vector3();
  const side = new THREE.Vector3();
  for (let i = 0; i < count; i += stride) {
    from.fromArray(position, 3 * i);
    along.fromArray(vectors, 3 * i).multiplyScalar(scale);
    if (along.length() < 0.03 * longest) continue;
    const tip = from.clone().add(along);
    side.set(along.y, -along.x, 0);
    if (side.lengthSq() < 1e-6 * along.lengthSq()) side.set(0, along.z, 0);
    side.normalize().multiplyScalar(0.12 * along.length());
    const base = from.clone().addScaledVector(along, 0.75);
    out.push(...from.toArray(), ...tip.toArray());
    out.push(...tip.toArray(), ...base.clone().add(side).toArray());
    out.push(...tip.toArray(), ...base.sub(side).toArray());
  }
}
