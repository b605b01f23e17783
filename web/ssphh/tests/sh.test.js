import assert from 'node:assert/strict';
import { test } from 'node:test';
import { coefficientCount, cosineFactor, degreeOf, irradianceFromRadiance, shBasis, shEvaluate, shIrradiance } from 'ssphh';
import { randomNumbers, randomUnit, run } from './fixtures.js';

test('Y_lm up to degree 10 are those of ssphh sh eval', () => {
  const random = randomNumbers(1);
  for (const direction of [[0, 0, 1], [0, 0, -1], [1, 0, 0], randomUnit(random), randomUnit(random), randomUnit(random)]) {
    const { values } = JSON.parse(run('sh', 'eval', '--degree', '10', '--direction', ...direction.map(String), '--json'));
    const ours = shBasis(10, direction);
    assert.equal(ours.length, values.length);
    values.forEach((v, k) => assert(Math.abs(v - ours[k]) < 1e-6, `${direction}, ${k}: ${v} ${ours[k]}`));
  }
});

// Gauss–Legendre's nodes by Newton, and even azimuths: exact for products of degree 10
function overSphere(f) {
  const n = 12;
  let sum = 0;
  for (let i = 0; i < n; ++i) {
    let z = Math.cos((Math.PI * (i + 0.75)) / (n + 0.5)), slope = 1;
    for (let step = 0; step < 50; ++step) {
      let p = 1, below = 0;
      for (let l = 1; l <= n; ++l) [p, below] = [((2 * l - 1) * z * p - (l - 1) * below) / l, p];
      slope = (n * (z * p - below)) / (z * z - 1);
      z -= p / slope;
    }
    const weight = 2 / ((1 - z * z) * slope * slope), r = Math.sqrt(1 - z * z);
    for (let k = 0; k < 24; ++k) sum += ((weight * Math.PI) / 12) * f([r * Math.cos((Math.PI * k) / 12), r * Math.sin((Math.PI * k) / 12), z]);
  }
  return sum;
}

test('the basis is orthonormal', () => {
  for (let a = 0; a < coefficientCount(10); a += 7)
    for (let b = a; b < coefficientCount(10); b += 11) {
      const product = overSphere(d => shBasis(10, d)[a] * shBasis(10, d)[b]);
      assert(Math.abs(product - (a === b ? 1 : 0)) < 1e-10, `${a} ${b}: ${product}`);
    }
});

test('irradiance: even light, light from above, a narrow beam', () => {
  const even = new Float32Array(27).fill(0);
  even.fill(2 / 0.28209479177, 0, 3); // radiance 2 everywhere
  for (const n of [[0, 1, 0], [0.6, 0, 0.8]]) shIrradiance(even, n).forEach(e => assert(Math.abs(e - 2 * Math.PI) < 1e-5));
  const slope = new Float32Array(27);
  slope.fill(1 / 0.4886025119, 3, 6); // radiance y: E of n·y · 2π/3
  shIrradiance(slope, [0, 1, 0]).forEach(e => assert(Math.abs(e - (2 * Math.PI) / 3) < 1e-5));
  assert.deepEqual(shIrradiance(slope, [0, -1, 0]), [0, 0, 0]);
  const beam = [0, 0.6, 0.8], delta = new Float32Array(3 * 121), y = shBasis(10, beam);
  y.forEach((v, k) => delta.fill(v, 3 * k, 3 * k + 3));
  const e = shEvaluate(irradianceFromRadiance(delta), [0, 1, 0])[0]; // the clamped cosine in bands 0 to 10
  assert(Math.abs(e - 0.6) < 0.02, String(e));
});

test('factors of the cosine are its integrals', () => {
  for (let l = 0; l <= 10; ++l) {
    let sum = 0;
    const n = 20000, legendre = z => {
      let p = 1, below = 0;
      for (let k = 1; k <= l; ++k) [p, below] = [((2 * k - 1) * z * p - (k - 1) * below) / k, p];
      return p;
    };
    for (let i = 0; i < n; ++i) {
      const z = (i + 0.5) / n;
      sum += (2 * Math.PI * z * legendre(z)) / n;
    }
    assert(Math.abs(sum - cosineFactor(l)) < 1e-6, `${l}: ${sum} ${cosineFactor(l)}`);
  }
});

test('degrees that are none', () => {
  for (const n of [0, 2, 3, 5, 144, 1.5]) assert.throws(() => degreeOf(n), { code: 'bad-argument' });
  for (const degree of [-1, 11, 1.5, NaN]) assert.throws(() => shBasis(degree, [0, 1, 0]), { code: 'bad-argument' });
  assert.throws(() => shEvaluate([1, 2, 3, 4], [0, 1, 0]), { code: 'bad-argument' });
});
