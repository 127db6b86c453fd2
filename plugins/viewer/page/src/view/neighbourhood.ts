// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Body, Model } from '../model';

// The picked particle, its neighbours and the bonds between them.
export class Neighbourhood {
  readonly group = new THREE.Group();
  body: Body | null = null;
  particle = -1;
  ids: number[] = [];
  private readonly bonds = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: 0xf0a020, depthTest: false, transparent: true }),
  );
  private readonly dots = new THREE.Points(
    new THREE.BufferGeometry(),
    new THREE.PointsMaterial({
      color: 0xf0a020,
      size: 7,
      sizeAttenuation: false,
      depthTest: false,
      transparent: true,
    }),
  );

  constructor(private readonly model: Model) {
    this.bonds.frustumCulled = this.dots.frustumCulled = false;
    this.bonds.renderOrder = this.dots.renderOrder = 10;
    this.group.add(this.bonds, this.dots);
    this.group.visible = false;
  }

  show(body: Body, particle: number, ids: number[]): void {
    this.body = body;
    this.particle = particle;
    this.ids = ids;
    this.update();
  }

  clear(): void {
    this.body = null;
    this.particle = -1;
    this.ids = [];
    this.group.visible = false;
  }

  update(): void {
    const position = this.body && this.model.bodies.get(this.body.info.id)?.position;
    this.group.visible = !!position;
    if (!position) return;
    const at = (i: number): number[] => [...position.subarray(3 * i, 3 * i + 3)];
    const lines: number[] = [];
    const dots = at(this.particle);
    for (const id of this.ids) {
      if (id === this.particle || 3 * id + 2 >= position.length) continue;
      lines.push(...at(this.particle), ...at(id));
      dots.push(...at(id));
    }
    replace(this.bonds, lines);
    replace(this.dots, dots);
  }
}

function replace(object: THREE.LineSegments | THREE.Points, points: number[]): void {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry();
  object.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
}
