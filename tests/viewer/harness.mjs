// SPDX-License-Identifier: Apache-2.0
// What every law is checked with.

const millimetre = 1e-3;
export const apex = [0, 0, 0];
export const tally = { passed: 0, failed: 0 };

export function require(condition, text) {
  if (!condition) throw new Error(text);
}

export async function law(name, body) {
  try {
    const measured = await body();
    tally.passed++;
    console.log(`ok      ${name}${measured ? `: ${measured}` : ''}`);
  } catch (problem) {
    tally.failed++;
    console.log(`FAILED  ${name}: ${problem.message}`);
  }
}

export const inMillimetres = (x) => `${(x / millimetre).toFixed(3)} mm`;

export async function chooseTool(viewer, type) {
  const { toolInfo } = await viewer.state();
  const tool = toolInfo.find((one) => one.type === type);
  await viewer.page.click(`[data-tool="${tool.path}"]`);
  await viewer.waitFor(
    (path) => window.stroma.state().tool === path,
    `the mouse with ${type}`,
    20_000,
    tool.path,
  );
}

// Lets time (s) pass in the simulation, however slow it is.
export async function simulate(viewer, time) {
  const { time: from } = await viewer.state();
  await viewer.waitFor(
    (until) => window.stroma.state().time >= until,
    `${time} s more`,
    60_000,
    from + time,
  );
}

// Waits until a point of the surface is at rest and gives its place.
export async function settled(viewer, rest) {
  await simulate(viewer, 0.1);
  let before = await viewer.pointNow(rest);
  for (let i = 0; i < 20; i++) {
    await simulate(viewer, 0.15);
    const now = await viewer.pointNow(rest);
    if (Math.hypot(...now.map((x, k) => x - before[k])) < 2e-6) return now;
    before = now;
  }
  return before;
}
