// SPDX-License-Identifier: Apache-2.0
// Laws of what one changes, keeps and goes back to.
import { readFileSync, writeFileSync } from 'node:fs';
import { apex, inMillimetres, law, require, settled, simulate } from './harness.mjs';

export async function changing(viewer) {
  await law('aSliderChangesTheStiffnessAndTheDeflectionFollows', async () => {
    await viewer.page.keyboard.press('o');
    const soft = await settled(viewer, apex);
    await viewer.page.click('.entry[data-path="/cornea/elasticity"]');
    const row = viewer.page.locator('.attribute[data-path="/cornea/elasticity.youngModulus"]');
    const slider = await row.locator('input[type=range]').boundingBox();
    const field = row.locator('input[type=text]');
    const was = await field.inputValue();
    const knob = await row.locator('input[type=range]').evaluate((one) => Number(one.value) / 1000);
    const y = slider.y + slider.height / 2;
    await viewer.page.mouse.move(slider.x + 8 + knob * (slider.width - 16), y);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(slider.x + slider.width - 2, y, { steps: 8 });
    await viewer.page.mouse.up();
    await viewer.waitFor(
      () => window.stroma.state().changes.some((change) => change.includes('youngModulus')),
      'the change',
    );
    await simulate(viewer, 0.2);
    const stiff = await settled(viewer, apex);
    const now = await field.inputValue();
    await viewer.screenshot('stiffness');
    require(now !== was, `the field still says ${was}`);
    // the pressure below lifts the apex; a stiffer cornea is lifted less
    require(stiff[2] <
      0.7 *
        soft[2], `lifted by ${inMillimetres(soft[2])} before and ${inMillimetres(stiff[2])} after`);
    await viewer.page.keyboard.press('Control+z');
    await viewer.waitFor(() => window.stroma.state().changes.length === 0, 'the change taken back');
    const back = await settled(viewer, apex);
    require(Math.abs(back[2] - soft[2]) <
      0.2 * (soft[2] - stiff[2]), 'the apex does not come back');
    return `${was}: lifted by ${inMillimetres(soft[2])}; ${now}: by ${inMillimetres(stiff[2])}`;
  });
  await law('aPickedParticleShowsItsNeighbours', async () => {
    await viewer.page.click('#show-particles');
    await viewer.waitFor(() => window.stroma.ready, 'the particles');
    await viewer.page.mouse.click(
      ...(await viewer.screenPoint(await viewer.pointNow([0, -2e-3, -3e-4]))),
    );
    const facts = viewer.page.locator('aside.right .facts');
    await facts.getByText('Neighbours').waitFor({ timeout: 10_000 });
    await viewer.page.waitForTimeout(800);
    await viewer.screenshot('neighbours');
    const text = await facts.innerText();
    await viewer.page.click('#show-particles');
    const count = Number(/Neighbours\s+(\d+)/.exec(text)?.[1]);
    require(count > 3, text);
    return `${count} neighbours`;
  });
  await law('coloursHaveALegend', async () => {
    await viewer.page.selectOption('#colour', 'displacement');
    await viewer.waitFor(() => window.stroma.state().range?.high > 0, 'a range');
    await viewer.screenshot('colour');
    const shown = await viewer.page.locator('.legend').isVisible();
    require(shown, 'no legend');
    await viewer.page.selectOption('#colour', '');
  });
}

