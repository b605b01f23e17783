import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { coefficientCount, probeRadiance, readSphl, shEvaluate, SsphhError, tangentsOf } from 'ssphh';
import { xxh3 } from '../dist/sphl/xxh3.js';
import { bytesOf, made, probeFile, randomNumbers, run } from './fixtures.js';

// Of bytes (7 i + 3 ⌊i / 256⌋ + 1) mod 256, by Debian's libxxhash 0.8.1, XXH3_128bits
const hashes = [
  [17, 'f889d91b7faf208294ad051aea796d7e'],
  [32, '2cb559bb64d293e9369cab951c511911'],
  [33, '60f5a4577ba82b1c2ef00541392ecc50'],
  [64, '49b043631b5d4d5192fd891d246fb531'],
  [65, '28457563c6ecae375b07dd3aa17b0b34'],
  [96, '1939f2a73ddc43eca88b752cfafc28c3'],
  [97, '0dd98837fd4f559e4d36251a2e320331'],
  [128, '776e5a2cae08df3bd480e3bdeadbf37f'],
  [129, 'b550da2f042256556a4dda91524c13ef'],
  [160, '1cbbc2b4950bdb766cc4a404001acef7'],
  [191, 'a1854858e576907e5d7ec1576fdd62ee'],
  [192, '7ce98c3c61647895c28bbf4d30a06ff3'],
  [240, '3f558c88fda1da664f23bfd3609734e8'],
  [241, '9ea4272027cb71fcbff7215089202d8f'],
  [256, '64c166f4724707e6c03402b5dce3dbfa'],
  [1024, 'c37a7d672270f5711c8707d3200b2979'],
  [1025, '558d3c3c0e9010f58b2da3b19c614746'],
  [1087, 'd52c5776fc39a140639909666535ee5c'],
  [1088, '335140d511ba294b6d8896c0e17de43d'],
  [1089, '6aba4fa9194389a62b5af1d768448e40'],
  [2048, 'ecb15fd863763a87f269523bf535b7f0'],
  [4097, '9d583e8f3a5921e9af7dac1a73c907c1'],
  [5000, '1c8041b90c2c62c9da8e88204ab65635'],
];

test('XXH3 of 128 bits', () => {
  const bytes = Uint8Array.from({ length: 5001 }, (_, i) => 7 * i + 3 * (i >> 8) + 1), shifted = new Uint8Array(5004);
  shifted.set(bytes, 3);
  for (const [length, expected] of hashes) {
    for (const from of [bytes, shifted.subarray(3)])
      assert.equal(xxh3(from.subarray(0, length)).map(half => half.toString(16).padStart(16, '0')).join(''), expected, `${length} bytes`);
  }
});

