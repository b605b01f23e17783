/** Irradiance from the probes around: moving least squares over those in sight, or inverse squared distances. libs/runtime's probes.c, in float32. */
import { groupFloats, type CookedFile } from './file.js';
import { clamp, dot, dot3, type Float3 } from './float.js';
import { mostGroups, noProbe } from './layout.js';
import { sees } from './sight.js';

const f = Math.fround;
const mlsReach = 2, leastBump = f(1e-6), mlsRidge = f(0.05), wrappedFloor = f(0.05), hiddenSlope = 4, sightLift = f(0.01);
const mostNear = 16, mostBlended = 8;

const nearDistance2 = new Float32Array(mostNear), nearProbe = new Uint16Array(mostNear);
const usedProbe = new Uint16Array(mostNear), usedWeight = new Float32Array(mostNear);
const place = new Float32Array(4 * mostNear), way = new Float32Array(3), row = new Float32Array(4);
const matrix = new Float64Array(16), factor = new Float64Array(16), solved = new Float64Array(4);
const harmonics = new Float32Array(24), sum = new Float32Array(3);

function setWay(file: CookedFile, probe: number, x: Float3): void {
  for (let c = 0; c < 3; ++c) way[c] = file.probes[4 * probe + c]! - x[c]!;
}

/** At most 16 candidates of the place's cell, nearest first. */
function findNear(file: CookedFile, x: Float3): number {
  const h = file.header;
  let cell = 0;
  for (let c = 2; c >= 0; --c) {
    const u = f(f(x[c]! - h.probeOrigin[c]!) / h.probeCellSize);
    cell = cell * h.probeCells[c]! + Math.trunc(clamp(u, 0, f(h.probeCells[c]!) - 1));
  }
  const first = cell * h.probeListLength, end = first + h.probeListLength, { probes, probeCells } = file, x0 = x[0]!, x1 = x[1]!, x2 = x[2]!;
  let count = 0;
  for (let i = first; i < end && probeCells[i] !== noProbe; ++i) {
    const probe = probeCells[i]!, dx = f(probes[4 * probe]! - x0), dy = f(probes[4 * probe + 1]! - x1), dz = f(probes[4 * probe + 2]! - x2);
    const distance2 = dot3(dx, dy, dz, dx, dy, dz);
    if (count === mostNear && !(distance2 < nearDistance2[count - 1]!)) continue;
    let k = count < mostNear ? count++ : count - 1;
    for (; k > 0 && distance2 < nearDistance2[k - 1]!; --k) {
      nearDistance2[k] = nearDistance2[k - 1]!;
      nearProbe[k] = nearProbe[k - 1]!;
    }
    nearDistance2[k] = distance2;
    nearProbe[k] = probe;
  }
  return count;
}

function seesNear(file: CookedFile, near: number, still: boolean, x: Float3, n: Float3): boolean {
  const spacing = file.header.probeSpacing, distance = f(Math.sqrt(nearDistance2[near]!));
  const lift = f(sightLift * (spacing > 0 && spacing < distance ? spacing : distance));
  return sees(file, nearProbe[near]!, still, x, n, lift);
}

/** Of the angle between the normal and the way to the probe; 1 where it stands there. */
function cosine(file: CookedFile, probe: number, x: Float3, n: Float3): number {
  setWay(file, probe, x);
  const length = f(Math.sqrt(dot(way, way)));
  return length > 0 ? f(dot(n, way) / length) : 1;
}

function byDistance(file: CookedFile, count: number, still: boolean, x: Float3, n: Float3): number {
  let used = 0, total = 0;
  const chosen: number[] = [];
  for (let i = 0; i < count && chosen.length < mostBlended; ++i) if (seesNear(file, i, still, x, n)) chosen.push(i);
  const noneSeen = chosen.length === 0;
  for (; noneSeen && chosen.length < Math.min(count, mostBlended); ) chosen.push(chosen.length);
  for (const near of chosen) {
    const distance2 = nearDistance2[near]!, probe = nearProbe[near]!;
    const wrapped = f(0.5 * f(1 + cosine(file, probe, x, n)));
    const share = f(f(nearDistance2[chosen[0]!]! / distance2) * f(f(wrapped * wrapped) + wrappedFloor));
    usedProbe[used] = probe;
    usedWeight[used] = distance2 > 0 ? share : 1;
    total = f(total + usedWeight[used++]!);
  }
  for (let k = 0; k < used; ++k) {
    usedWeight[k] = usedWeight[k]! / total;
    if (noneSeen) usedWeight[k] = usedWeight[k]! * clamp(f(hiddenSlope * cosine(file, usedProbe[k]!, x, n)), 0, 1);
  }
  return used;
}

