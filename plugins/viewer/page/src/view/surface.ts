// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { linearTable, pieceColours, type Range } from '../colours';
import type { Body, Topology } from '../model';
import { smoothNormals, splitCorners, type DrawnVertices } from './corners';
import { lookOf, type Look } from './organs';

// A surface as it is drawn: its geometry is made when the topology comes and written in place with
// each frame.
export class SurfaceView {
  readonly group = new THREE.Group();
  readonly look: Look;
  private readonly painted: THREE.MeshStandardMaterial;
  private readonly textured: THREE.MeshStandardMaterial;
  private readonly mesh: THREE.Mesh;
  private readonly ghost: THREE.Mesh;
  private drawn: DrawnVertices | null = null;
  private topology: Topology | null = null;
  private wallColour: THREE.Color;

  constructor(readonly body: Body) {
    this.look = lookOf(body.info.path);
    this.painted = new THREE.MeshStandardMaterial({
      vertexColors: true,
      roughness: 0.85,
      side: THREE.DoubleSide,
    });
    this.textured = new THREE.MeshStandardMaterial({ roughness: 0.6, side: THREE.DoubleSide });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), [this.look.outer, this.look.wall]);
    this.ghost = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({
        color: 0x7d8a93,
        wireframe: true,
        transparent: true,
        opacity: 0.22,
        depthWrite: false,
      }),
    );
    this.wallColour = this.look.wall.color.clone();
    this.mesh.frustumCulled = this.ghost.frustumCulled = false;
    this.ghost.visible = false;
    this.group.add(this.mesh, this.ghost);
  }

  get materials(): THREE.Material[] {
    return [this.look.outer, this.look.wall, this.painted, this.textured];
  }

  setTopology(topology: Topology): void {
    this.topology = topology;
    const drawn = splitCorners(topology.rest, topology.triangles, topology.walls);
    this.drawn = drawn;
    const geometry = new THREE.BufferGeometry();
    const count = 3 * drawn.points.length;
    const dynamic = (size: number): THREE.BufferAttribute =>
      new THREE.BufferAttribute(new Float32Array(size), 3).setUsage(THREE.DynamicDrawUsage);
    geometry.setIndex(new THREE.BufferAttribute(drawn.index, 1));
    geometry.setAttribute('position', dynamic(count));
    geometry.setAttribute('normal', dynamic(count));
    geometry.setAttribute('color', dynamic(count));
    if (topology.texture) {
      geometry.setAttribute(
        'uv',
        new THREE.BufferAttribute(this.perVertex(topology.texture, 2), 2),
      );
    }
    geometry.addGroup(0, 3 * drawn.outerTriangles, 0);
    geometry.addGroup(3 * drawn.outerTriangles, drawn.index.length - 3 * drawn.outerTriangles, 1);
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;

    const rest = new THREE.BufferGeometry();
    rest.setAttribute('position', new THREE.BufferAttribute(topology.rest, 3));
    rest.setIndex(new THREE.BufferAttribute(topology.triangles, 1));
    this.ghost.geometry.dispose();
    this.ghost.geometry = rest;
    this.update();
  }

  // Takes over the body's positions.
  update(): void {
    const position = this.body.position;
    if (!this.drawn || !position) return;
    const attribute = this.attribute('position');
    const to = attribute.array as Float32Array;
    const { points, index } = this.drawn;
    for (let v = 0; v < points.length; v++) {
      const p = 3 * points[v]!;
      to[3 * v] = position[p]!;
      to[3 * v + 1] = position[p + 1]!;
      to[3 * v + 2] = position[p + 2]!;
    }
    const normal = this.attribute('normal');
    smoothNormals(to, index, normal.array as Float32Array);
    attribute.needsUpdate = normal.needsUpdate = true;
    this.mesh.geometry.computeBoundingSphere();
  }

  showPlain(): void {
    this.mesh.material = [this.look.outer, this.look.wall];
  }

  showTexture(texture: THREE.Texture): void {
    if (!this.topology?.texture) return this.showPlain();
    if (this.textured.map !== texture) {
      this.textured.map = texture;
      this.textured.needsUpdate = true;
    }
    this.mesh.material = [this.textured, this.textured];
  }

  // Colours by a value of each point.
  showValues(values: ArrayLike<number>, range: Range): void {
    if (!this.drawn) return;
    const colour = this.attribute('color');
    const to = colour.array as Float32Array;
    const scale = range.high > range.low ? 255 / (range.high - range.low) : 0;
    const { points } = this.drawn;
    for (let v = 0; v < points.length; v++) {
      const place = Math.round((values[points[v]!]! - range.low) * scale);
      const k = 3 * (place > 0 ? (place < 255 ? place : 255) : 0);
      to[3 * v] = linearTable[k]!;
      to[3 * v + 1] = linearTable[k + 1]!;
      to[3 * v + 2] = linearTable[k + 2]!;
    }
    colour.needsUpdate = true;
    this.mesh.material = [this.painted, this.painted];
  }

  // Colours each connected piece.
  showPieces(): void {
    if (!this.drawn || !this.topology) return;
    const colour = this.attribute('color');
    const shade = new THREE.Color();
    for (let v = 0; v < this.drawn.points.length; v++) {
      const piece = this.topology.pieces?.[this.drawn.triangleOf[v]!] ?? 0;
      shade.setHex(pieceColours[piece % pieceColours.length]!);
      colour.setXYZ(v, shade.r, shade.g, shade.b);
    }
    colour.needsUpdate = true;
    this.mesh.material = [this.painted, this.painted];
  }

  showGhost(on: boolean): void {
    this.ghost.visible = on;
  }

  // Walls in a colour of their own, or as the rest of the surface.
  showWalls(on: boolean): void {
    this.look.wall.color.copy(on ? this.wallColour : this.look.outer.color);
  }

  // Lets see what is inside.
  setSeeThrough(on: boolean): void {
    for (const material of this.materials) {
      if (material === this.look.outer && this.look.isCornea) continue;
      if (material.transparent === on) continue;
      material.transparent = on;
      material.opacity = on ? 0.22 : 1;
      material.depthWrite = !on;
      material.needsUpdate = true;
    }
  }

  setClipping(planes: THREE.Plane[]): void {
    for (const material of this.materials) material.clippingPlanes = planes;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.ghost.geometry.dispose();
    for (const material of this.materials) material.dispose();
    this.group.removeFromParent();
  }

  private attribute(name: string): THREE.BufferAttribute {
    return this.mesh.geometry.getAttribute(name) as THREE.BufferAttribute;
  }

  private perVertex(values: Float32Array, width: number): Float32Array {
    const points = this.drawn!.points;
    const out = new Float32Array(width * points.length);
    for (let v = 0; v < points.length; v++) {
      for (let k = 0; k < width; k++) out[width * v + k] = values[width * points[v]! + k]!;
    }
    return out;
  }
}
