// SPDX-License-Identifier: Apache-2.0
// Bundles the tests beside this file and runs them with node's own runner.
import { build } from 'esbuild';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const here = new URL('.', import.meta.url).pathname;
const to = mkdtempSync(join(tmpdir(), 'stroma-page-test-'));
const tests = readdirSync(here).filter((file) => file.endsWith('.test.ts'));
await build({
  entryPoints: tests.map((file) => join(here, file)),
  outdir: to,
  bundle: true,
  platform: 'node',
  format: 'esm',
  outExtension: { '.js': '.mjs' },
  logLevel: 'warning',
});
const files = tests.map((file) => join(to, file.replace(/\.ts$/, '.mjs')));
const { status } = spawnSync(process.execPath, ['--test', ...files], { stdio: 'inherit' });
rmSync(to, { recursive: true });
process.exit(status ?? 1);
