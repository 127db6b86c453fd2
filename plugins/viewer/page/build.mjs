// SPDX-License-Identifier: Apache-2.0
// Bundles the page into dist/: a few files that need nothing else, on the net or off it.
import { build } from 'esbuild';
import { copyFile, mkdir, rm } from 'node:fs/promises';

const to = new URL('dist/', import.meta.url);
await rm(to, { recursive: true, force: true });
await mkdir(to, { recursive: true });
await build({
  absWorkingDir: new URL('.', import.meta.url).pathname,
  entryPoints: { app: 'src/main.ts' },
  outdir: 'dist',
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15.4'],
  legalComments: 'none',
  logLevel: 'warning',
});
for (const file of ['index.html', 'icon.svg', 'THIRD_PARTY.txt']) {
  await copyFile(new URL(`src/static/${file}`, import.meta.url), new URL(file, to));
}
