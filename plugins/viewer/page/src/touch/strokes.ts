// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { ToolInfo } from '../protocol';
import { cuttingSide, kindOf } from '../tool_kind';
import { firstHit, type FrozenSurface, type Hit } from './hits';
import { bladePose, lifted, pressPose, pushedPose, tangential, type ToolPose } from './poses';
import type { PoseSender } from './sender';

// What one press of the button does, from its beginning to its end.
export interface Stroke {
  move(ray: THREE.Ray, pixels: number): void;
  deepen(depth: number): void;
  end(): void;
}

export interface StrokeSetting {
  tool: ToolInfo;
  sender: PoseSender;
  surfaces: FrozenSurface[];
  hit: Hit;
  depth: number;
  size: number; // of the scene (m)
  view: THREE.Vector3; // the way the eye looks
}

const held = 1;
const released = 0;
const pixelsBeforeBlade = 3;

export function beginStroke(setting: StrokeSetting): Stroke {
  switch (kindOf(setting.tool)) {
    case 'grip':
      return new PullStroke(setting);
    case 'probe':
    case 'punch':
      return new PressStroke(setting);
    default:
      return new BladeStroke(setting);
  }
}

// Takes hold where the surface was hit and moves in the plane of the screen.
class PullStroke implements Stroke {
  private readonly plane: THREE.Plane;
  private pose: ToolPose;

  constructor(private readonly use: StrokeSetting) {
    const { hit, tool, sender, view } = use;
    this.plane = new THREE.Plane().setFromNormalAndCoplanarPoint(view, hit.point);
    this.pose = pressPose(hit.point, hit.normal, 0, 0);
    sender.key(tool.path, this.pose, released, true);
    sender.key(tool.path, this.pose, held);
  }

  move(ray: THREE.Ray): void {
    const p = ray.intersectPlane(this.plane, new THREE.Vector3());
    if (!p) return;
    this.pose = { p, q: this.pose.q };
    this.use.sender.move(this.use.tool.path, this.pose, held);
  }

  deepen(): void {}

  end(): void {
    this.use.sender.key(this.use.tool.path, this.pose, released);
    this.use.sender.key(this.use.tool.path, lifted(this.pose, 0.15 * this.use.size), released);
  }
}

// Follows the surface with the pointer, tracing it where the ray leaves it.
class SurfaceTrack {
  constructor(
    private readonly use: StrokeSetting,
    public hit: Hit,
  ) {}

  follow(ray: THREE.Ray): boolean {
    const found = firstHit(ray, this.use.surfaces);
    if (found) {
      this.hit = found;
      return true;
    }
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(this.hit.normal, this.hit.point);
    const p = ray.intersectPlane(plane, new THREE.Vector3());
    if (!p || p.distanceTo(this.hit.point) > 0.1 * this.use.size) return false;
    this.hit = { ...this.hit, point: p };
    return true;
  }
}

// A ball or a ring that presses along the outward normal.
class PressStroke implements Stroke {
  private readonly track: SurfaceTrack;
  private depth: number;

  constructor(private readonly use: StrokeSetting) {
    this.track = new SurfaceTrack(use, use.hit);
    this.depth = use.depth;
    use.sender.key(use.tool.path, lifted(this.pose(), use.depth + 0.06 * use.size), released, true);
    use.sender.key(use.tool.path, this.pose(), held);
  }

  move(ray: THREE.Ray): void {
    if (this.track.follow(ray)) this.use.sender.move(this.use.tool.path, this.pose(), held);
  }

  deepen(depth: number): void {
    this.depth = depth;
    this.use.sender.move(this.use.tool.path, this.pose(), held);
  }

  end(): void {
    const { sender, tool, size } = this.use;
    sender.key(tool.path, lifted(this.pose(), this.depth + 0.15 * size), released);
  }

  private pose(): ToolPose {
    const radius = kindOf(this.use.tool) === 'probe' ? this.use.tool.radius : 0;
    return pressPose(this.track.hit.point, this.track.hit.normal, this.depth, radius);
  }
}

// A blade, set in once the pointer has said which way it goes.
class BladeStroke implements Stroke {
  private readonly track: SurfaceTrack;
  private depth: number;
  private direction: THREE.Vector3 | null = null;

  constructor(private readonly use: StrokeSetting) {
    this.track = new SurfaceTrack(use, use.hit);
    this.depth = use.depth;
  }

  move(ray: THREE.Ray, pixels: number): void {
    const before = this.track.hit;
    if (this.direction === null) {
      if (pixels >= pixelsBeforeBlade) this.setIn(ray);
      return;
    }
    if (!this.track.follow(ray)) return;
    const way = this.track.hit.point.clone().sub(before.point);
    // turns with the way that was gone, not with the pointer's trembling
    const weight = 1 - Math.exp(-way.length() / (0.02 * this.use.size));
    this.direction.lerp(tangential(way, this.track.hit.normal), way.lengthSq() > 0 ? weight : 0);
    this.use.sender.move(this.use.tool.path, this.pose(), held);
  }

  deepen(depth: number): void {
    this.depth = depth;
    if (this.direction) this.use.sender.move(this.use.tool.path, this.pose(), held);
  }

  end(): void {
    if (!this.direction) return;
    const { sender, tool, size } = this.use;
    sender.key(tool.path, lifted(this.pose(), this.depth + 0.15 * size), released);
  }

  private setIn(ray: THREE.Ray): void {
    const from = this.track.hit;
    if (!this.track.follow(ray)) return;
    const way = this.track.hit.point.clone().sub(from.point);
    if (way.lengthSq() === 0) return;
    this.direction = way.normalize();
    const to = this.track.hit;
    this.track.hit = from;
    const { sender, tool, size } = this.use;
    sender.key(tool.path, lifted(this.pose(), this.depth + 0.06 * size), released, true);
    sender.key(tool.path, this.pose(), held);
    this.track.hit = to;
    sender.key(tool.path, this.pose(), held);
  }

  private pose(): ToolPose {
    const { point, normal } = this.track.hit;
    const direction = this.direction!;
    if (kindOf(this.use.tool) === 'pushed') return pushedPose(point, normal, direction, this.depth);
    return bladePose(point, normal, direction, this.depth, cuttingSide(this.use.tool));
  }
}
