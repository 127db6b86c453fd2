// SPDX-License-Identifier: Apache-2.0
import type { Connection } from '../connection';
import { Emitter } from '../events';
import type { Model } from '../model';
import type { ToolInfo } from '../protocol';
import { kindOf, reachOf, type ToolKind } from '../tool_kind';

// Which tool the mouse has, if any, and how deep it goes.
export class ToolChoice extends Emitter<{ changed: void; depth: number; refused: string }> {
  private path: string | null = null;
  private wanted: { path?: string; kind?: ToolKind } | null = null;
  private readonly depths = new Map<ToolKind, number>();
  private size = 1;

  constructor(
    private readonly model: Model,
    private readonly connection: Connection,
  ) {
    super();
    model.on('scene', () => this.sceneChanged());
  }

  get tool(): ToolInfo | null {
    return this.model.scene?.tools.find((tool) => tool.path === this.path && tool.mouse) ?? null;
  }

  // Grips, then probes, then what cuts.
  get tools(): ToolInfo[] {
    const ranks: Partial<Record<ToolKind, number>> = { grip: 0, probe: 1 };
    const order = (tool: ToolInfo): number => ranks[kindOf(tool)] ?? 2;
    return [...(this.model.scene?.tools ?? [])].sort((a, b) => order(a) - order(b));
  }

  orbit(): void {
    this.path = this.wanted = null;
    this.emit('changed', undefined);
  }

  // Chooses a tool; one that something else moves is taken first.
  async choose(tool: ToolInfo): Promise<void> {
    this.wanted = null;
    if (!tool.mouse) {
      this.wanted = { path: tool.path };
      return this.askFor({ type: 'take', tool: tool.path });
    }
    this.path = tool.path;
    this.emit('changed', undefined);
    this.emit('depth', this.depth);
  }

  // A pull or a probe, added to the scene where it has none.
  async equip(kind: 'pull' | 'probe'): Promise<void> {
    const surface = this.model.surfaces()[0]?.info.path ?? '';
    this.wanted = { kind: kind === 'pull' ? 'grip' : 'probe' };
    return this.askFor({ type: 'equip', tool: kind, surface });
  }

  private async askFor(request: { type: string; [member: string]: unknown }): Promise<void> {
    const answer = await this.connection.ask(request);
    if (answer.done) return;
    this.wanted = null;
    this.emit('refused', answer.text ?? 'The tool cannot be had.');
  }

  get mostDepth(): number {
    const tool = this.tool;
    if (!tool) return 0.1 * this.size;
    const reach = reachOf(tool);
    return kindOf(tool) === 'probe' ? 0.15 * this.size : Math.min(0.25 * this.size, 1.2 * reach);
  }

  get depth(): number {
    const kind = this.tool ? kindOf(this.tool) : 'probe';
    const usual = (kind === 'probe' ? 0.04 : 0.03) * this.size;
    return Math.min(this.depths.get(kind) ?? usual, this.mostDepth);
  }

  setDepth(depth: number): void {
    if (!this.tool) return;
    this.depths.set(kindOf(this.tool), Math.min(this.mostDepth, Math.max(0, depth)));
    this.emit('depth', this.depth);
  }

  private sceneChanged(): void {
    const [ax, ay, az, bx, by, bz] = this.model.scene!.bounds;
    const size = Math.hypot(bx - ax, by - ay, bz - az) || 1;
    if (Math.abs(size / this.size - 1) > 0.5) this.depths.clear();
    this.size = size;
    const wanted = this.wanted;
    const found =
      wanted &&
      this.tools.find(
        (tool) => tool.mouse && (tool.path === wanted.path || kindOf(tool) === wanted.kind),
      );
    if (found) {
      this.path = found.path;
      this.wanted = null;
    }
    this.emit('changed', undefined);
    this.emit('depth', this.depth);
  }
}
