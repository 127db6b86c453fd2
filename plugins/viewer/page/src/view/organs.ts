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
      color: tissue.outer,
      roughness: tissue.roughness,
      side: THREE.DoubleSide,
    }),
    wall: new THREE.MeshStandardMaterial({
      color: tissue.wall,
      roughness: 0.7,
      side: THREE.DoubleSide,
    }),
    isCornea: false,
  };
}

// What makes the shape of a clear film legible: it is denser where it is seen edge-on, and a window
// of four panes is mirrored in it, which a dent bends.
const wetFilm = `
  vec3 toEye = normalize(vViewPosition);
  float edgeOn = pow(1.0 - abs(dot(toEye, normal)), 2.5);
  vec3 mirrored = reflect(-toEye, normal);
  vec2 pane = (mirrored.xy - vec2(-0.34, 0.42)) / vec2(0.2, 0.26);
  vec2 inside = smoothstep(vec2(1.0), vec2(0.88), abs(pane)) * smoothstep(vec2(0.04), vec2(0.1), abs(pane));
  float window = gl_FrontFacing && mirrored.z > -0.2 ? inside.x * inside.y : 0.0;
  gl_FragColor.rgb += vec3(0.62, 0.72, 0.76) * 0.3 * edgeOn + vec3(0.32, 0.35, 0.37) * window;
  gl_FragColor.a = min(1.0, gl_FragColor.a + 0.3 * edgeOn + 0.2 * window);
`;

// Clear with a wet highlight. Refraction would cost a second picture of all behind it. The light it
// gives is added to what shines through, so that the highlight is not thinned with the film.
function corneaLook(): Look {
  const outer = new THREE.MeshPhysicalMaterial({
    color: 0x0b1215,
    roughness: 0.16,
    specularIntensity: 0.35,
    transparent: true,
    opacity: 0.06,
    blending: THREE.CustomBlending,
    blendSrc: THREE.OneFactor,
    blendDst: THREE.OneMinusSrcAlphaFactor,
    premultipliedAlpha: false,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
  outer.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      '#include <opaque_fragment>',
      `#include <opaque_fragment>\n${wetFilm}`,
    );
  };
  const wall = new THREE.MeshStandardMaterial({
    color: 0xe0733f,
    roughness: 0.55,
    side: THREE.DoubleSide,
  });
  return { outer, wall, isCornea: true };
}
