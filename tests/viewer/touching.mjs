// SPDX-License-Identifier: Apache-2.0
// Laws of what one sees and of what the mouse does to the tissue.
import { apex, chooseTool, inMillimetres, law, require, settled, simulate } from './harness.mjs';

export async function looking(viewer) {
  await law('theCanvasShowsTheScene', async () => {
    const { share, colours } = await viewer.canvasPixels();
    require(share > 0.15, `only ${(100 * share).toFixed(1)} % differ from the background`);
    require(colours > 500, `only ${colours} colours`);
    return `${(100 * share).toFixed(0)} % of the pixels, ${colours} colours`;
  });
  await law('timePasses', async () => {
    const { step } = await viewer.state();
    await viewer.waitFor((was) => window.stroma.state().step > was + 20, '20 steps', 30_000, step);
    const { realTimeFactor } = await viewer.state();
    return `${realTimeFactor.toFixed(2)} of real time`;
  });
}

export async function pressing(viewer) {
  await law('theSurfaceGivesUnderTheProbe', async () => {
    const before = await settled(viewer, apex);
    await chooseTool(viewer, 'ProbeTool');
    const at = await viewer.screenPoint(before);
    await viewer.page.mouse.move(...at);
    await viewer.page.mouse.down();
    await viewer.waitFor(
      (z) => window.stroma.pointNow([0, 0, 0])[2] < z - 1e-4,
      'a dent of 0.1 mm',
      20_000,
      before[2],
    );
    await viewer.screenshot('probe');
    const { tools } = await viewer.state();
    const dent = before[2] - (await viewer.pointNow(apex))[2];
    await viewer.page.mouse.up();
    const force = Math.max(...tools.map((tool) => Math.hypot(...tool.force)));
    require(force > 0, 'the probe feels no force');
    await simulate(viewer, 0.2);
    const after = await settled(viewer, apex);
    require(Math.abs(after[2] - before[2]) <
      0.3 * dent, `it stays ${inMillimetres(before[2] - after[2])} down`);
    return `${inMillimetres(dent)}, ${(1e3 * force).toFixed(2)} mN`;
  });
}

export async function pulling(viewer) {
  await law('theTissueFollowsTheGrip', async () => {
    const before = await settled(viewer, apex);
    await chooseTool(viewer, 'GripTool');
    const from = await viewer.screenPoint(before);
    await viewer.page.mouse.move(...from);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(from[0], from[1] - 60, { steps: 15 });
    await viewer.waitFor(
      (was) => {
        const now = window.stroma.pointNow([0, 0, 0]);
        return Math.hypot(...now.map((x, k) => x - was[k])) > 2e-4;
      },
      'a pull of 0.2 mm',
      20_000,
      before,
    );
    const now = await viewer.pointNow(apex);
    await viewer.screenshot('pull');
    await viewer.page.mouse.up();
    return inMillimetres(Math.hypot(...now.map((x, k) => x - before[k])));
  });
}

export async function cutting(viewer) {
  await law('aStrokeWithTheScalpelCuts', async () => {
    await chooseTool(viewer, 'ScalpelTool');
    const before = await viewer.surface();
    await viewer.drag(
      [
        [-2.2e-3, 0, -3e-4],
        [0, 2e-4, 1e-4],
        [2.2e-3, 0, -3e-4],
      ],
      { steps: 30 },
    );
    await viewer.waitFor(
      () => window.stroma.state().bodies.some((body) => body.walls > 20),
      'an incision',
      40_000,
    );
    await viewer.page.waitForTimeout(2000);
    await viewer.page.keyboard.press('o');
    await viewer.screenshot('cut');
    const after = await viewer.surface();
    require(after.revision !== before.revision, 'the mesh has no new revision');
    require(after.points > before.points, 'the mesh has no new points');
    return `${after.walls} triangles of walls, ${after.points - before.points} new points`;
  });
}
