// SPDX-License-Identifier: Apache-2.0
// The messages between viewer and page, as protocol.md has them. All numbers are SI.

export type Vec3 = [number, number, number];
export type Quat = [number, number, number, number];

export interface Attribute {
  name: string;
  type: string;
  unit?: string;
  doc?: string;
  value: string;
  default?: string;
  isSet?: boolean;
  runtime?: boolean;
  output?: boolean;
  required?: boolean;
  min?: number;
  max?: number;
  exclusiveMin?: boolean;
  exclusiveMax?: boolean;
  choices?: string[];
  long?: boolean;
}

export interface ComponentInfo {
  name: string;
  path: string;
  type: string;
  role?: string;
  doc?: string;
  file?: string;
  line?: number;
  attributes: Attribute[];
  swappable?: boolean;
}

export interface NodeInfo {
  name: string;
  path: string;
  attributes: Attribute[];
  components: ComponentInfo[];
  children: NodeInfo[];
}

export interface FieldInfo {
  name: string;
  unit?: string;
}

export interface BodyInfo {
  id: number;
  kind: 'surface' | 'particles';
  path: string;
  name: string;
  fields: FieldInfo[];
  particles?: number;
}

export interface ToolInfo {
  path: string;
  type: string;
  device: string;
  mouse: boolean;
  radius: number;
  edge: Vec3[];
  samples: Vec3[];
}

export interface Hello {
  type: 'hello';
  version: number;
  program: string;
  client: number;
  steers: boolean;
}

export interface SceneInfo {
  type: 'scene';
  generation: number;
  file: string;
  dt: number;
  duration: number;
  bounds: [number, number, number, number, number, number];
  root: NodeInfo;
  bodies: BodyInfo[];
  tools: ToolInfo[];
  changes: string[];
}

export interface StageTime {
  name: string;
  ms: number;
  calls: { component: string; label: string; ms: number; p99: number }[];
}

export interface Status {
  type: 'status';
  generation: number;
  playing: boolean;
  speed: number;
  realTimeFactor: number;
  stepTime: number;
  time: number;
  step: number;
  kept: number[];
  stopped: string;
  steers: boolean;
  watchers: number;
  values: Record<string, number>;
  stages?: StageTime[];
  haptics?: Record<string, number | Record<string, number>>;
  kinetic?: number;
  potential?: number;
  limiters?: Record<string, number>;
  frameCost?: number;
}

export interface Diagnostic {
  severity: string;
  id?: string;
  message: string;
  file?: string;
  line?: number;
  column?: number;
  excerpt?: string;
  hint?: string;
}

export interface Diagnostics {
  type: 'diagnostics';
  items: Diagnostic[];
  broken: boolean;
}

export interface AttributeValues {
  type: 'attributes';
  values: Record<string, string>;
}

export interface Answer {
  type: 'answer';
  n: number;
  done: boolean;
  text?: string;
  ids?: number[];
  types?: string[];
  files?: { name: string; text: string }[];
}

export type ServerMessage = Hello | SceneInfo | Status | Diagnostics | AttributeValues | Answer;

export interface Contact {
  p: Vec3;
  n: Vec3;
  force: Vec3;
  depth: number;
}

export interface ToolFrame {
  path: string;
  p: Vec3;
  q: Quat;
  active: boolean;
  force: Vec3;
  contacts: Contact[];
}

export interface Request {
  type: string;
  [member: string]: unknown;
}
