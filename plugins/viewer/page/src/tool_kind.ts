// SPDX-License-Identifier: Apache-2.0
import type { ToolInfo } from './protocol';

// What a tool does under the mouse, read from its shape:
// grip: takes hold where it is put; probe: presses with a ball; blade: cuts the way its edge looks;
// pushed: a blade with two sides that goes in along its axis; punch: a ring that is pressed down.
export type ToolKind = 'grip' | 'probe' | 'blade' | 'pushed' | 'punch';

export function kindOf(tool: ToolInfo): ToolKind {
  if (tool.edge.length < 2) return /grip/i.test(tool.type) ? 'grip' : 'probe';
  const size = reachOf(tool);
  const first = tool.edge[0]!;
  const last = tool.edge[tool.edge.length - 1]!;
  const closed =
    tool.edge.length > 3 && Math.hypot(...first.map((x, k) => x - last[k]!)) < 1e-3 * size;
  if (closed) return 'punch';
  const sides = tool.edge.map((p) => p[0]);
  if (Math.min(...sides) < -0.02 * size && Math.max(...sides) > 0.02 * size) return 'pushed';
  return 'blade';
}

// Largest distance (m) of the tool's shape from its tip.
export function reachOf(tool: ToolInfo): number {
  let reach = tool.radius;
  for (const p of [...tool.edge, ...tool.samples]) reach = Math.max(reach, Math.hypot(...p));
  return reach;
}

// Along x, the side to which a blade cuts.
export function cuttingSide(tool: ToolInfo): 1 | -1 {
  return tool.edge.reduce((sum, p) => sum + p[0], 0) < 0 ? -1 : 1;
}

export function toolName(tool: ToolInfo): string {
  const type = tool.type.replace(/Tool$/, '');
  return type === 'Grip' ? 'Pull' : type;
}
