// SPDX-License-Identifier: Apache-2.0
import type { Connection } from '../connection';
import type { ToolPose } from './poses';

const interval = 1000 / 60;

interface Pending {
  tool: string;
  pose: ToolPose;
  buttons: number;
}

// Poses on their way to the device: key poses at once and in order, those of a movement at most 60
// times a second, of which the newest counts.
export class PoseSender {
  private pending: Pending | null = null;
  private timer: number | undefined;
  private last = 0;
  sent = 0;

  constructor(private readonly connection: Connection) {}

  key(tool: string, pose: ToolPose, buttons: number, jump = false): void {
    this.flush();
    this.send({ tool, pose, buttons }, jump);
  }

  move(tool: string, pose: ToolPose, buttons: number): void {
    this.pending = { tool, pose, buttons };
    const wait = this.last + interval - performance.now();
    if (wait <= 0) this.flush();
    else this.timer ??= window.setTimeout(() => this.flush(), wait);
  }

  flush(): void {
    window.clearTimeout(this.timer);
    this.timer = undefined;
    if (!this.pending) return;
    this.send(this.pending, false);
    this.pending = null;
  }

  private send({ tool, pose, buttons }: Pending, jump: boolean): void {
    this.last = performance.now();
    this.sent++;
    this.connection.send({
      type: 'pose',
      tool,
      p: pose.p.toArray(),
      q: pose.q.toArray(),
      buttons,
      ...(jump && { jump }),
    });
  }
}
