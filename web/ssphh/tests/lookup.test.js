import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openCookedSync } from 'ssphh';
import { bytesOf, cookedFile, kinds, referenceLight, scenes, somePlaces } from './fixtures.js';

function differences(ours, theirs) {
  let equal = 0, worst = 0;
  assert.equal(ours.length, theirs.length);
  for (let i = 0; i < ours.length; ++i) {
    if (Object.is(ours[i], theirs[i])) ++equal;
    worst = Math.max(worst, Math.abs(ours[i] - theirs[i]) / Math.max(Math.abs(theirs[i]), 1e-30));
  }
  return { equal: equal / ours.length, worst };
}

for (const scene of scenes) {
  for (const kind of Object.keys(kinds)) {
    test(`${scene}, ${kind}: the light of the C run-time`, () => {
      const path = cookedFile(scene, kind), light = openCookedSync(bytesOf(path));
      const { positions, normals } = somePlaces(light, 3000, 1);
      const lit = new Set();
      for (const place of ['still', 'open']) {
        const ours = light.irradianceBatch(positions, normals, undefined, place);
        const theirs = referenceLight(path, place, positions, normals);
        const { equal, worst } = differences(ours, theirs);
        console.log(`${scene}, ${kind}, ${place}: ${(100 * equal).toFixed(3)} % of numbers the same bits, at most ${worst.toExponential(1)} apart`);
        assert(worst <= 1e-5, `${place}: ${worst}`);
        lit.add(ours.filter(v => v > 0).length > ours.length / 3);
      }
      assert.deepEqual([...lit], [true]);
    });
  }
}

test('groups: scales change the light as they do in C, and dimming all is dimming each', () => {
  const path = cookedFile('random?seed=7', 'points'), light = openCookedSync(bytesOf(path));
  const { positions, normals } = somePlaces(light, 1000, 2), bake = light.irradianceBatch(positions, normals);
  const scales = light.groups.map((_, g) => [0, 2.5, 0.3][g % 3]);
  scales.forEach((scale, g) => light.setGroupScale(light.groups[g].name, scale));
  const ours = light.irradianceBatch(positions, normals);
  assert(differences(ours, referenceLight(path, 'still', positions, normals, scales)).worst <= 1e-5);
  assert.notDeepEqual(ours, bake);
  light.resetGroupScales();
  assert.deepEqual(light.irradianceBatch(positions, normals), bake);
  light.groups.forEach((group, g) => light.setGroupScale(g, group.scale.map((v, c) => v * [1, 0.5, 0][c])));
  const coloured = light.irradianceBatch(positions, normals);
  for (let i = 0; i < bake.length; i += 3) {
    assert(Math.abs(coloured[i] - bake[i]) <= 1e-6 * bake[i]);
    assert(Math.abs(coloured[i + 1] - bake[i + 1] / 2) <= 1e-5 * bake[i + 1]);
    assert.equal(coloured[i + 2], 0);
  }
});

test('one place, many places', () => {
  const light = openCookedSync(bytesOf(cookedFile('cornell', 'points')));
  const { positions, normals } = somePlaces(light, 50, 3), many = light.irradianceBatch(positions, normals);
  for (let i = 0; i < many.length; i += 3)
    assert.deepEqual(light.irradiance(positions.subarray(i, i + 3), normals.subarray(i, i + 3)), [...many.subarray(i, i + 3)]);
  positions[4] = NaN;
  const withNan = light.irradianceBatch(positions, normals);
  assert.deepEqual([...withNan.subarray(3, 6)], [0, 0, 0]);
  assert.deepEqual(withNan.subarray(6), many.subarray(6));
});

test('a file without scene: probes alone, nothing hides them', () => {
  const path = cookedFile('cornell', 'points', [], []), light = openCookedSync(bytesOf(path));
  assert.equal(light.info.points, 0);
  assert.equal(light.info.hasSight, false);
  const { positions, normals } = somePlaces(light, 1000, 4);
  assert(differences(light.irradianceBatch(positions, normals), referenceLight(path, 'still', positions, normals)).worst <= 1e-5);
});

test('degrees 0, 1 and 2', () => {
  for (const degree of ['0', '1', '2']) {
    const path = cookedFile('cornell', 'points', ['--degree', degree], []), light = openCookedSync(bytesOf(path));
    assert.equal(light.info.degree, Number(degree));
    const { positions, normals } = somePlaces(light, 300, 5);
    assert(differences(light.irradianceBatch(positions, normals), referenceLight(path, 'open', positions, normals)).worst <= 1e-5);
  }
});

test('summed light is that of the groups', () => {
  const light = openCookedSync(bytesOf(cookedFile('random?seed=7', 'points'))), h = light.file.header;
  const probes = 3 * h.probeCount * h.probeStride, sum = new Float32Array(probes + h.pointCount * h.pointFloats);
  light.setGroupScale(0, [2, 0, 1]);
  light.summedLight(sum);
  const expected = (i, colour) => light.groups.reduce((s, group, g) => s + group.scale[colour] * light.file.light[g * sum.length + i], 0);
  for (const [probe, colour, k] of [[0, 0, 0], [3, 1, 5], [7, 2, 8]]) {
    const i = (3 * probe + colour) * h.probeStride + k;
    assert(Math.abs(sum[i] - expected(i, colour)) <= 1e-5 * Math.abs(expected(i, colour)) + 1e-12);
  }
  for (const i of [probes, probes + 4, probes + 17]) assert(Math.abs(sum[i] - expected(i, (i - probes) % h.pointFloats % 3)) <= 1e-5 * Math.abs(sum[i]) + 1e-12);
});
