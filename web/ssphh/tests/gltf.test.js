import assert from 'node:assert/strict';
import { test } from 'node:test';
import { writeFileSync } from 'node:fs';
import { readGltfExtras, readSphl, shEvaluate } from 'ssphh';
import { bytesOf, made, probeFile, run } from './fixtures.js';

const glb = (name, scene) => bytesOf(made(name, path => run('export', scene, '--to', 'gltf', '-o', path)));
const encode = value => new TextEncoder().encode(JSON.stringify(value));

test('SPHLs of an exported scene stand where the bake had them', () => {
  const set = readSphl(bytesOf(probeFile('two-rooms', 'points'))), { sphls, lightmap } = readGltfExtras(glb('two-rooms.glb', 'builtin:two-rooms'));
  assert.equal(sphls.length, 6);
  assert.equal(lightmap, null);
  for (const sphl of sphls) {
    const probe = set.probes.find(({ name }) => name === sphl.name);
    assert(probe && sphl.enabled && sphl.emission === null, sphl.name);
    sphl.position.forEach((v, c) => assert(Math.abs(v - probe.position[c]) < 1e-5));
  }
});

test('an SPHL that shines, light modes', () => {
  const overlay = made('torch.ssphh.json', path => writeFileSync(path, JSON.stringify({
    scene: 'builtin:cornell', light_modes: { lamp: 'mixed' },
    sphls: [{ name: 'torch', position: [0, 0.25, 0.5], radius: 0.2, emission: { lobe: 'cosine', color: [1, 0.5, 0.25], intensity: 20 } }],
  })));
  const { sphls, lightModes } = readGltfExtras(glb('torch.glb', overlay)), torch = sphls.find(({ name }) => name === 'torch');
  assert(torch?.emission, JSON.stringify(sphls));
  torch.position.forEach((v, c) => assert(Math.abs(v - [0, 0.25, 0.5][c]) < 1e-6));
  assert(Math.abs(torch.radius - 0.2) < 1e-6);
  assert.equal(torch.emission.lightGroup, 'torch');
  assert.equal(torch.emission.frames.length, 1);
  const ahead = shEvaluate(torch.emission.frames[0], [0, 0, -1]).map((v, c) => v * torch.emission.intensity * torch.emission.color[c]);
  [20, 10, 5].forEach((v, c) => assert(Math.abs(ahead[c] - v) < 0.05 * v, `${ahead}`));
  assert.equal(lightModes.lamp, 'mixed');
});

test('transforms of parents', () => {
  const turned = { rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2], translation: [1, 0, 0], scale: [2, 2, 2], children: [1] };
  const { sphls } = readGltfExtras(encode({
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0], extras: { ssphh: { light_modes: { sky: 'baked' } } } }],
    nodes: [turned, { name: 'SPHL a', translation: [0, 1, 3], extras: {} }],
  }));
  assert.equal(sphls.length, 1);
  [7, 2, 0].forEach((v, c) => assert(Math.abs(sphls[0].position[c] - v) < 1e-6, `${sphls[0].position}`)); // a quarter about y: +z becomes +x
});

test('what is none, or wrong', () => {
  const file = nodes => encode({ asset: { version: '2.0' }, scenes: [{ nodes: [0] }], nodes });
  for (const bytes of [new Uint8Array(0), encode([]), encode({}), new Uint8Array(glb('two-rooms.glb', 'builtin:two-rooms')).slice(0, 50)])
    assert.throws(() => readGltfExtras(bytes), { code: 'not-gltf' });
  const wrong = [
    [{ extras: { sphl: { radius: -1 } } }], [{ children: [0] }], [{ children: [1, 1] }, {}], [{ children: [5] }], [{ children: ['x'] }], [{ translation: [0, 1] }],
    [{ extras: { sphl: { emission: { coefficients: [1, 2] } } } }], [{ extras: { sphl: { emission: { frames: 3 } } } }],
  ];
  for (const nodes of wrong) assert.throws(() => readGltfExtras(file(nodes)), { code: 'invalid' }, JSON.stringify(nodes));
  assert.deepEqual(readGltfExtras(file([{ name: 'SPHL', extras: { sphl: false } }])).sphls, []);
});
