// SPDX-License-Identifier: Apache-2.0
import type { App } from './app';

export function download(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export function baseName(app: App): string {
  const file = app.model.scene?.file.split('/').pop() ?? 'stroma';
  const time = app.model.frame ? `-${app.model.frame.time.toFixed(3)}s` : '';
  return file.replace(/\.xml$/, '') + time;
}

export function keepPicture(app: App): void {
  app.world.drawNow();
  app.world.canvas.toBlob((blob) => {
    if (blob) download(blob, `${baseName(app)}.png`);
  });
}

// Records the canvas as WebM from one call to the next.
export class VideoRecorder {
  private recorder: MediaRecorder | null = null;

  constructor(private readonly app: App) {}

  // Begins or ends; true while it records.
  toggle(): boolean {
    if (this.recorder) {
      this.recorder.stop();
      this.recorder = null;
      return false;
    }
    const type = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'].find((one) =>
      MediaRecorder.isTypeSupported(one),
    );
    if (!type) {
      this.app.tell('This browser records no WebM.');
      return false;
    }
    const parts: Blob[] = [];
    const recorder = new MediaRecorder(this.app.world.canvas.captureStream(30), {
      mimeType: type,
      videoBitsPerSecond: 8_000_000,
    });
    recorder.ondataavailable = (event) => parts.push(event.data);
    recorder.onstop = () =>
      download(new Blob(parts, { type: 'video/webm' }), `${baseName(this.app)}.webm`);
    recorder.start(1000);
    this.recorder = recorder;
    this.app.world.draw();
    return true;
  }
}

export async function saveText(app: App, what: 'scene' | 'recording'): Promise<void> {
  const answer = await app.connection.ask({ type: 'save', what });
  if (!answer.done) return app.tell(answer.text ?? 'There is nothing to save.');
  for (const { name, text } of answer.files ?? []) {
    const type = name.endsWith('.xml') ? 'application/xml' : 'text/plain';
    download(new Blob([text], { type }), name);
  }
}
