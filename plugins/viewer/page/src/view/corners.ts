// SPDX-License-Identifier: Apache-2.0
// Which corners of a surface's triangles share a vertex when drawn. A point is drawn once for each
// smooth part of the surface round it: edges sharper than the crease angle, and the seam between
// outer surface and incision walls, stay sharp.

export interface DrawnVertices {
  points: Uint32Array; // of each drawn vertex: the surface's point
  triangleOf: Uint32Array; // of each drawn vertex: one of its triangles
  index: Uint32Array; // drawn vertices of the triangles, outer ones first, walls last
  outerTriangles: number;
}

const creaseCosine = Math.cos((50 * Math.PI) / 180);

export function splitCorners(
  rest: Float32Array,
  triangles: Uint32Array,
  walls: Uint8Array | null,
): DrawnVertices {
  const count = triangles.length / 3;
  const normals = unitNormals(rest, triangles);
  const parent = Uint32Array.from({ length: 3 * count }, (_, i) => i);
  const root = (i: number): number => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]!]!;
    return i;
  };
  const points = rest.length / 3;
  // the corner at which a directed edge begins
  const begins = new Map<number, number>();
  for (let c = 0; c < 3 * count; c++) {
    begins.set(triangles[c]! * points + triangles[nextCorner(c)]!, c);
  }
  for (let c = 0; c < 3 * count; c++) {
    const n = nextCorner(c);
    const across = begins.get(triangles[n]! * points + triangles[c]!);
    if (across === undefined || across < c) continue;
    const a = Math.floor(c / 3);
    const b = Math.floor(across / 3);
    if (walls && walls[a] !== walls[b]) continue;
    if (!isSmooth(normals, a, b)) continue;
    parent[root(c)] = root(nextCorner(across));
    parent[root(n)] = root(across);
  }
  return number(triangles, walls, root);
}

function nextCorner(c: number): number {
  return c % 3 === 2 ? c - 2 : c + 1;
}

function isSmooth(normals: Float32Array, a: number, b: number): boolean {
  const ax = normals[3 * a]!,
    ay = normals[3 * a + 1]!,
    az = normals[3 * a + 2]!;
  const bx = normals[3 * b]!,
    by = normals[3 * b + 1]!,
    bz = normals[3 * b + 2]!;
  const noDirection = (ax === 0 && ay === 0 && az === 0) || (bx === 0 && by === 0 && bz === 0);
  return noDirection || ax * bx + ay * by + az * bz > creaseCosine;
}

// Zero for slivers, whose direction means nothing.
function unitNormals(rest: Float32Array, triangles: Uint32Array): Float32Array {
  const out = new Float32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t]!,
      b = 3 * triangles[t + 1]!,
      c = 3 * triangles[t + 2]!;
    const ux = rest[b]! - rest[a]!,
      uy = rest[b + 1]! - rest[a + 1]!,
      uz = rest[b + 2]! - rest[a + 2]!;
    const vx = rest[c]! - rest[a]!,
      vy = rest[c + 1]! - rest[a + 1]!,
      vz = rest[c + 2]! - rest[a + 2]!;
    const nx = uy * vz - uz * vy,
      ny = uz * vx - ux * vz,
      nz = ux * vy - uy * vx;
    const length = Math.hypot(nx, ny, nz);
    const longest = Math.max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz);
    if (!(length > 0.02 * longest)) continue;
    out[t] = nx / length;
    out[t + 1] = ny / length;
    out[t + 2] = nz / length;
  }
  return out;
}

function number(
  triangles: Uint32Array,
  walls: Uint8Array | null,
  root: (corner: number) => number,
): DrawnVertices {
  const vertexOf = new Map<number, number>();
  const points: number[] = [];
  const triangleOf: number[] = [];
  const outer: number[] = [];
  const inner: number[] = [];
  for (let c = 0; c < triangles.length; c++) {
    const triangle = Math.floor(c / 3);
    let vertex = vertexOf.get(root(c));
    if (vertex === undefined) {
      vertex = points.length;
      vertexOf.set(root(c), vertex);
      points.push(triangles[c]!);
      triangleOf.push(triangle);
    }
    (walls?.[triangle] ? inner : outer).push(vertex);
  }
  return {
    points: Uint32Array.from(points),
    triangleOf: Uint32Array.from(triangleOf),
    index: Uint32Array.from([...outer, ...inner]),
    outerTriangles: outer.length / 3,
  };
}

// Area-weighted normals of the drawn vertices, written in place.
export function smoothNormals(position: Float32Array, index: Uint32Array, to: Float32Array): void {
  to.fill(0);
  for (let t = 0; t < index.length; t += 3) {
    const a = 3 * index[t]!,
      b = 3 * index[t + 1]!,
      c = 3 * index[t + 2]!;
    const ax = position[a]!,
      ay = position[a + 1]!,
      az = position[a + 2]!;
    const ux = position[b]! - ax,
      uy = position[b + 1]! - ay,
      uz = position[b + 2]! - az;
    const vx = position[c]! - ax,
      vy = position[c + 1]! - ay,
      vz = position[c + 2]! - az;
    const nx = uy * vz - uz * vy,
      ny = uz * vx - ux * vz,
      nz = ux * vy - uy * vx;
    for (const i of [a, b, c]) {
      to[i] = to[i]! + nx;
      to[i + 1] = to[i + 1]! + ny;
      to[i + 2] = to[i + 2]! + nz;
    }
  }
  for (let i = 0; i < to.length; i += 3) {
    const length = Math.hypot(to[i]!, to[i + 1]!, to[i + 2]!) || 1;
    to[i] = to[i]! / length;
    to[i + 1] = to[i + 1]! / length;
    to[i + 2] = to[i + 2]! / length;
  }
}
