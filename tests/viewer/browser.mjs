// SPDX-License-Identifier: Apache-2.0
// A headless Chromium with the page of a viewer in it, and what tests do with that page.
import { createRequire } from 'node:module';
import { join } from 'node:path';

const flags = [
  '--no-sandbox',
  '--disable-gpu-sandbox',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

export async function startBrowser(executablePath, pageFolder) {
  const { chromium } = createRequire(join(pageFolder, 'package.json'))('playwright-core');
  return chromium.launch({ executablePath, args: flags });
}

// One window. Every console error, uncaught exception and failed request is noted.
export class Viewer {
  errors = [];

  static async open(browser, address, { theme = 'dark', out }) {
    const viewer = new Viewer();
    viewer.out = out;
    viewer.page = await browser.newPage({
      viewport: { width: 1280, height: 800 },
      colorScheme: theme,
    });
    viewer.page.on('console', (message) => {
      if (message.type() === 'error') viewer.errors.push(message.text());
    });
    viewer.page.on('pageerror', (error) => viewer.errors.push(error.stack ?? String(error)));
    viewer.page.on('requestfailed', (failed) => viewer.errors.push(`${failed.url()} failed`));
    await viewer.page.goto(address);
    await viewer.waitFor(() => window.stroma?.ready, 'the first picture', 60_000);
    return viewer;
  }

  state() {
    return this.page.evaluate(() => window.stroma.state());
  }

  async surface() {
    const { bodies } = await this.state();
    return bodies.find((body) => body.kind === 'surface');
  }

  // Where the surface's point whose place at rest is nearest to `rest` is now (m).
  pointNow(rest) {
    return this.page.evaluate((p) => window.stroma.pointNow(p), rest);
  }

  async screenPoint(point) {
    return this.page.evaluate((p) => window.stroma.screenPoint(p), point);
  }

  // Polls a condition in the page, from outside: the page itself may not evaluate texts.
  async waitFor(condition, what, timeout = 30_000, argument = undefined) {
    const last = Date.now() + timeout;
    while (!(await this.page.evaluate(condition, argument))) {
      if (Date.now() > last) throw new Error(`${what} did not come; seen: ${await this.summary()}`);
      await this.page.waitForTimeout(100);
    }
  }

  summary() {
    return this.page.evaluate(() => {
      const { bodies, time, step, playing, stopped, connected } = window.stroma?.state() ?? {};
      const seen = bodies?.map(({ path, points, walls, revision }) => ({
        path,
        points,
        walls,
        revision,
      }));
      return JSON.stringify({ time, step, playing, stopped, connected, bodies: seen });
    });
  }

  // Presses the mouse at the first of some points of the scene and drags it over the others.
  async drag(points, { steps = 25, hold = 0, button = 'left' } = {}) {
    const at = [];
    for (const point of points) at.push(await this.screenPoint(point));
    await this.page.mouse.move(...at[0]);
    await this.page.mouse.down({ button });
    for (const next of at.slice(1)) await this.page.mouse.move(...next, { steps });
    if (hold) await this.page.waitForTimeout(hold);
    await this.page.mouse.up({ button });
  }

  async screenshot(name) {
    await this.page.screenshot({ path: join(this.out, `${name}.png`) });
  }

  // How many pixels of the canvas differ from its corner, and how many colours it has.
  async canvasPixels() {
    const png = await this.page.locator('canvas').first().screenshot();
    return this.page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const draw = canvas.getContext('2d');
      draw.drawImage(image, 0, 0);
      const { data } = draw.getImageData(0, 0, image.width, image.height);
      const colours = new Set();
      let other = 0;
      for (let i = 0; i < data.length; i += 4) {
        colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
        const away =
          Math.abs(data[i] - data[0]) +
          Math.abs(data[i + 1] - data[1]) +
          Math.abs(data[i + 2] - data[2]);
        if (away > 24) other++;
      }
      return { share: other / (data.length / 4), colours: colours.size };
    }, png.toString('base64'));
  }
}