/** A small file with everything that there can be: hierarchy, matrices, records, direct light, emitted light, fitted points, a baseline. */
const everything = () => made('everything.sphl', path => {
  run('bake', 'builtin:two-rooms', '-o', path, '--operator', 'path', '--gen', 'local', '--passes', '1', '--spp', '4', '--viz', 'path', '--viz-transfer',
    '--viz-passes', '1', '--viz-spp', '1', '--probes', '6', '--degree', '2', '--records', '50', '--fit', '--surfel-size', '1', '--quality', 'draft', '--light-mode', 'lamp=baked');
  run('hier', path, '-o', path);
});
const asJson = from => made(from.replace(/.*\//, '') + '.json', path => run('probe', 'convert', from, '-o', path));

function expectNear(binary, json, path = 'set') {
  if (typeof binary === 'number') return assert(Math.abs(binary - json) <= 1e-4 * Math.abs(binary) + 1e-30, `${path}: ${binary} ${json}`);
  if (binary === null || typeof binary !== 'object') return assert.equal(json, binary, path);
  assert.deepEqual(Object.keys(json), Object.keys(binary), path);
  for (const key of Object.keys(binary)) expectNear(binary[key], json[key], `${path}.${key}`);
}

test('binary and JSON hold the same', () => {
  for (const path of [everything(), probeFile('cornell', 'weights'), probeFile('random?seed=7', 'points')]) {
    const set = readSphl(bytesOf(path));
    // Records in JSON are whole numbers times a scale; the binary file's scale has more digits
    expectNear(set, readSphl(bytesOf(asJson(path))));
  }
});

test('the file with everything', () => {
  const set = readSphl(bytesOf(everything()));
  assert.equal(set.degree, 2);
  assert.equal(set.generator.scene, 'two-rooms');
  assert.equal(set.generator.operator, 'path');
  assert.match(set.generator.sceneHash, /^[0-9a-f]{32}$/);
  assert.equal(set.probes.length, 6);
  assert.deepEqual(set.probes.map(p => p.name).sort()[0], 'A east');
  assert.deepEqual(set.lightGroups, [{ name: 'lamp', scale: [1, 1, 1], mode: 'baked' }]);
  assert(set.hierarchy && set.fitted.length > 100 && set.surface.count > 10 && set.surface.groups[0].direct && set.hasBaseline);
  assert(set.probes.every(p => p.neighbor.length === 27 && p.groups[0].reflected.length === 27));
  assert(set.probes.some(p => p.groups[0].emitted?.some(v => v !== 0)));
  const edges = set.probes.flatMap(p => p.edges);
  assert(edges.length > 2 && edges.every(e => e.h.length === 27 && e.matrix.length === 243));
  for (const point of set.fitted.slice(0, 100)) assert.equal(point.probes.length, point.weights.length);
  for (let i = 0; i < set.surface.count; ++i) {
    const n = set.surface.normals.subarray(3 * i, 3 * i + 3), { x, y } = tangentsOf(n), dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (const [a, b, expected] of [[x, x, 1], [y, y, 1], [x, y, 0], [x, n, 0], [y, n, 0]]) assert(Math.abs(dot(a, b) - expected) < 1e-5);
  }
});

test('what a probe sees: the numbers of the CSV export', () => {
  for (const [scene, kind] of [['cornell', 'points'], ['random?seed=7', 'points']]) {
    const path = probeFile(scene, kind), set = readSphl(bytesOf(path)), reach = [...'xyz'].length + 2;
    for (const [part, options] of [['reflected', []], ['all', ['--emitted']]]) {
      const csv = made(`${scene.replace(/\W+/g, '-')}-${part}.csv`, out => run('probe', 'export', path, '--scene', `builtin:${scene}`, '--to', 'csv', '-o', out.slice(0, -4), ...options));
      const lines = readFileSync(csv, 'utf8').trim().split('\n').slice(1);
      assert.equal(lines.length, set.probes.length);
      let light = 0;
      lines.forEach((line, i) => {
        const numbers = line.split(',').map(Number).slice(-3 * coefficientCount(set.degree)), ours = probeRadiance(set, i, part);
        assert(line.split(',').length === reach + numbers.length);
        const most = Math.max(...ours.map(Math.abs));
        light += most;
        numbers.forEach((v, k) => assert(Math.abs(v - ours[k]) <= 2e-5 * most, `${scene} ${part} probe ${i}, ${k}: ${v} ${ours[k]}`));
      });
      assert(light > 0);
    }
  }
});

test('packed light is what the tool makes of it', () => {
  const finer = () => probeFile('cornell', 'weights');
  for (const [packing, degree, of] of [['half', 2, everything], ['rgb9e5', 2, everything], ['zh3', 2, everything], ['bc6h', 2, everything], ['bc6h', 4, finer]]) {
    const name = `${of.name}-${packing}`;
    const path = made(`${name}.sphl`, out => run('probe', 'convert', of(), '-o', out, '--pack', packing, '--degree', degree));
    // The tool's own reader, and its text of five digits
    const plain = made(`${name}.sphl.json`, out => run('probe', 'convert', path, '-o', out));
    const set = readSphl(bytesOf(path)), expected = readSphl(bytesOf(plain));
    assert(set.probes.every(p => p.edges.length === 0) && !set.hasBaseline && (of === finer || set.hierarchy));
    set.probes.forEach((probe, i) => {
      const other = expected.probes[i];
      for (const [ours, theirs] of [[probe.neighbor, other.neighbor], ...probe.groups.flatMap((g, k) => [[g.emitted, other.groups[k].emitted], [g.reflected, other.groups[k].reflected]])]) {
        assert.equal(ours?.length, theirs?.length);
        const most = Math.max(...(theirs ?? []).map(Math.abs));
        ours?.forEach((v, k) => assert(Math.abs(v - theirs[k]) <= 1e-4 * Math.abs(theirs[k]) + 1e-6 * most, `${packing}, probe ${i}, ${k}: ${v} ${theirs[k]}`));
      }
    });
    const seen = codesOfChanged(new Uint8Array(bytesOf(path)), 1000, 200, 9);
    assert(seen.ok > 30 && seen.invalid > 30, JSON.stringify(seen));
  }
});

test('scales, and parts that add up', () => {
  const set = readSphl(bytesOf(probeFile('random?seed=7', 'points'))), scales = set.lightGroups.map(() => [0, 2, 1]);
  const [all, reflected, emitted] = ['all', 'reflected', 'emitted'].map(part => probeRadiance(set, 2, part));
  all.forEach((v, i) => assert(Math.abs(v - reflected[i] - emitted[i]) <= 1e-5 * Math.abs(v) + 1e-9));
  const scaled = probeRadiance(set, 2, 'all', scales), seen = shEvaluate(scaled, [0, 1, 0]);
  assert.equal(seen[0], 0);
  assert(scaled.some(v => v > 0));
  assert.throws(() => probeRadiance(set, 99), { code: 'bad-argument' });
  assert.throws(() => probeRadiance(set, 0, 'all', []), set.lightGroups.length ? { code: 'bad-argument' } : undefined);
});

function codeOf(bytes) {
  try {
    readSphl(bytes);
    return 'ok';
  } catch (error) {
    assert(error instanceof SsphhError, String(error.stack));
    return error.code;
  }
}

/** How often a file is read or refused with one byte of its payload changed and its hash made anew: the first `begin` bytes, then any. */
function codesOfChanged(whole, count, begin, seed) {
  const view = new DataView(whole.buffer), random = randomNumbers(seed), seen = {};
  for (let i = 0; i < count; ++i) {
    const at = 36 + (i < begin ? i : Math.floor(random() * (whole.length - 36))), was = whole[at];
    whole[at] = i % 2 ? 0xff : was ^ (1 << Math.floor(8 * random()));
    xxh3(whole.subarray(36)).forEach((half, k) => view.setBigUint64(20 + 8 * k, half, true));
    const code = codeOf(whole);
    assert(code === 'ok' || code === 'invalid', `byte ${at}: ${code}`);
    seen[code] = (seen[code] ?? 0) + 1;
    whole[at] = was;
  }
  return seen;
}

test('hostile binary files', () => {
  const whole = new Uint8Array(bytesOf(everything()));
  assert.equal(codeOf(whole.slice(0, 100)), 'cut-off');
  assert.equal(codeOf(whole.slice(0, 10)), 'cut-off');
  assert.equal(codeOf(new Uint8Array(0)), 'not-sphl');
  assert.equal(codeOf(Uint8Array.of(1, 2, 3, 4, 5, 6, 7, 8, 9)), 'not-sphl');
  whole[5000] ^= 1;
  assert.equal(codeOf(whole), 'damaged');
  whole[5000] ^= 1;
  whole[8] = 6;
  assert.equal(codeOf(whole), 'bad-version');
  whole[8] = 7;
  const seen = codesOfChanged(whole, 3000, 400, 5);
  assert(seen.ok > 100 && seen.invalid > 100, JSON.stringify(seen));
});

test('a count that the file cannot hold is refused before memory is taken', () => {
  const whole = new Uint8Array(bytesOf(everything())), view = new DataView(whole.buffer), { generator, lightGroups } = readSphl(whole);
  const groups = 36 + 4 + 77 + generator.scene.length, probes = groups + 4 + 17 + lightGroups[0].name.length;
  assert.deepEqual([view.getUint32(groups, true), view.getUint32(probes, true)], [1, 6]);
  view.setUint32(probes, 65536, true);
  xxh3(whole.subarray(36)).forEach((half, k) => view.setBigUint64(20 + 8 * k, half, true));
  assert.throws(() => readSphl(whole), { code: 'invalid', message: /probe count of 65536 needs more bytes/ });
});

test('hostile JSON files', () => {
  const document = JSON.parse(readFileSync(asJson(everything()), 'utf8')), encode = v => new TextEncoder().encode(typeof v === 'string' ? v : JSON.stringify(v));
  const changed = change => {
    const copy = structuredClone(document);
    change(copy);
    return codeOf(encode(copy));
  };
  assert.equal(changed(() => {}), 'ok');
  assert.equal(codeOf(encode('{"format": ')), 'not-sphl');
  assert.equal(codeOf(encode('{}')), 'not-sphl');
  assert.equal(changed(d => (d.version = 8)), 'bad-version');
  const wrong = [
    d => delete d.degree, d => (d.degree = 11), d => (d.degree = 3), d => (d.more = 1), d => (d.generator.operator = 'x'), d => (d.generator.passes = 0.5),
    d => (d.probes[0].radius = 0), d => (d.probes[1].position = [0, 1]), d => (d.probes[0].position[0] = 1e10), d => (d.probes[0].name = 'n'.repeat(1025)),
    d => (d.probes[0].groups = []), d => d.probes[2].groups[0].reflected.pop(), d => (d.probes[2].groups[0].reflected[1] = 'x'), d => (d.probes = 3),
    d => (d.light_groups[0].scale = [1, -1, 1]), d => (d.light_groups[0].mode = 'off'), d => (d.surface[0].normal = [1, 1, 0]), d => (d.fitted.find(p => p.probes.length > 1).weights = [0.5]),
    d => (d.fitted[0].probes = [6]), d => (d.surface[0].groups[0][1] = 40000), d => (d.probes.find(p => p.edges.length).edges[0].from = 77), d => delete d.hierarchy,
    d => d.probes.find(p => p.edges.length).edges.push(structuredClone(d.probes.find(p => p.edges.length).edges.at(-1))),
  ];
  wrong.forEach((change, i) => assert.equal(changed(change), 'invalid', `change ${i}: ${change}`));
});
