// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { kindOf } from '../tool_kind';
import type { Stage } from '../view/stage';
import type { ToolChoice } from './choice';
import { firstHit, freeze, type FrozenSurface } from './hits';
import { bladePose, lifted, pressPose, pushedPose, type ToolPose } from './poses';
import type { PoseSender } from './sender';
import { beginStroke, type Stroke } from './strokes';

// The pointer over the canvas: with a tool chosen the left button (a finger, a pen) acts, all else
// is the camera's. Listens on the canvas' parent before the camera does.
export class Gestures {
  private stroke: Stroke | null = null;
  private pointer = -1;
  private start: [number, number] = [0, 0];
  private hoverAt: [number, number] | null = null;
  private lastHover: [number, number] = [0, 0];
  private frozen: FrozenSurface[] = [];
  private frozenAt: unknown = null;
  private hoverDirection = new THREE.Vector2(1, 0);
  onClick: ((x: number, y: number) => void) | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly choice: ToolChoice,
    private readonly sender: PoseSender,
  ) {
    const area = stage.world.canvas.parentElement!;
    area.addEventListener('pointerdown', (event) => this.down(event), true);
    area.addEventListener('pointermove', (event) => this.moved(event), true);
    area.addEventListener('pointerup', (event) => this.up(event), true);
    area.addEventListener('pointercancel', (event) => this.up(event), true);
    area.addEventListener('pointerleave', () => this.leave());
    area.addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
    area.addEventListener('contextmenu', (event) => event.preventDefault());
    choice.on('changed', () => this.leave());
    stage.world.beforeDrawing.push(() => this.placeGhost());
    stage.model.on('scene', () => this.forget());
  }

  get acting(): boolean {
    return this.stroke !== null;
  }

  private down(event: PointerEvent): void {
    if (event.target !== this.stage.world.canvas) return;
    this.start = [event.clientX, event.clientY];
    const tool = this.choice.tool;
    if (event.button !== 0 || event.altKey || !tool || !this.stage.model.steers) return;
    event.stopPropagation();
    if (this.stroke) return;
    const surfaces = freeze(this.stage.model.surfaces());
    const hit = firstHit(this.stage.world.ray(event.clientX, event.clientY), surfaces);
    if (!hit) return;
    this.stage.world.canvas.setPointerCapture(event.pointerId);
    this.pointer = event.pointerId;
    this.leave();
    this.stroke = beginStroke({
      tool,
      sender: this.sender,
      surfaces,
      hit,
      depth: this.choice.depth,
      size: this.stage.size,
      view: this.stage.world.camera.object.getWorldDirection(new THREE.Vector3()),
    });
  }

  private moved(event: PointerEvent): void {
    if (this.stroke) {
      if (event.pointerId !== this.pointer) return;
      event.stopPropagation();
      const pixels = Math.hypot(event.clientX - this.start[0], event.clientY - this.start[1]);
      this.stroke.move(this.stage.world.ray(event.clientX, event.clientY), pixels);
      return;
    }
    if (!this.choice.tool || event.buttons !== 0 || event.pointerType === 'touch') return;
    const way = new THREE.Vector2(
      event.clientX - this.lastHover[0],
      event.clientY - this.lastHover[1],
    );
    if (way.length() > 2) {
      this.hoverDirection.lerp(way.normalize(), 0.3).normalize();
      this.lastHover = [event.clientX, event.clientY];
    }
    this.hoverAt = [event.clientX, event.clientY];
    this.stage.world.draw();
  }

  private up(event: PointerEvent): void {
    if (this.stroke && event.pointerId === this.pointer) {
      event.stopPropagation();
      this.stroke.end();
      this.forget();
      return;
    }
    const still = Math.hypot(event.clientX - this.start[0], event.clientY - this.start[1]) < 3;
    if (still && event.button === 0 && event.target === this.stage.world.canvas) {
      this.onClick?.(event.clientX, event.clientY);
    }
  }

  private wheel(event: WheelEvent): void {
    if (!this.stroke) return;
    event.preventDefault();
    event.stopPropagation();
    this.choice.setDepth(
      this.choice.depth - Math.sign(event.deltaY) * 0.04 * this.choice.mostDepth,
    );
    this.stroke.deepen(this.choice.depth);
  }

  private forget(): void {
    this.frozenAt = null;
    this.stroke = null;
    this.pointer = -1;
  }

  private leave(): void {
    this.hoverAt = null;
    this.stage.tools.hideGhost();
    this.stage.world.draw();
  }

  // The tool under the pointer before it acts.
  private placeGhost(): void {
    const tool = this.choice.tool;
    if (!tool || !this.hoverAt || this.stroke) return;
    const { model, world } = this.stage;
    if (this.frozenAt !== model.frame) this.frozen = freeze(model.surfaces());
    this.frozenAt = model.frame;
    const hit = firstHit(world.ray(...this.hoverAt), this.frozen);
    if (!hit) return this.stage.tools.hideGhost();
    const pose = this.hoverPose(hit.point, hit.normal);
    this.stage.tools.setGhost(tool.path, pose.p, pose.q);
  }

  private hoverPose(point: THREE.Vector3, normal: THREE.Vector3): ToolPose {
    const tool = this.choice.tool!;
    const direction = new THREE.Vector3(this.hoverDirection.x, -this.hoverDirection.y, 0);
    direction.applyQuaternion(this.stage.world.camera.object.quaternion);
    switch (kindOf(tool)) {
      case 'probe':
        return pressPose(point, normal, 0, tool.radius);
      case 'pushed':
        return lifted(pushedPose(point, normal, direction, 0), 0.02 * this.stage.size);
      case 'blade':
        return bladePose(point, normal, direction, 0, 1);
      default:
        return pressPose(point, normal, 0, 0);
    }
  }
}
