// SPDX-License-Identifier: Apache-2.0
// Watches, presses, cuts and changes a cornea in a headless browser. Prints a line for each law and,
// at the end, "N passed, N failed".
import { cpSync, mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { startBrowser, Viewer } from './browser.mjs';
import { changing, editing, keeping } from './changing.mjs';
import { inMillimetres, law, require, tally } from './harness.mjs';
import { startSimulation } from './simulation.mjs';
import { cutting, looking, pressing, pulling } from './touching.mjs';

const { values: use } = parseArgs({
  options: Object.fromEntries(
    ['stroma', 'page', 'scenes', 'out', 'browser'].map((name) => [name, { type: 'string' }]),
  ),
});

// The scene of one's own: everything a person does to it.
async function interactiveScene(browser, scenes) {
  const file = join(scenes, 'cornea', 'interactive.xml');
  const simulation = await startSimulation(use.stroma, file);
  try {
    const viewer = await Viewer.open(browser, simulation.address, { out: use.out });
    await viewer.page.waitForTimeout(500);
    await viewer.screenshot('first');
    await looking(viewer);
    await pressing(viewer);
    await pulling(viewer);
    await changing(viewer);
    await cutting(viewer);
    await keeping(viewer);
    await editing(viewer, file);
    await law('aSecondWindowWatchesAndMayTakeOver', () => secondWindow(browser, simulation));
    await viewer.page.keyboard.press('?');
    await viewer.page.emulateMedia({ colorScheme: 'light' });
    await viewer.screenshot('keys-light');
    await law('theConsoleHasNoError', async () => {
      const { errors } = viewer;
      errors.push(...(await viewer.page.evaluate(() => window.stroma.problems)));
      require(errors.length === 0, errors.join('; '));
    });
    await law('thePageTellsTheEnd', async () => {
      await simulation.stop();
      await viewer.page.locator('.ended').waitFor({ state: 'visible', timeout: 15_000 });
    });
  } finally {
    await simulation.stop();
  }
}

async function secondWindow(browser, simulation) {
  const other = await Viewer.open(browser, simulation.address, { theme: 'light', out: use.out });
  try {
    require((await other.state()).steers === false, 'it steers unasked');
    require(await other.page.locator('#play').isDisabled(), 'its controls are open');
    await other.screenshot('watching-light');
    await other.page.click('.steer');
    await other.waitFor(() => window.stroma.state().steers, 'the helm');
    require(other.errors.length === 0, other.errors.join('; '));
  } finally {
    await other.page.close();
  }
}

// The scripted scene: watched only.
async function scriptedScene(browser, scenes) {
  const simulation = await startSimulation(use.stroma, join(scenes, 'cornea', 'cut.xml'));
  try {
    const viewer = await Viewer.open(browser, simulation.address, { theme: 'light', out: use.out });
    await law('aScriptedBladeIsSeenToPress', async () => {
      const { playing } = await viewer.state();
      if (!playing) await viewer.page.keyboard.press(' ');
      await viewer.waitFor(
        () => window.stroma.state().bodies.some((body) => body.walls > 0),
        'the incision',
        150_000,
      );
      const { bodies, time } = await viewer.state();
      const most = Math.max(...bodies.map((body) => body.mostDisplacement));
      await viewer.screenshot('scripted-light');
      require(most > 1e-5, `moved by ${inMillimetres(most)} only`);
      return `at ${time.toFixed(3)} s, moved by ${inMillimetres(most)}`;
    });
    await law('theScriptedSceneHasNoConsoleError', async () => {
      require(viewer.errors.length === 0, viewer.errors.join('; '));
    });
  } finally {
    await simulation.stop();
  }
}

mkdirSync(use.out, { recursive: true });
const scenes = mkdtempSync(join(tmpdir(), 'stroma-viewer-test-'));
for (const folder of ['cornea', 'meshes'])
  cpSync(join(use.scenes, folder), join(scenes, folder), { recursive: true });
const browser = await startBrowser(use.browser, use.page);
try {
  await interactiveScene(browser, scenes);
  await scriptedScene(browser, scenes);
} finally {
  await browser.close();
  rmSync(scenes, { recursive: true, force: true });
}
console.log(`${tally.passed} passed, ${tally.failed} failed`);
process.exit(tally.failed ? 1 : 0);
