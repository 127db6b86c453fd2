// SPDX-License-Identifier: Apache-2.0
import type { App } from '../app';
import { h, setText } from '../dom';
import { formatNumber, formatQuantity, parseQuantity } from '../quantity';

// What is simulated, in a line: how many particles, how stiff, in which steps.
export function summary(app: App): HTMLElement {
  const line = h('p', { className: 'muted summary' });
  const refresh = (): void => {
    const { scene } = app.model;
    if (!scene) return;
    const parts: string[] = [];
    let particles = 0;
    let triangles = 0;
    for (const { info, topology } of app.model.bodies.values()) {
      if (info.kind === 'particles') particles += (topology?.rest.length ?? 0) / 3;
      else triangles += (topology?.triangles.length ?? 0) / 3;
    }
    if (particles) parts.push(`${particles.toLocaleString('en')} particles`);
    if (triangles) parts.push(`${triangles.toLocaleString('en')} triangles`);
    for (const { path, attribute } of app.model.everyAttribute()) {
      if (!path.endsWith('.youngModulus')) continue;
      const modulus = parseQuantity(attribute.value, 'Pa');
      if (Number.isFinite(modulus)) parts.push(formatQuantity(modulus, 'Pa', 3));
    }
    parts.push(`steps of ${formatNumber(1e3 * scene.dt, 3)} ms`);
    setText(line, parts.join(' · '));
  };
  app.model.on('scene', refresh);
  app.model.on('topology', refresh);
  app.model.on('attributes', refresh);
  return line;
}
