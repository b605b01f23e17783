import { SsphhError } from '../errors.js';
import { coefficientCount, maxDegree } from '../sh.js';
import { packedBytes, packings, packs, type Packing } from './packing.js';
import { Reader } from './reader.js';
import { expectVersion, limits, packedVersion, names, type Coefficients, type FittedPoint, type Generator, type Probe, type ProbeLightGroup, type ProbeSet, type SurfaceRecords } from './types.js';
import { xxh3 } from './xxh3.js';

export const magic = [0x53, 0x50, 0x48, 0x4c, 0x0d, 0x0a, 0x1a, 0x0a];
const headerSize = 36;

function readGenerator(r: Reader): Generator {
  const operator = r.name('operator', names.operator), viz = r.name('VIZ method', names.viz), vizSource = r.name('VIZ source', names.vizSource);
  const gen = r.name('GEN mode', names.gen), vizPaths = r.name('VIZ paths', names.vizPaths);
  return {
    operator, viz, vizSource, gen, vizPaths,
    maxDepth: r.u32('max depth', limits.depth), passes: r.u32('passes', limits.samples, 1), spp: r.u32('samples', limits.samples, 1),
    vizMaxDepth: r.u32('max depth of VIZ', limits.depth), vizPasses: r.u32('passes of VIZ', limits.samples, 1), vizSpp: r.u32('samples of VIZ', limits.samples, 1),
    faceSize: r.u32('face size', limits.faceSize, 1), seed: r.u64('seed'), directions: r.u32('directions', limits.rays),
    surfelSize: r.f32('surfel size', 0, limits.coordinate), linkRays: r.u32('link rays', limits.rays),
    scene: r.text('scene name', limits.text), sceneHash: r.hash('scene hash'), time: r.f32('time', -limits.coordinate, limits.coordinate),
  };
}

function readLightGroups(r: Reader): ProbeLightGroup[] {
  return Array.from({ length: r.count('light group count', limits.lightGroups, 17) }, () => ({
    name: r.text('light group name', limits.text), scale: r.three('light group scale', limits.scale, 0), mode: r.name('light group mode', names.mode),
  }));
}

function readProbe(r: Reader, index: number, probeCount: number, groupCount: number, floats: number, light: (what: string) => Coefficients): Probe {
  const vector = (what: string) => (r.u8(what, 1, 1), r.floats(what, floats, limits.coefficient));
  const optional = (what: string, count: number) => (r.u8(what, 1) ? r.floats(what, count, limits.coefficient) : null);
  const name = r.text('probe name', limits.text), position = r.three('position', limits.coordinate);
  const radius = r.f32('radius', limits.smallestRadius, limits.coordinate);
  const groups = Array.from({ length: groupCount }, () => ({
    emitted: r.u8('emitted', 1) ? light('emitted') : null, reflected: (r.u8('reflected', 1, 1), light('reflected')),
  }));
  let last = -1;
  const edges = Array.from({ length: r.count('edge count', probeCount - 1, 4 * (2 + floats)) }, () => {
    const from = r.u32('from', probeCount - 1);
    if (from <= last || from === index) r.fail('from', "must be another probe's index, in ascending order");
    last = from;
    return { from, transfer: r.f32('transfer', 0, limits.coefficient), h: vector('h'), matrix: optional('matrix', floats * (floats / 3)) };
  });
  return { name, position, radius, groups, edges, neighbor: null };
}

function readNormal(r: Reader, what: string): [number, number, number] {
  const n = r.three(what, 2);
  if (!(Math.abs(Math.hypot(...n) - 1) <= 1e-3)) r.fail(what, 'must be of length 1');
  return n;
}

function readFitted(r: Reader, probeCount: number): FittedPoint[] {
  return Array.from({ length: r.count('fitted point count', limits.fittedPoints, 25) }, () => {
    const point: FittedPoint = { position: r.three('fitted point', limits.coordinate), normal: readNormal(r, 'fitted normal'), probes: [], weights: [] };
    for (let left = r.u8('fitted weight count', limits.weights); left > 0; --left) {
      point.probes.push(r.u32('fitted probe', probeCount - 1));
      point.weights.push(r.f32('fitted weight', 0, limits.fittedWeight));
    }
    return point;
  });
}

