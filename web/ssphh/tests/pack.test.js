import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { cookedFile } from './fixtures.js';

const own = new URL('..', import.meta.url).pathname, fresh = new URL('../../fresh/', import.meta.url).pathname;
function inFresh(program, ...words) {
  const { status, stdout, stderr } = spawnSync(program, words, { cwd: fresh, encoding: 'utf8' });
  assert.equal(status, 0, stdout + stderr);
  return stdout;
}

test('what npm pack packs is installed and used in a fresh folder, in JavaScript and TypeScript', () => {
  rmSync(fresh, { recursive: true, force: true });
  mkdirSync(fresh);
  const [packed] = JSON.parse(execFileSync('npm', ['pack', '--ignore-scripts', '--json', '--pack-destination', fresh], { cwd: own, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  assert.equal(packed.filename, 'ssphh-0.1.0.tgz');
  const files = packed.files.map(({ path }) => path);
  for (const needed of ['README.md', 'LICENSE', 'package.json', 'dist/index.js', 'dist/index.d.ts', 'dist/three/index.js', 'dist/three/index.d.ts']) assert(files.includes(needed), needed);
  for (const file of files) assert.match(file, /^(README\.md|LICENSE|package\.json|dist\/.*\.(js|d\.ts))$/);
  assert(packed.size < 80_000, `${packed.size} bytes`);
  console.log(`packed: ${packed.size} bytes, unpacked ${packed.unpackedSize}, ${files.length} files`);

  writeFileSync(`${fresh}package.json`, '{"private": true, "type": "module"}');
  inFresh('npm', 'install', '--offline', '--no-audit', '--no-fund', './ssphh-0.1.0.tgz');
  const lock = JSON.parse(readFileSync(`${fresh}node_modules/.package-lock.json`, 'utf8'));
  assert.deepEqual(Object.keys(lock.packages), ['node_modules/ssphh']);
  const program = `import { readFile } from 'node:fs/promises';
import { openCooked, readSphl, SsphhError } from 'ssphh';
import type { applyProbeLight, LightChunk } from 'ssphh/three';
type Three = [typeof applyProbeLight, LightChunk['functions'], ReturnType<typeof readSphl>['probes']];
const light = await openCooked(await readFile(${JSON.stringify(cookedFile('cornell', 'points'))}));
const rgb: [number, number, number] = light.irradiance([0, 0, 0], [0, 1, 0], 'open');
light.setGroupScale(light.groups[0]!.name, [0, 0, 0]);
console.log(rgb.every(v => v > 0), light.irradiance([0, 0, 0], [0, 1, 0], 'open').every(v => v === 0));
await openCooked(new Uint8Array(9)).catch((error: SsphhError) => console.log(error.code));
export type { Three };
`;
  writeFileSync(`${fresh}use.ts`, program);
  writeFileSync(`${fresh}node.d.ts`, "declare module 'node:fs/promises' { export function readFile(path: string): Promise<Uint8Array>; }\n");
  inFresh(`${own}node_modules/.bin/tsc`, '--strict', '--noUncheckedIndexedAccess', '--target', 'es2022', '--module', 'nodenext', 'use.ts', 'node.d.ts');
  assert.equal(inFresh('node', 'use.js').trim(), 'true true\nnot-cooked');
});
