// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { rangeOf, type Range } from '../colours';
import type { Body, Model } from '../model';
import type { SceneInfo } from '../protocol';
import type { ViewSettings } from '../settings';
import { valuesOf } from './colouring';
import { makeEye } from './eye';
import { isCorneaPath } from './organs';
import { ParticleView } from './particles';
import { Neighbourhood } from './neighbourhood';
import { SurfaceView } from './surface';
import { tissueTexture } from './texture';
import { ToolsView } from './tools';
import { VectorsView } from './vectors';
import type { World } from './world';

// Puts the scene of the model on the stage and keeps it as the settings say.
export class Stage {
  readonly surfaces = new Map<number, SurfaceView>();
  readonly particles = new Map<number, ParticleView>();
  readonly tools = new ToolsView();
  readonly vectors = new VectorsView();
  readonly neighbourhood: Neighbourhood;
  readonly bounds = new THREE.Box3(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
  size = 1; // diagonal of the bounds (m)
  range: Range | null = null; // what the colours span now
  private eye: THREE.Group | null = null;
  private file: string | null = null;
  private paintWanted = true;
  private readonly clip = new THREE.Plane();

  constructor(
    readonly world: World,
    readonly model: Model,
    readonly settings: ViewSettings,
  ) {
    this.neighbourhood = new Neighbourhood(model);
    world.scene.add(this.tools.group, this.vectors.lines, this.neighbourhood.group);
    model.on('scene', (scene) => this.showScene(scene));
    model.on('topology', (body) => this.showTopology(body));
    model.on('frame', () => this.showFrame());
    settings.on('changed', () => {
      this.apply();
      this.world.draw();
    });
    world.beforeDrawing.push(() => this.paintIfWanted());
  }

  private showScene(scene: SceneInfo): void {
    for (const view of this.surfaces.values()) view.dispose();
    for (const view of this.particles.values()) view.dispose();
    this.surfaces.clear();
    this.particles.clear();
    this.neighbourhood.clear();
    this.removeEye();
    for (const body of this.model.bodies.values()) {
      if (body.info.kind === 'surface') {
        const view = new SurfaceView(body);
        this.surfaces.set(body.info.id, view);
        this.world.scene.add(view.group);
      } else {
        const view = new ParticleView(body);
        this.particles.set(body.info.id, view);
        this.world.scene.add(view.points);
      }
    }
    this.takeBounds(scene);
    this.tools.setScene(scene, this.size);
    if (this.file !== scene.file) this.goToView();
    this.file = scene.file;
    this.apply();
    this.world.draw();
  }

  private takeBounds(scene: SceneInfo): void {
    const [ax, ay, az, bx, by, bz] = scene.bounds;
    this.bounds.min.set(ax, ay, az);
    this.bounds.max.set(bx, by, bz);
    if (this.bounds.isEmpty())
      this.bounds.set(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
    this.size = this.bounds.getSize(new THREE.Vector3()).length();
    this.world.camera.setReach(this.size);
  }

  // Three quarters from the front; a cornea as a surgeon has it before him.
  goToView(): void {
    const cornea = [...this.surfaces.values()].some((view) => view.look.isCornea);
    const from = cornea ? new THREE.Vector3(0.12, -0.85, 1.15) : new THREE.Vector3(0.9, -1.3, 0.75);
    this.world.camera.frame(this.bounds, from);
  }

  private showTopology(body: Body): void {
    if (!body.topology) return;
    this.surfaces.get(body.info.id)?.setTopology(body.topology);
    this.particles.get(body.info.id)?.setTopology();
    if (body.info.kind === 'surface' && isCorneaPath(body.info.path) && !this.eye) {
      this.eye = makeEye(body.topology.rest);
      this.world.scene.add(this.eye);
    }
    this.apply();
    this.world.draw();
  }

  private showFrame(): void {
    for (const view of this.surfaces.values()) view.update();
    if (this.particlesShown()) for (const view of this.particles.values()) view.update();
    this.tools.update(this.model.tools);
    this.neighbourhood.update();
    this.paintWanted = true;
    this.world.draw();
  }

  // Particles are shown where they are asked for, or where there is nothing else to see.
  particlesShown(): boolean {
    return this.settings.values.particles || this.surfaces.size === 0;
  }

  private apply(): void {
    const { values } = this.settings;
    for (const view of this.surfaces.values()) {
      view.group.visible = values.surface;
      view.showGhost(values.ghost);
      view.showWalls(values.walls);
      view.setSeeThrough(values.particles);
    }
    for (const view of this.particles.values()) view.points.visible = this.particlesShown();
    if (this.eye) this.eye.visible = values.context;
    this.tools.showForces = values.forces;
    this.tools.update(this.model.tools);
    this.applySlice();
    this.paintWanted = true;
  }

  private applySlice(): void {
    const { slice, sliceAt, sliceFlip } = this.settings.values;
    const planes: THREE.Plane[] = [];
    if (slice !== 'off') {
      const axis = { x: 0, y: 1, z: 2 }[slice];
      const low = this.bounds.min.getComponent(axis);
      const high = this.bounds.max.getComponent(axis);
      const sign = sliceFlip ? 1 : -1;
      const normal = new THREE.Vector3().setComponent(axis, sign);
      const at = low + (high - low) * (sliceAt * 1.1 - 0.05);
      this.clip.setFromNormalAndCoplanarPoint(normal, normal.clone().multiplyScalar(sign * at));
      planes.push(this.clip);
    }
    for (const view of this.surfaces.values()) view.setClipping(planes);
    for (const view of this.particles.values()) view.setClipping(planes);
    this.vectors.setClipping(planes);
  }

  private paintIfWanted(): void {
    const { colour, vectors, trueLength } = this.settings.values;
    for (const view of this.particles.values()) {
      view.setPixels(this.world.renderer.getDrawingBufferSize(new THREE.Vector2()).y / 2);
    }
    if (!this.paintWanted) return;
    this.paintWanted = false;
    this.vectors.update(this.model.surfaces(), vectors, 0.12 * this.size, trueLength);
    if (colour === '' || colour === 'texture' || colour === 'piece') this.paintFixed(colour);
    else this.paintField(colour);
  }

  private paintFixed(colour: string): void {
    this.range = null;
    for (const view of this.surfaces.values()) {
      if (colour === 'piece') view.showPieces();
      else if (colour === 'texture') view.showTexture(tissueTexture());
      else view.showPlain();
    }
    for (const view of this.particles.values()) view.showPlain();
  }

  private paintField(name: string): void {
    const values = new Map<SurfaceView | ParticleView, Float32Array>();
    for (const view of this.surfaces.values()) {
      const found = valuesOf(view.body, name);
      if (found) values.set(view, found);
      else view.showPlain();
    }
    for (const view of this.particles.values()) {
      if (!this.particlesShown()) continue;
      const found = valuesOf(view.body, name);
      if (found) values.set(view, found);
      else view.showPlain();
    }
    this.range = this.settings.values.range ?? joined([...values.values()].map(rangeOf));
    if (!this.range) return;
    for (const [view, found] of values) view.showValues(found, this.range);
  }

  private removeEye(): void {
    this.eye?.traverse((object) => {
      if (!(object instanceof THREE.Mesh)) return;
      (object.geometry as THREE.BufferGeometry).dispose();
      (object.material as THREE.Material).dispose();
    });
    this.eye?.removeFromParent();
    this.eye = null;
  }
}

function joined(ranges: (Range | null)[]): Range | null {
  let out: Range | null = null;
  for (const range of ranges) {
    if (!range) continue;
    out = out
      ? { low: Math.min(out.low, range.low), high: Math.max(out.high, range.high) }
      : { ...range };
  }
  return out;
}
