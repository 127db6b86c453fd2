// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { ToolInfo } from '../protocol';
import { kindOf, reachOf } from '../tool_kind';

export interface ToolMaterials {
  metal: THREE.Material;
  grip: THREE.Material;
}

// An instrument in its own frame: tip at the origin, handle towards +z. `size` is that of the scene
// (m): it gives the handle its length.
export function makeToolShape(tool: ToolInfo, size: number, use: ToolMaterials): THREE.Group {
  const group = new THREE.Group();
  const reach = reachOf(tool);
  switch (kindOf(tool)) {
    case 'probe':
      addProbe(group, tool.radius || 0.01 * size, size, use);
      break;
    case 'grip':
      addForceps(group, tool.radius || 0.02 * size, size, use);
      break;
    case 'punch':
      addTube(group, tool, size, use);
      break;
    default:
      addBlade(group, tool, reach, size, use);
  }
  return group;
}

function rod(
  from: number,
  to: number,
  low: number,
  high: number,
  material: THREE.Material,
): THREE.Mesh {
  const geometry = new THREE.CylinderGeometry(high, low, to - from, 20);
  geometry.rotateX(Math.PI / 2);
  geometry.translate(0, 0, (from + to) / 2);
  return new THREE.Mesh(geometry, material);
}

function addProbe(group: THREE.Group, radius: number, size: number, use: ToolMaterials): void {
  const thin = Math.min(0.45 * radius, 0.012 * size);
  group.add(new THREE.Mesh(new THREE.SphereGeometry(radius, 32, 20), use.metal));
  group.add(rod(0.8 * radius, 0.35 * size, thin, thin, use.metal));
  group.add(rod(0.35 * size, 0.85 * size, 2.2 * thin, 2.6 * thin, use.grip));
}

// Two jaws that meet at the tip.
function addForceps(group: THREE.Group, reach: number, size: number, use: ToolMaterials): void {
  const length = 0.8 * size;
  const thick = Math.max(0.16 * reach, 0.006 * size);
  for (const side of [-1, 1]) {
    const jaw = new THREE.Mesh(new THREE.BoxGeometry(thick, 2.4 * thick, length), use.metal);
    jaw.geometry.translate(side * 0.5 * thick, 0, length / 2);
    jaw.rotation.y = side * 0.045;
    jaw.name = side < 0 ? 'jaw-left' : 'jaw-right';
    group.add(jaw);
  }
}

// Open or closed jaws.
export function setJaws(shape: THREE.Group, closed: boolean): void {
  for (const [name, side] of [
    ['jaw-left', -1],
    ['jaw-right', 1],
  ] as const) {
    const jaw = shape.getObjectByName(name);
    if (jaw) jaw.rotation.y = side * (closed ? 0.012 : 0.06);
  }
}

function addBlade(
  group: THREE.Group,
  tool: ToolInfo,
  reach: number,
  size: number,
  use: ToolMaterials,
): void {
  // the edge in the plane y = 0, closed along the back; a mere line gets a back to be seen
  const outline = tool.edge.map((p) => new THREE.Vector2(p[0], p[2]));
  const top = Math.max(...outline.map((p) => p.y));
  const wide = Math.max(...outline.map((p) => p.x)) - Math.min(...outline.map((p) => p.x));
  if (wide < 1e-3 * reach) outline.push(new THREE.Vector2(-0.16 * reach, top));
  else if (kindOf(tool) === 'blade') {
    outline.push(new THREE.Vector2(-Math.sign(outline[0]!.x || 1) * 0.5 * wide, top));
  }
  const thick = 0.02 * reach;
  const plate = new THREE.ExtrudeGeometry(new THREE.Shape(outline), {
    depth: thick,
    bevelEnabled: false,
  });
  // shape's (x, y) are the tool's (x, z)
  plate.rotateX(Math.PI / 2);
  plate.translate(0, thick / 2, 0);
  group.add(new THREE.Mesh(plate, use.metal));
  const middle = (Math.max(...outline.map((p) => p.x)) + Math.min(...outline.map((p) => p.x))) / 2;
  const radius = Math.min(0.07 * reach, 0.016 * size);
  const neck = rod(top, top + 0.1 * size, radius, radius * 1.3, use.metal);
  const handle = rod(top + 0.1 * size, top + 0.7 * size, radius * 1.5, radius * 1.9, use.grip);
  neck.position.x = handle.position.x = middle;
  group.add(neck, handle);
}

function addTube(group: THREE.Group, tool: ToolInfo, size: number, use: ToolMaterials): void {
  const radius = Math.max(...tool.edge.map((p) => Math.hypot(p[0], p[1])));
  const tube = new THREE.CylinderGeometry(radius, radius, 0.3 * size, 64, 1, true);
  tube.rotateX(Math.PI / 2);
  tube.translate(0, 0, 0.15 * size);
  group.add(new THREE.Mesh(tube, use.metal));
  group.add(rod(0.3 * size, 0.34 * size, radius, 0.35 * radius, use.grip));
  group.add(rod(0.34 * size, 0.7 * size, 0.35 * radius, 0.3 * radius, use.grip));
}
