// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';

// How a tissue looks, chosen by the names in its path.
export interface Look {
  outer: THREE.MeshStandardMaterial;
  wall: THREE.MeshStandardMaterial;
  isCornea: boolean;
}

const tissues: { word: string; outer: number; wall: number; roughness: number }[] = [
  { word: 'liver', outer: 0x8a3b2e, wall: 0xd0705a, roughness: 0.42 },
  { word: 'stomach', outer: 0xd99a92, wall: 0xa63d45, roughness: 0.5 },
  { word: 'beam', outer: 0x8fa7b8, wall: 0xc9773f, roughness: 0.7 },
  { word: 'block', outer: 0x8fa7b8, wall: 0xc9773f, roughness: 0.7 },
];
const other = { outer: 0xc99a86, wall: 0xa8483f, roughness: 0.55 };

export function isCorneaPath(path: string): boolean {
  return path.toLowerCase().includes('cornea');
}

export function lookOf(path: string): Look {
  if (isCorneaPath(path)) return corneaLook();
  const tissue = tissues.find(({ word }) => path.toLowerCase().includes(word)) ?? other;
  return {
    outer: new THREE.MeshStandardMaterial({
      color: tissue.outer, roughness: tissue.roughness, side: THREE.DoubleSide,
    }),
    wall: new THREE.MeshStandardMaterial({
      color: tissue.wall, roughness: 0.7, side: THREE.DoubleSide,
    }),
    isCornea: false,
  };
}

// Clear with a wet highlight. Refraction would cost a second picture of all behind it. The light it
// gives is added to what shines through, so that the highlight is not thinned with the film.
function corneaLook(): Look {
  const outer = new THREE.MeshPhysicalMaterial({
    color: 0x0b1215,
    roughness: 0.16,
    clearcoat: 0.35,
    clearcoatRoughness: 0.05,
    transparent: true,
    opacity: 0.06,
    blending: THREE.CustomBlending,
    blendSrc: THREE.OneFactor,
    blendDst: THREE.OneMinusSrcAlphaFactor,
    premultipliedAlpha: false,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
  const wall = new THREE.MeshStandardMaterial({
    color: 0xe0733f,
    roughness: 0.55,
    side: THREE.DoubleSide,
  });
  return { outer, wall, isCornea: true };
}
