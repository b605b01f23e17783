import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openCooked, openCookedSync, SsphhError } from 'ssphh';
import { checksum } from '../dist/cooked/checksum.js';
import { bytesOf, cookedFile, randomNumbers, referenceVerdicts, somePlaces } from './fixtures.js';

function codeOf(bytes) {
  try {
    openCookedSync(bytes);
    return 'ok';
  } catch (error) {
    assert(error instanceof SsphhError, String(error.stack));
    assert(error.message.length > 20);
    return error.code;
  }
}

test('the checksum is the one that the file has', () => {
  const bytes = new Uint8Array(bytesOf(cookedFile('cornell', 'points')));
  const [low, high] = checksum(bytes), view = new DataView(bytes.buffer);
  assert.deepEqual([low, high], [view.getUint32(24, true), view.getUint32(28, true)]);
});

test('every byte of the header and groups changed, and bytes all over, with the checksum mended: the verdict of C', () => {
  const path = cookedFile('cornell', 'points'), whole = new Uint8Array(bytesOf(path)), view = new DataView(whole.buffer);
  const random = randomNumbers(7), changes = [];
  for (let offset = 0; offset < 640; ++offset)
    for (const flip of [1, 0x80, 0xff]) changes.push([offset, whole[offset] ^ flip]);
  const { sections } = openCookedSync(whole).file.header;
  for (const { offset, size } of Object.values(sections)) {
    for (let i = 0; size > 0 && i < 60; ++i) {
      const at = offset + Math.floor(random() * size);
      changes.push([at, i % 2 ? 0xff : whole[at] ^ (1 << Math.floor(8 * random()))]);
    }
  }
  for (let i = 0; i < 20; ++i) changes.push([sections.points.offset + 32 * i + 28, 20 + i], [sections.names.offset + i, 0]);
  const theirs = referenceVerdicts(path, changes), seen = new Map();
  assert.equal(theirs.length, changes.length);
  const sum = whole.slice(24, 32);
  changes.forEach(([offset, value], i) => {
    const was = whole[offset];
    whole[offset] = value;
    if (Math.floor(offset / 8) !== 3) checksum(whole).forEach((half, k) => view.setUint32(24 + 4 * k, half, true));
    const ours = codeOf(whole);
    assert.equal(ours, theirs[i], `byte ${offset} = ${value}`);
    seen.set(ours, (seen.get(ours) ?? 0) + 1);
    if (ours === 'ok' && i % 40 === 0) {
      const light = openCookedSync(whole), { positions, normals } = somePlaces(light, 50, i);
      assert(light.irradianceBatch(positions, normals).every(v => !(v < 0)));
    }
    whole[offset] = was;
    whole.set(sum, 24);
  });
  for (const code of ['ok', 'not-cooked', 'bad-version', 'cut-off', 'damaged', 'invalid']) assert(seen.get(code) >= 2, `${code}: ${[...seen]}`);
});

test('single bits without a mended checksum are damage, any length but its own is a cut', () => {
  const whole = new Uint8Array(bytesOf(cookedFile('cornell', 'points'))), random = randomNumbers(8);
  for (let i = 0; i < 100; ++i) {
    const at = 400 + Math.floor(random() * (whole.length - 400));
    whole[at] ^= 4;
    assert.equal(codeOf(whole), 'damaged');
    whole[at] ^= 4;
  }
  for (const length of [0, 5, 7]) assert.equal(codeOf(whole.slice(0, length)), 'not-cooked');
  for (const length of [8, 15, 16, 375, 376, 1000, whole.length - 64, whole.length - 1]) assert.equal(codeOf(whole.slice(0, length)), 'cut-off');
  const longer = new Uint8Array(whole.length + 64);
  longer.set(whole);
  assert.equal(codeOf(longer), 'cut-off');
  // As long as its header says, with the checksum of that, but nothing stands in the last bytes
  const view = new DataView(longer.buffer);
  view.setBigUint64(16, BigInt(longer.length), true);
  assert.equal(codeOf(longer), 'damaged');
  checksum(longer).forEach((half, k) => view.setUint32(24 + 4 * k, half, true));
  assert.equal(codeOf(longer), 'invalid');
});

test('bytes in the middle of a buffer, aligned or not, and sources that give them', async () => {
  const path = cookedFile('cornell', 'points'), bytes = bytesOf(path), whole = openCookedSync(bytes);
  const { positions, normals } = somePlaces(whole, 20, 1), expected = whole.irradianceBatch(positions, normals);
  assert.equal(whole.file.light.buffer, bytes);
  for (const begin of [8, 3]) {
    const larger = new Uint8Array(bytes.byteLength + 16);
    larger.set(new Uint8Array(bytes), begin);
    const light = openCookedSync(larger.subarray(begin, begin + bytes.byteLength));
    assert.equal(light.file.light.buffer === larger.buffer, begin === 8);
    assert.deepEqual(light.irradianceBatch(positions, normals), expected);
  }
  assert.deepEqual((await openCooked(new Blob([bytes]))).irradianceBatch(positions, normals), expected);
  assert.deepEqual((await openCooked(new Response(bytes))).irradianceBatch(positions, normals), expected);
  await assert.rejects(openCooked(new Response('none', { status: 404 })), { code: 'bad-file', message: /404/ });
  await assert.rejects(openCooked('room.sphlc'), { code: 'bad-argument' });
});

test('arguments', () => {
  const light = openCookedSync(bytesOf(cookedFile('cornell', 'points'))), bad = { code: 'bad-argument' };
  assert.throws(() => light.irradiance([0, NaN, 0], [0, 1, 0]), bad);
  assert.throws(() => light.irradiance([0, 0, 0], [0, 1]), bad);
  assert.throws(() => light.irradiance([0, 0, 1e300], [0, 1, 0]), bad);
  assert.throws(() => light.irradiance([0, 0, 0], [0, 1, 0], 'moving'), bad);
  assert.throws(() => light.irradianceBatch([0, 0], [0, 1]), bad);
  assert.throws(() => light.irradianceBatch([0, 0, 0], [0, 1, 0, 0, 0, 1]), bad);
  assert.throws(() => light.irradianceBatch([0, 0, 0], [0, 1, 0], new Float32Array(2)), bad);
  assert.throws(() => light.setGroupScale('none', 1), { code: 'bad-argument', message: /there are: / });
  for (const scale of [-1, NaN, 1e7, [1, 1], [1, 1, -0.1]]) assert.throws(() => light.setGroupScale(0, scale), bad);
});

test('light of other places is not swapped in', () => {
  const bytes = bytesOf(cookedFile('cornell', 'points')), light = openCookedSync(bytes);
  assert.throws(() => light.swapLight(bytesOf(cookedFile('two-rooms', 'points'))), { code: 'other-geometry' });
  assert.throws(() => light.swapLight(bytes.slice(0, 1000)), { code: 'cut-off' });
  const { positions, normals } = somePlaces(light, 100, 1), before = light.irradianceBatch(positions, normals);
  const doubled = bytes.slice(0), whole = new Uint8Array(doubled), other = openCookedSync(doubled);
  other.file.light.forEach((v, i) => (other.file.light[i] = 2 * v));
  checksum(whole).forEach((half, k) => new DataView(doubled).setUint32(24 + 4 * k, half, true));
  const version = light.version;
  light.swapLight(doubled);
  assert(light.version > version);
  assert.deepEqual(light.irradianceBatch(positions, normals), before.map(v => 2 * v));
});
