// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { SceneInfo, ToolFrame, ToolInfo } from '../protocol';
import { Arrow } from './arrow';
import { makeToolShape, setJaws } from './tool_shapes';

interface ShownTool {
  info: ToolInfo;
  shape: THREE.Group;
  arrow: Arrow;
}

// The scene's tools where the last frame has them, the force of the tissue on each as an arrow,
// contact points as dots, and the ghost of the tool under the pointer.
export class ToolsView {
  readonly group = new THREE.Group();
  private readonly shown = new Map<string, ShownTool>();
  private readonly metal = new THREE.MeshStandardMaterial({
    color: 0xcdd4d8,
    roughness: 0.3,
    metalness: 0.12,
    side: THREE.DoubleSide,
  });
  private readonly grip = new THREE.MeshStandardMaterial({ color: 0x6b777f, roughness: 0.55 });
  private readonly ghostMaterial = new THREE.MeshBasicMaterial({
    color: 0x2b9c93,
    transparent: true,
    opacity: 0.35,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
  private readonly arrowMaterial = new THREE.MeshBasicMaterial({ color: 0xf0a020 });
  private readonly dots = new THREE.Points(
    new THREE.BufferGeometry(),
    new THREE.PointsMaterial({
      color: 0xf0a020,
      size: 5,
      sizeAttenuation: false,
      depthTest: false,
    }),
  );
  private ghosts = new Map<string, THREE.Group>();
  private ghost: THREE.Group | null = null;
  private size = 1;
  private largestForce = 0;
  showForces = true;
  private chosen: string | null = null;

  constructor() {
    this.dots.frustumCulled = false;
    this.group.add(this.dots);
  }

  setScene(scene: SceneInfo, size: number): void {
    for (const tool of this.shown.values()) tool.shape.removeFromParent();
    for (const tool of this.shown.values()) tool.arrow.group.removeFromParent();
    for (const ghost of this.ghosts.values()) ghost.removeFromParent();
    this.shown.clear();
    this.ghosts.clear();
    this.ghost = null;
    this.size = size;
    for (const info of scene.tools) {
      const shape = makeToolShape(info, size, { metal: this.metal, grip: this.grip });
      const arrow = new Arrow(this.arrowMaterial, 0.008 * size);
      const ghost = makeToolShape(info, size, {
        metal: this.ghostMaterial,
        grip: this.ghostMaterial,
      });
      shape.visible = ghost.visible = false;
      this.shown.set(info.path, { info, shape, arrow });
      this.ghosts.set(info.path, ghost);
      this.group.add(shape, arrow.group, ghost);
    }
    this.update([]);
  }

  update(tools: ToolFrame[]): void {
    const contacts: number[] = [];
    for (const tool of tools) {
      const shown = this.shown.get(tool.path);
      if (!shown) continue;
      // a tool of the mouse that is laid down is not in the way
      const laidDown = shown.info.mouse && this.chosen !== tool.path && !tool.active;
      shown.shape.visible = !laidDown;
      shown.shape.position.set(...tool.p);
      shown.shape.quaternion.set(...tool.q);
      setJaws(shown.shape, tool.active);
      this.drawForce(shown, tool);
      for (const contact of tool.contacts ?? []) contacts.push(...contact.p);
    }
    this.dots.geometry.dispose();
    this.dots.geometry = new THREE.BufferGeometry();
    this.dots.geometry.setAttribute('position', new THREE.Float32BufferAttribute(contacts, 3));
    this.dots.visible = this.showForces && contacts.length > 0;
  }

  // The largest force so far is a third of the scene long.
  private drawForce(shown: ShownTool, tool: ToolFrame): void {
    const force = new THREE.Vector3(...tool.force);
    this.largestForce = Math.max(this.largestForce, force.length(), 1e-9);
    const length = this.showForces ? (0.33 * this.size) / this.largestForce : 0;
    shown.arrow.set(new THREE.Vector3(...tool.p), force.multiplyScalar(length));
  }

  // The tool that the mouse holds, if any.
  choose(path: string | null): void {
    this.chosen = path;
  }

  // Shows where the tool would go; null: nowhere.
  setGhost(path: string | null, p?: THREE.Vector3, q?: THREE.Quaternion): void {
    const next = (path && this.ghosts.get(path)) || null;
    if (this.ghost && this.ghost !== next) this.ghost.visible = false;
    this.ghost = next;
    if (next && p && q) {
      next.visible = true;
      next.position.copy(p);
      next.quaternion.copy(q);
    }
  }

  hideGhost(): void {
    if (this.ghost) this.ghost.visible = false;
    this.ghost = null;
  }
}
