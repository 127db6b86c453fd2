// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

// The eye: orbits a target. It stays where it is when a scene is read again.
export class CameraControl {
  readonly object = new THREE.PerspectiveCamera(32, 1, 0.001, 10);
  readonly controls: OrbitControls;
  private home: { position: THREE.Vector3; target: THREE.Vector3 } | null = null;

  constructor(canvas: HTMLCanvasElement, changed: () => void) {
    this.object.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.object, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', changed);
    this.setLeftOrbits(true);
  }

  setAspect(aspect: number): void {
    this.object.aspect = aspect;
    this.object.updateProjectionMatrix();
  }

  // Whether the left button is the eye's. Where it is a tool's, the right one orbits (and the left
  // one with Alt, which does not come here otherwise).
  setLeftOrbits(left: boolean): void {
    this.controls.mouseButtons = {
      LEFT: THREE.MOUSE.ROTATE,
      MIDDLE: THREE.MOUSE.PAN,
      RIGHT: left ? THREE.MOUSE.PAN : THREE.MOUSE.ROTATE,
    };
  }

  // A view that shows a box from a direction; where `goHome` leads to from then on.
  frame(box: THREE.Box3, from: THREE.Vector3): void {
    const size = box.getSize(new THREE.Vector3()).length() || 1;
    const target = box.getCenter(new THREE.Vector3());
    const angle = (this.object.fov * Math.PI) / 360;
    const narrow = Math.min(1, this.object.aspect);
    const distance = (0.5 * size * 1.05) / (Math.sin(angle) * narrow);
    const position = target.clone().addScaledVector(from.clone().normalize(), distance);
    this.setReach(size);
    this.home = { position, target };
    this.goHome();
  }

  // Near and far plane and zoom limits for a scene of this size (m).
  setReach(size: number): void {
    this.object.near = size * 0.01;
    this.object.far = size * 60;
    this.controls.minDistance = size * 0.05;
    this.controls.maxDistance = size * 20;
    this.object.updateProjectionMatrix();
  }

  place(position: THREE.Vector3, target: THREE.Vector3, fov?: number): void {
    if (fov) this.object.fov = fov;
    this.object.updateProjectionMatrix();
    this.object.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
  }

  goHome(): void {
    if (this.home) this.place(this.home.position, this.home.target);
  }

  state(): { position: number[]; target: number[]; fov: number } {
    return {
      position: this.object.position.toArray(),
      target: this.controls.target.toArray(),
      fov: this.object.fov,
    };
  }
}
