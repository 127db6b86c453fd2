// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';

// Painted once for all scenes.
let iris: THREE.Texture | null = null;
let sclera: THREE.Texture | null = null;

// Iris and eyeball behind a cornea, for context only: they take no part in anything. Sizes follow
// from the cornea's rest shape, whose apex looks to +z and whose rim is its lowest ring.
export function makeEye(rest: Float32Array): THREE.Group {
  const rim = rimOf(rest);
  const group = new THREE.Group();
  const radius = 2.02 * rim.radius;
  const opening = Math.asin((rim.radius * 0.985) / radius);
  const eyeball = new THREE.Mesh(
    new THREE.SphereGeometry(radius, 96, 64, 0, 2 * Math.PI, opening, Math.PI - opening),
    new THREE.MeshStandardMaterial({ map: (sclera ??= scleraTexture()), roughness: 0.38 }),
  );
  // what one sees of the inside past the iris
  const lip = new THREE.Mesh(
    new THREE.SphereGeometry(radius, 96, 4, 0, 2 * Math.PI, opening, 0.15),
    new THREE.MeshStandardMaterial({ color: 0x39484d, roughness: 0.8, side: THREE.BackSide }),
  );
  for (const part of [eyeball, lip]) {
    part.rotation.x = Math.PI / 2;
    part.position.set(rim.x, rim.y, rim.z - radius * Math.cos(opening));
  }

  const disc = new THREE.Mesh(
    irisGeometry(rim.radius),
    new THREE.MeshStandardMaterial({ map: (iris ??= irisTexture()), roughness: 0.75 }),
  );
  disc.position.set(rim.x, rim.y, rim.z);
  group.add(eyeball, lip, disc);
  return group;
}

interface Rim {
  x: number;
  y: number;
  z: number;
  radius: number;
}

// The ring of the outermost points, seen along z.
function rimOf(rest: Float32Array): Rim {
  const box = new THREE.Box3().setFromArray(rest);
  const x = (box.min.x + box.max.x) / 2;
  const y = (box.min.y + box.max.y) / 2;
  let radius = 0;
  for (let i = 0; i < rest.length; i += 3) {
    radius = Math.max(radius, Math.hypot(rest[i]! - x, rest[i + 1]! - y));
  }
  let z = 0;
  let count = 0;
  for (let i = 0; i < rest.length; i += 3) {
    if (Math.hypot(rest[i]! - x, rest[i + 1]! - y) < 0.97 * radius) continue;
    z += rest[i + 2]!;
    count++;
  }
  return { x, y, z: count ? z / count : box.min.z, radius };
}

// A shallow cone that rises towards the pupil, as the iris lies on the lens, and at its border to just
// below the limbus.
function irisGeometry(radius: number): THREE.BufferGeometry {
  const profile = new THREE.RingGeometry(0.0001 * radius, radius, 96, 24);
  const position = profile.getAttribute('position') as THREE.BufferAttribute;
  for (let i = 0; i < position.count; i++) {
    const r = Math.hypot(position.getX(i), position.getY(i)) / radius;
    const border = Math.max(0, (r - 0.93) / 0.07);
    const height = (0.1 - 0.07 * (1 - r)) * (1 - border * border) + 0.02 * border;
    position.setZ(i, -radius * height);
  }
  profile.computeVertexNormals();
  return profile;
}

function canvasOf(width: number, height: number): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  return [canvas, canvas.getContext('2d')!];
}

// Numbers that look random and are the same each time.
function noise(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

function irisTexture(): THREE.Texture {
  const size = 1024;
  const middle = size / 2;
  const [canvas, draw] = canvasOf(size, size);
  const random = noise(7);
  const base = draw.createRadialGradient(middle, middle, 0.24 * middle, middle, middle, middle);
  base.addColorStop(0, '#6d7f6a');
  base.addColorStop(0.25, '#4f7f86');
  base.addColorStop(0.7, '#33606f');
  base.addColorStop(0.9, '#1f3a47');
  base.addColorStop(1, '#14222b');
  draw.fillStyle = base;
  draw.fillRect(0, 0, size, size);
  draw.translate(middle, middle);
  for (let i = 0; i < 900; i++) {
    const angle = random() * 2 * Math.PI;
    const from = middle * (0.3 + 0.1 * random());
    const to = middle * (0.5 + 0.45 * random());
    const bend = (random() - 0.5) * 0.08;
    const light = random() > 0.45;
    draw.strokeStyle = light
      ? `rgba(190,215,205,${0.05 + 0.14 * random()})`
      : `rgba(8,22,30,${0.06 + 0.14 * random()})`;
    draw.lineWidth = 1 + 2.4 * random();
    draw.beginPath();
    draw.moveTo(Math.cos(angle) * from, Math.sin(angle) * from);
    draw.lineTo(Math.cos(angle + bend) * to, Math.sin(angle + bend) * to);
    draw.stroke();
  }
  draw.strokeStyle = 'rgba(205,180,120,0.25)';
  draw.lineWidth = 14;
  draw.beginPath();
  draw.arc(0, 0, 0.42 * middle, 0, 2 * Math.PI);
  draw.stroke();
  draw.filter = 'blur(3px)';
  draw.fillStyle = '#07090a';
  draw.beginPath();
  draw.arc(0, 0, 0.33 * middle, 0, 2 * Math.PI);
  draw.fill();
  return asTexture(canvas);
}

// White with a grey limbus at the opening and a few faint vessels.
function scleraTexture(): THREE.Texture {
  const width = 1024;
  const height = 512;
  const [canvas, draw] = canvasOf(width, height);
  const random = noise(3);
  const base = draw.createLinearGradient(0, 0, 0, height);
  base.addColorStop(0, '#8d9a9c');
  base.addColorStop(0.035, '#d9d8d2');
  base.addColorStop(0.12, '#f1ede6');
  base.addColorStop(0.5, '#ede4db');
  base.addColorStop(1, '#dcc4b8');
  draw.fillStyle = base;
  draw.fillRect(0, 0, width, height);
  draw.lineCap = 'round';
  for (let i = 0; i < 46; i++) {
    let x = random() * width;
    let y = height * (0.8 - 0.1 * random());
    let lean = 0;
    const end = height * (0.16 + 0.3 * random());
    draw.strokeStyle = `rgba(190,90,80,${0.05 + 0.07 * random()})`;
    draw.lineWidth = 0.5 + random();
    draw.beginPath();
    draw.moveTo(x, y);
    while (y > end) {
      lean = 0.8 * lean + (random() - 0.5) * 3;
      const middle: [number, number] = [x + lean, y - 4];
      x += 2 * lean;
      y -= 8;
      draw.quadraticCurveTo(...middle, x, y);
    }
    draw.stroke();
  }
  return asTexture(canvas);
}

function asTexture(canvas: HTMLCanvasElement): THREE.Texture {
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}