/** First row of the inverse of `matrix`, which is positive definite, by Cholesky's factors. */
function findFirstRow(): void {
  for (let i = 0; i < 4; ++i) {
    for (let j = 0; j <= i; ++j) {
      let v = matrix[4 * i + j]!;
      for (let k = 0; k < j; ++k) v -= factor[4 * i + k]! * factor[4 * j + k]!;
      factor[4 * i + j] = i === j ? Math.sqrt(v > 0 ? v : 1e-300) : v / factor[4 * j + j]!;
    }
  }
  for (let i = 0; i < 4; ++i) {
    let v = i === 0 ? 1 : 0;
    for (let k = 0; k < i; ++k) v -= factor[4 * i + k]! * solved[k]!;
    solved[i] = v / factor[4 * i + i]!;
  }
  for (let i = 3; i >= 0; --i) {
    for (let k = i + 1; k < 4; ++k) solved[i] = solved[i]! - factor[4 * k + i]! * solved[k]!;
    solved[i] = solved[i]! / factor[4 * i + i]!;
    row[i] = solved[i]!;
  }
}

function byLeastSquares(file: CookedFile, count: number, still: boolean, x: Float3, n: Float3): number {
  const spacing = file.header.probeSpacing, reach2 = f(f(mlsReach * mlsReach * spacing) * spacing);
  let used = 0, total = 0;
  matrix.fill(0);
  for (let i = 0; i < count && nearDistance2[i]! <= reach2; ++i) {
    if (!seesNear(file, i, still, x, n)) continue;
    const at = 4 * used, probe = nearProbe[i]!;
    place[at] = 1;
    for (let c = 0; c < 3; ++c) place[at + c + 1] = f(file.probes[4 * probe + c]! - x[c]!) / spacing;
    const t = Math.max(0, f(1 - f(nearDistance2[i]! / reach2))), bump = f(f(t * t) + leastBump);
    total += bump;
    for (let a = 0; a < 4; ++a)
      for (let b = 0; b <= a; ++b) matrix[4 * a + b] = matrix[4 * a + b]! + bump * place[at + a]! * place[at + b]!;
    usedProbe[used] = probe;
    usedWeight[used++] = bump;
  }
  if (used === 0) return 0;
  for (let c = 1; c < 4; ++c) matrix[5 * c] = matrix[5 * c]! + mlsRidge * total;
  findFirstRow();
  let all = 0;
  for (let i = 0; i < used; ++i) {
    let at = 0;
    for (let c = 0; c < 4; ++c) at = f(at + f(row[c]! * place[4 * i + c]!));
    usedWeight[i] = usedWeight[i]! * at;
    all = f(all + usedWeight[i]!);
  }
  for (let i = 0; i < used; ++i) usedWeight[i] = usedWeight[i]! / all;
  return used;
}

/** Y of bands 0, 1, 2 and 4, one after the other: irradiance has no band 3. Zeros above the degree. */
function setHarmonics(degree: number, n: Float3): void {
  const x = n[0]!, y = n[1]!, z = n[2]!, x2 = f(x * x), y2 = f(y * y), z2 = f(z * z);
  harmonics.fill(0);
  harmonics[0] = 0.282094792;
  if (degree < 1) return;
  const h1 = f(0.488602512);
  harmonics[1] = h1 * y, harmonics[2] = h1 * z, harmonics[3] = h1 * x;
  if (degree < 2) return;
  const h2 = f(1.092548431);
  harmonics[4] = f(h2 * x) * y, harmonics[5] = f(h2 * y) * z;
  harmonics[6] = f(0.315391565) * f(f(3 * z2) - 1);
  harmonics[7] = f(h2 * x) * z, harmonics[8] = f(0.546274215) * f(x2 - y2);
  if (degree < 4) return;
  const h44 = f(2.503342942), h43 = f(1.770130769), h42 = f(0.946174696), h41 = f(0.669046544);
  const seven1 = f(f(7 * z2) - 1), seven3 = f(f(7 * z2) - 3);
  harmonics[9] = f(f(h44 * x) * y) * f(x2 - y2);
  harmonics[10] = f(f(h43 * y) * z) * f(f(3 * x2) - y2);
  harmonics[11] = f(f(h42 * x) * y) * seven1;
  harmonics[12] = f(f(h41 * y) * z) * seven3;
  harmonics[13] = f(0.105785547) * f(f(f(f(35 * z2) * z2) - f(30 * z2)) + 3);
  harmonics[14] = f(f(h41 * x) * z) * seven3;
  harmonics[15] = f(f(0.473087348) * f(x2 - y2)) * seven1;
  harmonics[16] = f(f(h43 * x) * z) * f(x2 - f(3 * y2));
  harmonics[17] = f(0.625835735) * f(f(f(x2 * x2) - f(f(6 * x2) * y2)) + f(y2 * y2));
}