function readSurface(r: Reader, groupCount: number): SurfaceRecords {
  const count = r.count('surface record count', limits.surfaceRecords, 24 + 22 * groupCount);
  const positions = new Float32Array(3 * count), normals = new Float32Array(3 * count);
  const groups = Array.from({ length: groupCount }, () => ({
    reflected: new Float32Array(9 * count), direct: r.u8('direct light flag', 1) ? new Float32Array(9 * count) : null,
  }));
  const read = (out: Float32Array, i: number) => {
    const scale = r.f32("surface record's scale", 0, limits.coefficient) / 32767;
    for (let k = 0; k < 9; ++k) out[9 * i + k] = scale * r.i16("surface record's light", 32767);
  };
  for (let i = 0; i < count; ++i) {
    positions.set(r.three('surface record', limits.coordinate), 3 * i);
    normals.set(readNormal(r, "surface record's normal"), 3 * i);
    for (const group of groups) {
      read(group.reflected, i);
      if (group.direct) read(group.direct, i);
    }
  }
  return { count, positions, normals, groups };
}

function skipBaseline(r: Reader, probeCount: number, groupCount: number): void {
  r.i32('neighbors', -1, limits.probes);
  r.f32('threshold', 0, limits.coefficient);
  r.u32('records', limits.surfaceRecords);
  r.u32('surfels', limits.surfels);
  for (let left = r.count('scene item count', limits.sceneItems, 69); left > 0; --left) {
    r.u8('kind of scene item', 2);
    r.text('name of scene item', limits.text);
    r.skip('hash of scene item', 64);
  }
  if (r.u8('trials flag', 1)) r.skip('trials', probeCount * 2 * groupCount * (1 + 4 * 27));
}

function readPayload(r: Reader, packing: Packing): ProbeSet {
  const degree = r.u32('degree', maxDegree), floats = 3 * coefficientCount(degree);
  if (!packs(packing, degree)) r.fail('packing', `${packing} has no degree ${degree}`);
  const light = (what: string) => r.light(what, packing, degree, limits.coefficient);
  const generator = readGenerator(r), lightGroups = readLightGroups(r), groupCount = lightGroups.length;
  const probeCount = r.count('probe count', limits.probes, groupCount * (packedBytes(packing, degree) + 2) + 24);
  const probes = Array.from({ length: probeCount }, (_, i) => readProbe(r, i, probeCount, groupCount, floats, light));
  let hierarchy: ProbeSet['hierarchy'] = null;
  if (r.u8('hierarchy flag', 1)) {
    const operator = r.name('operator', names.hierOperator), neighbors = r.i32('neighbors', -1, limits.probes);
    hierarchy = { operator, neighbors, threshold: r.f32('threshold', 0, limits.coefficient) };
    for (const probe of probes) probe.neighbor = (r.u8('neighbour part', 1, 1), light('neighbour part'));
  }
  const fitted = r.u8('fitted flag', 1) ? readFitted(r, probeCount) : null;
  const surface = r.u8('surface flag', 1) ? readSurface(r, groupCount) : null;
  const hasBaseline = r.u8('baseline flag', 1) === 1;
  if (hasBaseline) skipBaseline(r, probeCount, groupCount);
  r.end();
  return { degree, generator, lightGroups, probes, hierarchy, fitted, surface, hasBaseline };
}

/** A binary probe file: its first eight bytes are `magic`. */
export function readBinary(bytes: Uint8Array): ProbeSet {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 12) throw new SsphhError('cut-off', 'the probe file is cut off');
  const version = view.getUint32(8, true);
  if (version !== packedVersion) expectVersion(version);
  if (bytes.length < headerSize || Number(view.getBigUint64(12, true)) !== bytes.length - headerSize)
    throw new SsphhError('cut-off', 'the probe file has another size than it says: it was cut off or added to');
  const payload = bytes.subarray(headerSize);
  const [high, low] = payload.length > 16 ? xxh3(payload) : [0n, 0n];
  if (view.getBigUint64(20, true) !== high || view.getBigUint64(28, true) !== low)
    throw new SsphhError('damaged', 'the probe file is damaged: its checksum is wrong');
  const r = new Reader(payload);
  return readPayload(r, version === packedVersion ? packings[r.u8('packing', packings.length - 1, 1)]! : 'none');
}
