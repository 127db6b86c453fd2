// SPDX-License-Identifier: Apache-2.0
import type { Connection } from './connection';
import type { Model } from './model';
import type { Request } from './protocol';
import type { ViewSettings } from './settings';
import type { ToolChoice } from './touch/choice';
import type { Stage } from './view/stage';
import type { World } from './view/world';

// What the panels work with.
export interface App {
  connection: Connection;
  model: Model;
  settings: ViewSettings;
  world: World;
  stage: Stage;
  choice: ToolChoice;
  // A short message that goes away by itself.
  tell(text: string): void;
}

// Sends a request; a refusal is told.
export async function request(app: App, what: Request): Promise<boolean> {
  const answer = await app.connection.ask(what);
  if (!answer.done) app.tell(answer.text ?? `'${what.type}' was refused.`);
  return answer.done;
}
