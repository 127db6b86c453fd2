// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { App } from './app';
import type { Body } from './model';

const reach = 12; // pixels

// The particle under a point of the page: of those within reach the nearest to the eye.
export function particleAt(
  app: App,
  x: number,
  y: number,
): { body: Body; particle: number } | null {
  const canvas = app.world.canvas.getBoundingClientRect();
  const camera = app.world.camera.object;
  camera.updateMatrixWorld();
  const matrix = new THREE.Matrix4().multiplyMatrices(
    camera.projectionMatrix,
    camera.matrixWorldInverse,
  );
  const at = new THREE.Vector3();
  let best: { body: Body; particle: number } | null = null;
  let nearest = Infinity;
  for (const { body } of app.stage.particles.values()) {
    const position = body.position;
    if (!position) continue;
    for (let i = 0; i < position.length / 3; i++) {
      at.fromArray(position, 3 * i).applyMatrix4(matrix);
      const px = canvas.left + ((at.x + 1) / 2) * canvas.width;
      const py = canvas.top + ((1 - at.y) / 2) * canvas.height;
      const away = Math.hypot(px - x, py - y);
      // a pixel further off counts as a little further away
      const rank = at.z + away * 1e-4;
      if (away < reach && at.z < 1 && rank < nearest) {
        nearest = rank;
        best = { body, particle: i };
      }
    }
  }
  return best;
}

// Picks the particle there and asks for its neighbours.
export async function pickParticle(app: App, x: number, y: number): Promise<void> {
  if (!app.stage.particlesShown()) return;
  const picked = particleAt(app, x, y);
  if (!picked) app.stage.neighbourhood.clear();
  else {
    const { body, particle } = picked;
    app.stage.neighbourhood.show(body, particle, []);
    const answer = await app.connection.ask({ type: 'neighbours', body: body.info.id, particle });
    if (answer.done) app.stage.neighbourhood.show(body, particle, answer.ids ?? []);
    else app.tell(answer.text ?? 'Its neighbours are not known.');
  }
  app.world.draw();
  document.dispatchEvent(new Event('stroma-picked'));
}
