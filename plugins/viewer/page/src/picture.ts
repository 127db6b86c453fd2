// SPDX-License-Identifier: Apache-2.0
import type { App } from './app';
import { shownEnd, viridis } from './colours';
import { legendUnit, unitOfField } from './panels/legend';
import { formatNumber } from './quantity';
import type { Options } from './options';
import { colourChoices, isSent, readable } from './view/colouring';

// Whether all that is to be seen has come.
export function isComplete(app: App): boolean {
  const { model, settings, stage } = app;
  if (!model.scene || !model.frame) return false;
  const { colour } = settings.values;
  for (const body of model.bodies.values()) {
    const shown = body.info.kind === 'surface' ? settings.values.surface : stage.particlesShown();
    if (!shown) continue;
    if (!body.topology) return false;
    const part = model.frame.bodies.find((one) => one.body === body.info.id);
    if (part?.revision !== body.topology.revision) return false;
    if (colour && isSent(body, colour) && body.fieldName !== colour) return false;
  }
  return true;
}

// What is wrong with the field that was asked for.
function wrongColour(app: App): string | null {
  const { scene, bodies } = app.model;
  const { colour } = app.settings.values;
  if (!scene || !colour) return null;
  const hasTexture = [...bodies.values()].some((body) => body.topology?.texture);
  const names = colourChoices(scene, hasTexture).map(({ name }) => name);
  if (names.includes(colour)) return null;
  return `the scene has no field '${colour}' to colour by; it has: ${names.filter(Boolean).join(', ')}`;
}

// Sends one picture of the canvas as soon as it is complete.
export function sendPictureWhenComplete(app: App, picture: NonNullable<Options['picture']>): void {
  let sent = false;
  app.model.on('frame', () => {
    const problem = wrongColour(app);
    if (sent || (!problem && !isComplete(app))) return;
    sent = true;
    if (problem) {
      app.connection.send({ type: 'picture', problem });
      return;
    }
    app.world.resize(picture.width, picture.height, 1);
    app.world.drawNow();
    const png = withLegend(app).toDataURL('image/png');
    app.connection.send({ type: 'picture', png: png.slice(png.indexOf(',') + 1) });
    document.body.dataset.picture = 'sent';
  });
}

// The canvas, with the legend of its colours where they mean numbers.
function withLegend(app: App): HTMLCanvasElement {
  const source = app.world.canvas;
  const canvas = document.createElement('canvas');
  canvas.width = source.width;
  canvas.height = source.height;
  const draw = canvas.getContext('2d')!;
  draw.drawImage(source, 0, 0);
  const { colour } = app.settings.values;
  const range = app.stage.range;
  if (!range || !colour) return canvas;
  const unit = legendUnit(range, unitOfField(app, colour));
  const side = Math.max(10, Math.round(canvas.height / 45));
  const width = 12 * side;
  const left = 1.4 * side;
  const top = canvas.height - 2.9 * side;
  for (let i = 0; i < width; i++) {
    draw.fillStyle = `rgb(${viridis(i / (width - 1))
      .map((c) => Math.round(255 * c))
      .join(',')})`;
    draw.fillRect(left + i, top, 1, 0.6 * side);
  }
  draw.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--text');
  draw.font = `${0.85 * side}px system-ui, "DejaVu Sans", sans-serif`;
  draw.textBaseline = 'top';
  draw.fillText(formatNumber(shownEnd(range.low, range) / unit.factor, 3), left, top + 0.85 * side);
  draw.textAlign = 'right';
  draw.fillText(
    formatNumber(shownEnd(range.high, range) / unit.factor, 3),
    left + width,
    top + 0.85 * side,
  );
  draw.textAlign = 'left';
  draw.textBaseline = 'bottom';
  draw.fillText(
    `${readable(colour)}${unit.text ? ` (${unit.text})` : ''}`,
    left,
    top - 0.25 * side,
  );
  return canvas;
}
