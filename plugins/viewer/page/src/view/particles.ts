// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { paint, type Range } from '../colours';
import type { Body } from '../model';

const vertexShader = `
#include <common>
#include <clipping_planes_pars_vertex>
uniform float size;
uniform float pixels;
attribute vec3 color;
varying vec3 vColour;
void main() {
  vColour = color;
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * mvPosition;
  gl_PointSize = clamp(size * pixels * projectionMatrix[1][1] / -mvPosition.z, 1.5, 64.0);
  #include <clipping_planes_vertex>
}`;

// Each point is a disc that is shaded as the ball it stands for.
const fragmentShader = `
#include <common>
#include <clipping_planes_pars_fragment>
varying vec3 vColour;
void main() {
  #include <clipping_planes_fragment>
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  float square = dot(at, at);
  if (square > 1.0) discard;
  float light = 0.45 + 0.6 * max(0.0, dot(vec3(at.x, -at.y, sqrt(1.0 - square)), vec3(-0.35, 0.5, 0.79)));
  gl_FragColor = vec4(vColour * light, 1.0);
  #include <colorspace_fragment>
}`;

// The particles of a body.
export class ParticleView {
  readonly points: THREE.Points;
  private readonly material: THREE.ShaderMaterial;

  constructor(readonly body: Body) {
    this.material = new THREE.ShaderMaterial({
      vertexShader,
      fragmentShader,
      clipping: true,
      uniforms: { size: { value: 1e-3 }, pixels: { value: 500 } },
    });
    this.points = new THREE.Points(new THREE.BufferGeometry(), this.material);
    this.points.frustumCulled = false;
  }

  setTopology(): void {
    const rest = this.body.topology?.rest ?? new Float32Array(0);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(rest.slice(), 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(rest.length), 3));
    this.points.geometry.dispose();
    this.points.geometry = geometry;
    this.material.uniforms.size!.value = 0.8 * spacing(rest);
    this.showPlain();
    this.update();
  }

  update(): void {
    const attribute = this.points.geometry.getAttribute('position') as
      | THREE.BufferAttribute
      | undefined;
    if (!attribute || !this.body.position) return;
    if (attribute.array.length !== this.body.position.length) return;
    (attribute.array as Float32Array).set(this.body.position);
    attribute.needsUpdate = true;
  }

  // Half the height of the picture in pixels: how large a ball appears.
  setPixels(halfHeight: number): void {
    this.material.uniforms.pixels!.value = halfHeight;
  }

  showPlain(): void {
    const colour = this.points.geometry.getAttribute('color') as THREE.BufferAttribute | undefined;
    if (!colour) return;
    const shade = new THREE.Color(0x6f9fb5);
    for (let i = 0; i < colour.count; i++) colour.setXYZ(i, shade.r, shade.g, shade.b);
    colour.needsUpdate = true;
  }

  showValues(values: ArrayLike<number>, range: Range): void {
    const colour = this.points.geometry.getAttribute('color') as THREE.BufferAttribute | undefined;
    if (!colour || colour.count !== values.length) return;
    paint(values, range, colour.array as Float32Array);
    colour.needsUpdate = true;
  }

  setClipping(planes: THREE.Plane[]): void {
    this.material.clippingPlanes = planes;
  }

  dispose(): void {
    this.points.geometry.dispose();
    this.material.dispose();
    this.points.removeFromParent();
  }
}

// Median distance of some particles to their nearest neighbour.
export function spacing(rest: Float32Array): number {
  const count = rest.length / 3;
  if (count < 2) return 0.01;
  const nearest: number[] = [];
  const stride = Math.max(1, Math.floor(count / 40));
  for (let i = 0; i < count; i += stride) {
    let best = Infinity;
    for (let j = 0; j < count; j++) {
      if (j === i) continue;
      const x = rest[3 * j]! - rest[3 * i]!;
      const y = rest[3 * j + 1]! - rest[3 * i + 1]!;
      const z = rest[3 * j + 2]! - rest[3 * i + 2]!;
      best = Math.min(best, x * x + y * y + z * z);
    }
    nearest.push(Math.sqrt(best));
  }
  nearest.sort((a, b) => a - b);
  return nearest[nearest.length >> 1]!;
}
