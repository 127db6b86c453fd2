// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { App } from './app';
import { rangeOf } from './colours';
import { enclosedVolume, type Body } from './model';
import { isComplete } from './picture';
import type { Answer, Request, Vec3 } from './protocol';
import { valuesOf } from './view/colouring';

declare global {
  interface Window {
    stroma: ScriptInterface;
  }
}

// What scripts and tests see of the page.
export interface ScriptInterface {
  readonly ready: boolean;
  readonly problems: string[];
  state(): Record<string, unknown>;
  screenPoint(point: Vec3): [number, number];
  // Where the surface's point whose place at rest is nearest to this one is now.
  pointNow(rest: Vec3): number[] | null;
  send(request: Request): Promise<Answer>;
}

export function scriptInterface(app: App, problems: string[]): ScriptInterface {
  return {
    get ready() {
      return isComplete(app);
    },
    problems,
    state: () => stateOf(app),
    screenPoint: (point) => app.world.screenPoint(new THREE.Vector3(...point)),
    pointNow: (rest) => pointNow(app, rest),
    send: (what) => app.connection.ask(what),
  };
}

function stateOf(app: App): Record<string, unknown> {
  const { model } = app;
  return {
    connected: app.connection.isOpen,
    generation: model.scene?.generation ?? 0,
    file: model.scene?.file ?? '',
    time: model.frame?.time ?? 0,
    step: model.frame?.step ?? 0,
    playing: model.status?.playing ?? false,
    realTimeFactor: model.status?.realTimeFactor ?? 0,
    stopped: model.status?.stopped ?? '',
    steers: model.steers,
    values: model.status?.values ?? {},
    kept: model.status?.kept ?? [],
    changes: model.scene?.changes ?? [],
    diagnostics: model.diagnostics.items,
    broken: model.diagnostics.broken,
    camera: app.world.camera.state(),
    tool: app.choice.tool?.path ?? null,
    depth: app.choice.depth,
    tools: model.tools,
    toolInfo: model.scene?.tools ?? [],
    bodies: [...model.bodies.values()].map((body) => bodyState(body)),
    colour: app.settings.values.colour,
    range: app.stage.range,
  };
}

function bodyState(body: Body): Record<string, unknown> {
  const { topology, position, info } = body;
  const displacement = valuesOf({ ...body, info: { ...info, fields: [] } }, 'displacement');
  return {
    id: info.id,
    kind: info.kind,
    path: info.path,
    points: topology ? topology.rest.length / 3 : 0,
    triangles: topology ? topology.triangles.length / 3 : 0,
    walls: topology?.walls?.reduce((sum, wall) => sum + wall, 0) ?? 0,
    pieces: topology?.pieces ? new Set(topology.pieces).size : 1,
    revision: topology?.revision ?? -1,
    volume: topology && position ? enclosedVolume(position, topology.triangles) : 0,
    mostDisplacement: displacement ? (rangeOf(displacement)?.high ?? 0) : 0,
    lowest: position ? extreme(position, 1) : null,
    highest: position ? extreme(position, -1) : null,
  };
}

function pointNow(app: App, rest: Vec3): number[] | null {
  let nearest = Infinity;
  let found: number[] | null = null;
  for (const { topology, position } of app.model.surfaces()) {
    if (!topology || position?.length !== topology.rest.length) continue;
    for (let i = 0; i < position.length; i += 3) {
      const away = Math.hypot(...rest.map((x, k) => x - topology.rest[i + k]!));
      if (away >= nearest) continue;
      nearest = away;
      found = [...position.subarray(i, i + 3)];
    }
  }
  return found;
}

// The point with the least (1) or the greatest (-1) z.
function extreme(position: Float32Array, sign: 1 | -1): number[] {
  let best = 0;
  for (let i = 3; i < position.length; i += 3) {
    if (sign * position[i + 2]! < sign * position[best + 2]!) best = i;
  }
  return [...position.subarray(best, best + 3)];
}
