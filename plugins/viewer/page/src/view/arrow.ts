// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';

// A solid arrow from a point along a vector.
export class Arrow {
  readonly group = new THREE.Group();
  private readonly shaft: THREE.Mesh;
  private readonly head: THREE.Mesh;

  constructor(
    material: THREE.Material,
    private readonly thickness: number,
  ) {
    const shaft = new THREE.CylinderGeometry(1, 1, 1, 12);
    shaft.rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const head = new THREE.ConeGeometry(1, 1, 16);
    head.rotateX(Math.PI / 2).translate(0, 0, 0.5);
    this.shaft = new THREE.Mesh(shaft, material);
    this.head = new THREE.Mesh(head, material);
    this.group.add(this.shaft, this.head);
    this.group.visible = false;
  }

  set(from: THREE.Vector3, vector: THREE.Vector3): void {
    const length = vector.length();
    this.group.visible = length > 0.5 * this.thickness;
    if (!this.group.visible) return;
    const head = Math.min(0.4 * length, 4.5 * this.thickness);
    this.shaft.scale.set(this.thickness * 0.5, this.thickness * 0.5, length - head);
    this.head.scale.set(this.thickness * 1.3, this.thickness * 1.3, head);
    this.head.position.set(0, 0, length - head);
    this.group.position.copy(from);
    this.group.quaternion.setFromUnitVectors(
      new THREE.Vector3(0, 0, 1),
      vector.clone().divideScalar(length),
    );
  }
}
