// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { CameraControl } from './camera';

const softwarePause = 90; // ms between two pictures

// Canvas, lights and camera. It is drawn only when something asks for it, at most once a refresh of
// the screen.
export class World {
  readonly renderer: THREE.WebGLRenderer;
  readonly scene = new THREE.Scene();
  readonly camera: CameraControl;
  readonly canvas: HTMLCanvasElement;
  // Called before each picture.
  readonly beforeDrawing: (() => void)[] = [];
  readonly afterDrawing: ((milliseconds: number) => void)[] = [];
  private asked = false;
  private drawnAt = -Infinity;
  private readonly shortestPause: number;
  private readonly sun = new THREE.DirectionalLight(0xffffff, 2.1);
  private readonly fillLight = new THREE.DirectionalLight(0xdfe8ff, 0.7);

  constructor(container: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: false });
    this.renderer.localClippingEnabled = true;
    this.shortestPause = this.pauseOfRenderer();
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('aria-label', 'The scene');
    container.append(this.canvas);
    this.camera = new CameraControl(this.canvas, () => this.draw());
    const sky = new THREE.HemisphereLight(0xffffff, 0x8d9499, 1.15);
    this.scene.add(sky, this.camera.object);
    // the lights go with the eye, as an operating lamp does
    this.sun.position.set(-0.6, 1.1, 0.9);
    this.fillLight.position.set(1.2, -0.5, 0.6);
    this.camera.object.add(this.sun, this.sun.target, this.fillLight, this.fillLight.target);
    this.sun.target.position.set(0, 0, -1);
    this.fillLight.target.position.set(0, 0, -1);
    this.scene.background = new THREE.Color(0xeef0f1);
  }

  setBackground(colour: string): void {
    (this.scene.background as THREE.Color).setStyle(colour);
    this.draw();
  }

  resize(width: number, height: number, ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(Math.max(1, width), Math.max(1, height), true);
    this.camera.setAspect(width / Math.max(1, height));
    this.draw();
  }

  draw(): void {
    if (this.asked) return;
    this.asked = true;
    const wait = this.shortestPause - (performance.now() - this.drawnAt);
    if (wait > 1) window.setTimeout(() => this.drawAtRefresh(), wait);
    else this.drawAtRefresh();
  }

  private drawAtRefresh(): void {
    requestAnimationFrame(() => {
      this.asked = false;
      this.drawNow();
    });
  }

  // A machine that draws without graphics hardware does so on the processors that simulate: fewer
  // pictures leave them more time.
  private pauseOfRenderer(): number {
    const gl = this.renderer.getContext();
    const details = gl.getExtension('WEBGL_debug_renderer_info');
    const name = String(gl.getParameter(details ? details.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    return /swiftshader|llvmpipe|software/i.test(name) ? softwarePause : 0;
  }

  drawNow(): void {
    const begin = performance.now();
    this.drawnAt = begin;
    for (const call of this.beforeDrawing) call();
    this.renderer.render(this.scene, this.camera.object);
    for (const call of this.afterDrawing) call(performance.now() - begin);
  }

  // Where a point of the scene is on the page (CSS pixels).
  screenPoint(point: THREE.Vector3): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    this.camera.object.updateMatrixWorld();
    const p = point.clone().project(this.camera.object);
    return [box.left + ((p.x + 1) / 2) * box.width, box.top + ((1 - p.y) / 2) * box.height];
  }

  ray(clientX: number, clientY: number): THREE.Ray {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(
      ((clientX - box.left) / box.width) * 2 - 1,
      1 - ((clientY - box.top) / box.height) * 2,
    );
    const caster = new THREE.Raycaster();
    this.camera.object.updateMatrixWorld();
    caster.setFromCamera(at, this.camera.object);
    return caster.ray;
  }
}