/** Harmonics times the scales of groups that are on: 24 for each colour of each. */
let scaled = new Float32Array(0);
const groupsOn = [new Uint16Array(mostGroups), new Uint16Array(mostGroups), new Uint16Array(mostGroups)], countOn = [0, 0, 0];

function setScaled(groups: number, scales: Float32Array): void {
  if (scaled.length < 72 * groups) scaled = new Float32Array(72 * groups);
  for (let c = 0; c < 3; ++c) {
    let on = 0;
    for (let g = 0; g < groups; ++g) {
      const scale = scales[3 * g + c]!, to = 72 * g + 24 * c;
      if (scale === 0) continue;
      groupsOn[c]![on++] = g;
      for (let k = 0; k < 24; ++k) scaled[to + k] = scale * harmonics[k]!;
    }
    countOn[c] = on;
  }
}

/** Irradiance of one colour of a probe by all groups, not negative: eight sums side by side, as the C code has them. */
function irradianceOf(file: CookedFile, light: Float32Array, probe: number, colour: number): number {
  const h = file.header, stride = h.probeStride, each = groupFloats(h), on = groupsOn[colour]!, count = countOn[colour]!;
  let s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0;
  for (let i = 0; i < count; ++i) {
    const g = on[i]!, y = 72 * g + 24 * colour, at = g * each + (3 * probe + colour) * stride;
    for (let k = 0; k < stride; k += 8) {
      s0 = f(s0 + f(scaled[y + k]! * light[at + k]!));
      s1 = f(s1 + f(scaled[y + k + 1]! * light[at + k + 1]!));
      s2 = f(s2 + f(scaled[y + k + 2]! * light[at + k + 2]!));
      s3 = f(s3 + f(scaled[y + k + 3]! * light[at + k + 3]!));
      s4 = f(s4 + f(scaled[y + k + 4]! * light[at + k + 4]!));
      s5 = f(s5 + f(scaled[y + k + 5]! * light[at + k + 5]!));
      s6 = f(s6 + f(scaled[y + k + 6]! * light[at + k + 6]!));
      s7 = f(s7 + f(scaled[y + k + 7]! * light[at + k + 7]!));
    }
  }
  const e = f(f(f(f(f(f(f(s0 + s1) + s2) + s3) + s4) + s5) + s6) + s7);
  return e > 0 ? e : 0;
}

/** Irradiance by the probes around, to `rgb`. `still`: the place is on a surface. */
export function byProbes(file: CookedFile, light: Float32Array, scales: Float32Array, still: boolean, x: Float3, n: Float3, rgb: Float3): void {
  const count = findNear(file, x);
  let used = file.header.probeSpacing > 0 ? byLeastSquares(file, count, still, x, n) : 0;
  if (used === 0) used = byDistance(file, count, still, x, n);
  setHarmonics(file.header.degree, n);
  setScaled(file.header.groupCount, scales);
  sum.fill(0);
  for (let i = 0; i < used; ++i)
    for (let c = 0; c < 3; ++c) sum[c] = sum[c]! + f(usedWeight[i]! * irradianceOf(file, light, usedProbe[i]!, c));
  for (let c = 0; c < 3; ++c) rgb[c] = sum[c]! > 0 ? sum[c]! : 0;
}
