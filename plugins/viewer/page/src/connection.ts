// SPDX-License-Identifier: Apache-2.0
import { decodeMessage, type BinaryMessage } from './decode';
import { Emitter } from './events';
import type { Answer, Request, ServerMessage } from './protocol';

interface ConnectionEvents {
  open: void;
  closed: { retryIn: number; everOpen: boolean };
  message: Exclude<ServerMessage, Answer>;
  binary: BinaryMessage;
  error: string;
}

const firstRetry = 500;
const longestRetry = 8000;

// The socket to the viewer: requests with their answers, and a new try when it goes away.
export class Connection extends Emitter<ConnectionEvents> {
  private socket: WebSocket | null = null;
  private lastNumber = 0;
  private waiting = new Map<number, (answer: Answer) => void>();
  private retry = firstRetry;
  private everOpen = false;
  isOpen = false;

  constructor(private readonly address: string) {
    super();
  }

  open(): void {
    const socket = new WebSocket(this.address);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => {
      this.isOpen = this.everOpen = true;
      this.retry = firstRetry;
      this.emit('open', undefined);
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.take(event.data);
    socket.onclose = () => this.lost();
  }

  // Sends without waiting for an answer. What is sent while there is no connection is lost.
  send(request: Request): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }

  ask(request: Request): Promise<Answer> {
    if (!this.isOpen) {
      return Promise.resolve({
        type: 'answer',
        n: 0,
        done: false,
        text: 'There is no connection.',
      });
    }
    const n = ++this.lastNumber;
    return new Promise((resolve) => {
      this.waiting.set(n, resolve);
      this.send({ ...request, n });
    });
  }

  private take(data: string | ArrayBuffer): void {
    try {
      if (typeof data !== 'string') {
        this.emit('binary', decodeMessage(data));
        return;
      }
      const message = JSON.parse(data) as ServerMessage;
      if (message.type === 'answer') {
        this.waiting.get(message.n)?.(message);
        this.waiting.delete(message.n);
      } else {
        this.emit('message', message);
      }
    } catch (problem) {
      this.emit('error', String(problem));
    }
  }

  private lost(): void {
    this.isOpen = false;
    for (const [n, resolve] of this.waiting) {
      resolve({ type: 'answer', n, done: false, text: 'The connection was lost.' });
    }
    this.waiting.clear();
    this.emit('closed', { retryIn: this.retry, everOpen: this.everOpen });
    setTimeout(() => this.open(), this.retry);
    this.retry = Math.min(longestRetry, this.retry * 1.6);
  }
}
