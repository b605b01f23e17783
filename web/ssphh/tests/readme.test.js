// The README's code runs as it stands, on files of the tool in place of its names.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import * as ssphh from 'ssphh';
import { bytesOf, cookedFile, made, probeFile, run } from './fixtures.js';

const blocks = [...readFileSync(new URL('../README.md', import.meta.url), 'utf8').matchAll(/```js\n(.*?)```/gs)].map(([, code]) => code);
const files = {
  'room.sphlc': () => bytesOf(cookedFile('cornell', 'points')),
  'room.sphl': () => bytesOf(probeFile('cornell', 'points')),
  'room.glb': () => bytesOf(made('two-rooms.glb', path => run('export', 'builtin:two-rooms', '--to', 'gltf', '-o', path))),
};

for (const code of blocks.filter(block => !block.includes('ssphh/three'))) {
  test(`README: ${code.match(/import {(.*)}/)[1].trim()}`, async () => {
    const [, names] = code.match(/import {(.*)} from 'ssphh';/);
    const given = {
      fetch: async name => new Response(files[name]()), readFile: async name => files[name](), positions: Float32Array.of(0, 1, 2), normals: Float32Array.of(0, 1, 0),
      out: new Float32Array(3), eveningBytes: files['room.sphlc'](), ssphh,
    };
    const body = `const {${names}} = ssphh;\n${code.replace(/import .*\n/g, '')}\nreturn true;`;
    const program = new (async () => {}).constructor(...Object.keys(given), body);
    assert.equal(await program(...Object.values(given)), true);
  });
}

test('README: there was code to run, and every name that it lists is exported', () => {
  assert.equal(blocks.length, 4);
  for (const name of ['shBasis', 'shEvaluate', 'irradianceFromRadiance', 'shIrradiance', 'cosineFactor', 'SsphhError']) assert(name in ssphh, name);
});
