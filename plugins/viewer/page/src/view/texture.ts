// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';

let made: THREE.Texture | null = null;

// A soft checker with numbers of its fields' rows: shows how a mesh's texture coordinates run, over
// cuts as well.
export function tissueTexture(): THREE.Texture {
  if (made) return made;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 1024;
  const draw = canvas.getContext('2d')!;
  const fields = 16;
  const side = canvas.width / fields;
  draw.textAlign = 'center';
  draw.textBaseline = 'middle';
  draw.font = `${side * 0.32}px sans-serif`;
  for (let i = 0; i < fields; i++) {
    for (let j = 0; j < fields; j++) {
      draw.fillStyle = (i + j) % 2 ? '#d7b7a8' : '#b5705f';
      draw.fillRect(i * side, j * side, side, side);
      draw.fillStyle = 'rgba(40,15,10,0.45)';
      draw.fillText(`${i}·${fields - 1 - j}`, (i + 0.5) * side, (j + 0.5) * side);
    }
  }
  made = new THREE.CanvasTexture(canvas);
  made.colorSpace = THREE.SRGBColorSpace;
  made.wrapS = made.wrapT = THREE.RepeatWrapping;
  made.anisotropy = 4;
  return made;
}