export async function keeping(viewer) {
  await law('theSceneAndAPictureCanBeKept', async () => {
    const picture = viewer.page.waitForEvent('download', { timeout: 15_000 });
    await viewer.page.keyboard.press('p');
    const png = readFileSync(await (await picture).path());
    require(png.subarray(1, 4).toString() === 'PNG' && png.length > 5000, 'no picture');
    const answer = await viewer.page.evaluate(() =>
      window.stroma.send({ type: 'save', what: 'scene' }),
    );
    require(answer.done && answer.files?.[0].text.includes('<Node'), answer.text || 'no scene');
    const recording = await viewer.page.evaluate(() =>
      window.stroma.send({ type: 'save', what: 'recording' }),
    );
    require(recording.done &&
      recording.files.some(({ text }) => text.startsWith('time,x,y,z')), 'no recording');
    return `picture of ${png.length} bytes, ${recording.files.length} files of a recording`;
  });
  await law('aVideoCanBeKept', async () => {
    const video = viewer.page.waitForEvent('download', { timeout: 30_000 });
    await viewer.page.keyboard.press('v');
    await simulate(viewer, 0.5);
    await viewer.page.waitForTimeout(1500);
    await viewer.page.keyboard.press('v');
    const download = await video;
    const webm = readFileSync(await download.path());
    require(download.suggestedFilename().endsWith('.webm') &&
      webm.length > 2000, `${webm.length} bytes`);
    require(webm.readUInt32BE(0) === 0x1a45dfa3, 'is no WebM');
    return `${webm.length} bytes`;
  });
  await law('timeIsToldAndGoneBackTo', async () => {
    await viewer.waitFor(() => document.querySelectorAll('#budget .bar').length > 2, 'the stages');
    await viewer.page.click('#budget');
    await viewer.waitFor(
      () => document.querySelectorAll('.timing tbody tr').length > 4,
      'the calls',
    );
    await viewer.screenshot('timing');
    await viewer.page.click('#budget');
    await viewer.waitFor(() => window.stroma.state().kept.length > 1, 'kept states');
    await viewer.page.click('#play');
    await viewer.waitFor(() => !window.stroma.state().playing, 'the pause');
    await viewer.page.waitForTimeout(500);
    const { kept, time } = await viewer.state();
    const to = kept[Math.floor(kept.length / 2)];
    const answer = await viewer.page.evaluate(
      (t) => window.stroma.send({ type: 'rewind', time: t }),
      to,
    );
    require(answer.done, answer.text);
    await viewer.waitFor(
      (t) => Math.abs(window.stroma.state().time - t) < 1e-6,
      'the kept state',
      15_000,
      to,
    );
    await viewer.page.click('#play');
    await simulate(viewer, 0.1);
    return `from ${time.toFixed(2)} s to ${to.toFixed(2)} s`;
  });
}

export async function editing(viewer, file) {
  const good = readFileSync(file, 'utf8');
  await law('savingTheFileReloadsAndKeepsTheCamera', async () => {
    const box = await viewer.page.locator('canvas').first().boundingBox();
    await viewer.page.mouse.move(box.x + 100, box.y + 100);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(box.x + 190, box.y + 130, { steps: 6 });
    await viewer.page.mouse.up();
    const before = await viewer.state();
    writeFileSync(file, good.replace('pressure="-100 Pa"', 'pressure="-160 Pa"'));
    await viewer.waitFor(
      (was) => window.stroma.state().generation > was && window.stroma.ready,
      'the new scene',
      40_000,
      before.generation,
    );
    const after = await viewer.state();
    const moved = Math.hypot(...after.camera.position.map((x, k) => x - before.camera.position[k]));
    require(moved < 1e-9, `the camera moved by ${inMillimetres(moved)}`);
    await viewer.page.click('.entry[data-path="/cornea/surface/pressure"]');
    const shown = await viewer.page
      .locator('.attribute[data-path="/cornea/surface/pressure.pressure"] input[type=text]')
      .inputValue();
    require(/160/.test(shown), `the inspector shows ${shown}`);
    return `pressure ${shown}`;
  });
  await law('aBrokenFileShowsItsDiagnosticAndTheLastSceneRuns', async () => {
    writeFileSync(file, good.replace('youngModulus=', 'youngModulu='));
    await viewer.waitFor(() => window.stroma.state().broken, 'the diagnostic', 40_000);
    const { diagnostics, step } = await viewer.state();
    const line = good.split('\n').findIndex((text) => text.includes('youngModulus=')) + 1;
    const item = diagnostics.find((one) => one.severity === 'error');
    require(item && item.line === line, `line ${item?.line} in place of ${line}`);
    require(/youngModulu/.test(item.message), item.message);
    require(await viewer.page.locator('#broken').isVisible(), 'no banner');
    const excerpt = await viewer.page.locator('#diagnostics pre').first().textContent();
    require(/\^/.test(excerpt), `no caret in ${excerpt}`);
    await viewer.screenshot('broken');
    await viewer.waitFor(
      (was) => window.stroma.state().step > was,
      'more steps of the last scene',
      20_000,
      step,
    );
    return item.message;
  });
  await law('aMendedFileTakesTheDiagnosticAway', async () => {
    writeFileSync(file, good);
    await viewer.waitFor(() => !window.stroma.state().broken, 'the mended scene', 40_000);
    require(!(await viewer.page.locator('#broken').isVisible()), 'the banner stays');
  });
}
