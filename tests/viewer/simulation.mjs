// SPDX-License-Identifier: Apache-2.0
// Starts `stroma view` on a scene and tells its address.
import { spawn } from 'node:child_process';
import { once } from 'node:events';

const patience = 60_000; // ms until the address must be there

export async function startSimulation(stroma, scene, options = []) {
  const child = spawn(stroma, ['view', scene, '--port', '0', ...options], {
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  let output = '';
  const address = await new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(`no address came:\n${output}`)), patience);
    const read = (data) => {
      output += data;
      const found = /https?:\/\/\S+token=\S+/.exec(output);
      if (!found) return;
      clearTimeout(timer);
      resolve(found[0]);
    };
    child.stdout.on('data', read);
    child.stderr.on('data', read);
    child.on('exit', (code) => {
      clearTimeout(timer);
      reject(new Error(`it ended with ${code}:\n${output}`));
    });
  });
  return {
    address,
    output: () => output,
    get running() {
      return child.exitCode === null && child.signalCode === null;
    },
    async stop() {
      if (child.exitCode !== null || child.signalCode !== null) return;
      child.kill('SIGINT');
      const timer = setTimeout(() => child.kill('SIGKILL'), 10_000);
      await once(child, 'exit');
      clearTimeout(timer);
    },
  };
}
