import { utf8 } from '../bytes.js';
import { SsphhError } from '../errors.js';
import { coefficientCount, maxDegree } from '../sh.js';
import { Place } from './place.js';
import { expectVersion, limits, names, type FittedPoint, type Generator, type Probe, type ProbeSet, type SurfaceRecords } from './types.js';

function readGenerator(at: Place): Generator {
  at.members(['operator', 'gen', 'max_depth', 'passes', 'spp', 'viz', 'viz_source', 'viz_paths', 'viz_max_depth', 'viz_passes', 'viz_spp',
    'face_size', 'seed', 'directions', 'surfel_size', 'link_rays', 'scene', 'scene_hash', 'time']);
  const count = (key: string, most: number, least = 0) => at.at(key).integer(least, most);
  return {
    operator: at.at('operator').named(names.operator), viz: at.at('viz').named(names.viz), vizSource: at.at('viz_source').named(names.vizSource),
    gen: at.at('gen').named(names.gen), vizPaths: at.at('viz_paths').named(names.vizPaths),
    maxDepth: count('max_depth', limits.depth), passes: count('passes', limits.samples, 1), spp: count('spp', limits.samples, 1),
    vizMaxDepth: count('viz_max_depth', limits.depth), vizPasses: count('viz_passes', limits.samples, 1), vizSpp: count('viz_spp', limits.samples, 1),
    faceSize: count('face_size', limits.faceSize, 1), seed: BigInt(`0x${at.at('seed').matching(/^[0-9a-f]{1,16}$/)}`), directions: count('directions', limits.rays),
    surfelSize: at.at('surfel_size').number(0, limits.coordinate), linkRays: count('link_rays', limits.rays),
    scene: at.at('scene').text(limits.text), sceneHash: at.at('scene_hash').matching(/^[0-9a-f]{32}$/), time: at.at('time').number(-limits.coordinate, limits.coordinate),
  };
}

function readProbe(at: Place, index: number, probeCount: number, groupCount: number, floats: number, withNeighbor: boolean): Probe {
  at.members(['name', 'position', 'radius', 'groups', 'edges', ...(withNeighbor ? ['neighbor'] : [])]);
  const vector = (place: Place, count = floats) => place.floats(count, limits.coefficient);
  let last = -1;
  return {
    name: at.at('name').text(limits.text), position: at.at('position').three(limits.coordinate), radius: at.at('radius').number(limits.smallestRadius, limits.coordinate),
    groups: at.at('groups').list(groupCount, groupCount).map(group => {
      const emitted = group.members(['emitted', 'reflected']).at('emitted');
      return { emitted: Array.isArray(emitted.value) && emitted.value.length === 0 ? null : vector(emitted), reflected: vector(group.at('reflected')) };
    }),
    edges: at.at('edges').list(probeCount - 1).map(edge => {
      const from = edge.members(['from', 'transfer', 'h'], ['matrix']).at('from').integer(0, probeCount - 1);
      if (from <= last || from === index) edge.at('from').fail("must be another probe's index, in ascending order");
      last = from;
      const matrix = edge.has('matrix') ? vector(edge.at('matrix'), floats * (floats / 3)) : null;
      return { from, transfer: edge.at('transfer').number(0, limits.coefficient), h: vector(edge.at('h')), matrix };
    }),
    neighbor: withNeighbor ? vector(at.at('neighbor')) : null,
  };
}

function readNormal(at: Place): [number, number, number] {
  const n = at.three(2);
  return Math.abs(Math.hypot(...n) - 1) <= 1e-3 ? n : at.fail('must be of length 1');
}

function readFitted(at: Place, probeCount: number): FittedPoint[] {
  return at.list(limits.fittedPoints).map(point => {
    point.members(['position', 'normal', 'probes', 'weights']);
    const probes = point.at('probes').list(limits.weights).map(p => p.integer(0, probeCount - 1));
    const weights = point.at('weights').list(probes.length, probes.length).map(w => w.number(0, limits.fittedWeight));
    return { position: point.at('position').three(limits.coordinate), normal: readNormal(point.at('normal')), probes, weights };
  });
}

function readSurface(at: Place, groupCount: number): SurfaceRecords {
  const points = at.list(limits.surfaceRecords), count = points.length;
  const positions = new Float32Array(3 * count), normals = new Float32Array(3 * count);
  const groups: SurfaceRecords['groups'] = Array.from({ length: groupCount }, () => ({ reflected: new Float32Array(9 * count), direct: null }));
  const read = (numbers: Place, out: Float32Array, i: number) => {
    const [first, ...light] = numbers.list(10, 10), scale = first!.number(0, limits.coefficient) / 32767;
    light.forEach((v, k) => (out[9 * i + k] = scale * v.integer(-32767, 32767)));
  };
  points.forEach((point, i) => {
    point.members(['position', 'normal', 'groups'], ['direct']);
    positions.set(point.at('position').three(limits.coordinate), 3 * i);
    normals.set(readNormal(point.at('normal')), 3 * i);
    point.at('groups').list(groupCount, groupCount).forEach((numbers, g) => read(numbers, groups[g]!.reflected, i));
    if (!point.has('direct')) return;
    point.at('direct').list(groupCount, groupCount).forEach((numbers, g) => {
      if (numbers.list(10).length > 0) read(numbers, (groups[g]!.direct ??= new Float32Array(9 * count)), i);
    });
  });
  return { count, positions, normals, groups };
}

/** A probe file in JSON. */
export function readJson(bytes: Uint8Array): ProbeSet {
  if (bytes.length > limits.jsonBytes) throw new SsphhError('invalid', `a probe file in JSON has at most ${limits.jsonBytes} bytes, not ${bytes.length}`);
  let document: unknown;
  try {
    document = JSON.parse(utf8(bytes) ?? '');
  } catch (error) {
    throw new SsphhError('not-sphl', `this is no probe file: ${(error as Error).message}`);
  }
  const root = new Place(document, 'probe file');
  if (typeof document !== 'object' || document === null || (document as { format?: unknown }).format !== 'ssphh-probes')
    throw new SsphhError('not-sphl', 'this is no probe file: its "format" must be "ssphh-probes"');
  expectVersion(root.at('version').value);
  root.members(['format', 'version', 'degree', 'generator', 'light_groups', 'probes'], ['hierarchy', 'fitted', 'surface', 'baseline']);
  const degree = root.at('degree').integer(0, maxDegree), floats = 3 * coefficientCount(degree);
  const lightGroups = root.at('light_groups').list(limits.lightGroups).map(group => {
    group.members(['name', 'scale', 'mode']);
    return { name: group.at('name').text(limits.text), scale: group.at('scale').three(limits.scale, 0), mode: group.at('mode').named(names.mode) };
  });
  const hier = root.has('hierarchy') ? root.at('hierarchy').members(['operator', 'neighbors', 'threshold']) : null;
  const probes = root.at('probes').list(limits.probes);
  return {
    degree, generator: readGenerator(root.at('generator')), lightGroups,
    probes: probes.map((probe, i) => readProbe(probe, i, probes.length, lightGroups.length, floats, hier !== null)),
    hierarchy: hier && {
      operator: hier.at('operator').named(names.hierOperator), neighbors: hier.at('neighbors').integer(-1, limits.probes),
      threshold: hier.at('threshold').number(0, limits.coefficient),
    },
    fitted: root.has('fitted') ? readFitted(root.at('fitted'), probes.length) : null,
    surface: root.has('surface') ? readSurface(root.at('surface'), lightGroups.length) : null,
    hasBaseline: root.has('baseline'),
  };
}
