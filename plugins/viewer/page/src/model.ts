// SPDX-License-Identifier: Apache-2.0
import {
  bytes,
  findArray,
  floats,
  indices,
  positions,
  type ArrayHeader,
  type BinaryMessage,
  type FrameHeader,
  type TopologyHeader,
} from './decode';
import { Emitter } from './events';
import type {
  Attribute,
  AttributeValues,
  BodyInfo,
  Diagnostics,
  Hello,
  SceneInfo,
  ServerMessage,
  Status,
  ToolFrame,
} from './protocol';

export interface Topology {
  revision: number;
  rest: Float32Array;
  triangles: Uint32Array;
  walls: Uint8Array | null;
  pieces: Uint32Array | null;
  texture: Float32Array | null;
}

// A body as it was last seen.
export interface Body {
  info: BodyInfo;
  topology: Topology | null;
  position: Float32Array | null;
  positionStep: number; // m, what positions are rounded to
  velocity: Float32Array | null; // from the last two frames
  field: Float32Array | null;
  fieldName: string;
}

interface ModelEvents {
  hello: Hello;
  scene: SceneInfo;
  status: Status;
  diagnostics: Diagnostics;
  attributes: AttributeValues;
  changes: string[];
  topology: Body;
  frame: FrameHeader;
}

// What the page knows of the scene. Messages go in, events come out.
export class Model extends Emitter<ModelEvents> {
  hello: Hello | null = null;
  scene: SceneInfo | null = null;
  status: Status | null = null;
  diagnostics: Diagnostics = { type: 'diagnostics', items: [], broken: false };
  readonly bodies = new Map<number, Body>();
  tools: ToolFrame[] = [];
  frame: FrameHeader | null = null;

  get steers(): boolean {
    return this.status?.steers ?? this.hello?.steers ?? false;
  }

  take(message: Exclude<ServerMessage, { type: 'answer' }>): void {
    switch (message.type) {
      case 'hello':
        this.hello = message;
        this.status = null;
        this.emit('hello', message);
        break;
      case 'scene':
        this.showScene(message);
        break;
      case 'status':
        this.status = message;
        this.emit('status', message);
        break;
      case 'diagnostics':
        this.diagnostics = message;
        this.emit('diagnostics', message);
        break;
      case 'attributes':
        this.noteAttributes(message);
        break;
    }
  }

  takeBinary(message: BinaryMessage): void {
    if (message.header.generation !== this.scene?.generation) return;
    if (message.kind === 'topology') this.takeTopology(message.header, message);
    else this.takeFrame(message.header, message);
  }

  private showScene(scene: SceneInfo): void {
    this.scene = scene;
    this.bodies.clear();
    this.tools = [];
    this.frame = null;
    for (const info of scene.bodies) {
      this.bodies.set(info.id, {
        info,
        topology: null,
        position: null,
        positionStep: 0,
        velocity: null,
        field: null,
        fieldName: '',
      });
    }
    this.emit('scene', scene);
  }

  private noteAttributes(message: AttributeValues): void {
    for (const { path, attribute } of this.everyAttribute()) {
      const value = message.values[path];
      if (value === undefined) continue;
      attribute.value = value;
      if (!attribute.output) this.noteChange(path, value, attribute);
    }
    this.emit('attributes', message);
  }

  // An attribute has another value in the running scene.
  noteSet(path: string, value: string): void {
    this.noteAttributes({ type: 'attributes', values: { [path]: value } });
  }

  private noteChange(path: string, value: string, attribute: Attribute): void {
    attribute.isSet = true;
    const { scene } = this;
    if (!scene) return;
    scene.changes = scene.changes.filter((line) => !line.startsWith(`${path} `));
    scene.changes.push(`${path} = ${value}`);
    this.emit('changes', scene.changes);
  }

  private takeTopology(header: TopologyHeader, message: BinaryMessage): void {
    const body = this.bodies.get(header.body);
    if (!body) return;
    const rest = findArray(header.arrays, 'rest');
    const triangles = findArray(header.arrays, 'triangles');
    const walls = findArray(header.arrays, 'walls');
    const pieces = findArray(header.arrays, 'pieces');
    const texture = findArray(header.arrays, 'texture');
    body.topology = {
      revision: header.revision,
      rest: rest ? positions(rest, message) : new Float32Array(0),
      triangles: triangles ? indices(triangles, message) : new Uint32Array(0),
      walls: walls ? bytes(walls, message) : null,
      pieces: pieces ? indices(pieces, message) : null,
      texture: texture ? floats(texture, message) : null,
    };
    body.position = body.topology.rest.slice();
    body.velocity = body.field = null;
    this.emit('topology', body);
  }

  private takeFrame(header: FrameHeader, message: BinaryMessage): void {
    const past = header.time - (this.frame?.time ?? header.time);
    for (const part of header.bodies) {
      const body = this.bodies.get(part.body);
      if (!body?.topology || body.topology.revision !== part.revision) continue;
      const position = findArray(part.arrays, 'position');
      if (position) {
        const before = body.position?.slice() ?? null;
        body.position = positions(position, message, body.position ?? undefined);
        body.positionStep = stepOf(position);
        body.velocity =
          past > 0 && before ? rates(before, body.position, past, body.positionStep) : null;
      }
      const field = findArray(part.arrays, 'field');
      // where a frame brings none, that of before is still the newest
      if (field) {
        body.field = floats(field, message).slice();
        body.fieldName = field.field ?? '';
      }
    }
    this.tools = header.tools;
    this.frame = header;
    this.emit('frame', header);
  }

  // Every attribute of the scene with its path.
  *everyAttribute(): Generator<{ path: string; attribute: SceneInfo['root']['attributes'][0] }> {
    const nodes = this.scene ? [this.scene.root] : [];
    while (nodes.length) {
      const node = nodes.pop()!;
      for (const owner of [node, ...node.components]) {
        for (const attribute of owner.attributes) {
          yield { path: `${owner.path}.${attribute.name}`, attribute };
        }
      }
      nodes.push(...node.children);
    }
  }

  surfaces(): Body[] {
    return [...this.bodies.values()].filter((body) => body.info.kind === 'surface');
  }
}

// What moved by less than it is rounded to stands still.
function rates(before: Float32Array, now: Float32Array, past: number, step: number): Float32Array {
  const out = new Float32Array(now.length);
  if (before.length !== now.length) return out;
  for (let i = 0; i < now.length; i++) {
    const way = now[i]! - before[i]!;
    out[i] = Math.abs(way) > step ? way / past : 0;
  }
  return out;
}

function stepOf({ low, high }: ArrayHeader): number {
  if (!low || !high) return 0;
  return Math.max(...high.map((x, k) => x - low[k]!)) / 65535;
}

// Volume (m³) that a closed surface encloses, with the sign of its orientation.
export function enclosedVolume(position: Float32Array, triangles: Uint32Array): number {
  let six = 0;
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const a = 3 * triangles[t]!;
    const b = 3 * triangles[t + 1]!;
    const c = 3 * triangles[t + 2]!;
    six +=
      position[a]! * (position[b + 1]! * position[c + 2]! - position[b + 2]! * position[c + 1]!) +
      position[a + 1]! * (position[b + 2]! * position[c]! - position[b]! * position[c + 2]!) +
      position[a + 2]! * (position[b]! * position[c + 1]! - position[b + 1]! * position[c]!);
  }
  return six / 6;
}
