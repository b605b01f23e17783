import { utf8, viewOf, type Bytes } from './bytes.js';
import { SsphhError } from './errors.js';
import { Place } from './sphl/place.js';
import { limits } from './sphl/types.js';

/** An SPHL of a glTF file: a place where a probe stands, or a lamp of any intensity per direction, or both. */
export interface GltfSphl {
  name: string;
  /** Index of its node. */
  node: number;
  /** World [m], with the nodes' transforms and without animations. */
  position: [number, number, number];
  /** Metres. */
  radius: number;
  /** A probe stands here. */
  enabled: boolean;
  /** What it sends out; null: it is no lamp. */
  emission: GltfEmission | null;
}

export interface GltfEmission {
  lightGroup: string;
  /** Factors on the coefficients. */
  color: [number, number, number];
  intensity: number;
  /**
   * RGB intensity [W/sr] of each frame, r₀ g₀ b₀ r₁ …, in the node's axes (`shEvaluate`; what is negative sends nothing). Empty where the file
   * names a lobe or another file.
   */
  frames: Float32Array[];
  /** Frames per second, from `start` [s]; `repeat`: after the last comes the first. */
  rate: number;
  start: number;
  repeat: boolean;
}

/** What this project writes into glTF's extras (docs/gltf.md): no other loader reads it. */
export interface GltfExtras {
  sphls: GltfSphl[];
  /** Of light groups that have one: realtime, mixed, baked, diffuse. */
  lightModes: Record<string, string>;
  /** What `ssphh lightmap` wrote beside the file; null: nothing. */
  lightmap: unknown;
}

type Json = Record<string, unknown>;
type Matrix = number[]; // 16, by columns
const identity: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function isObject(value: unknown): value is Json {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
function member(value: unknown, ...keys: string[]): unknown {
  return keys.reduce<unknown>((v, key) => (isObject(v) && Object.hasOwn(v, key) ? v[key] : undefined), value);
}
function place(value: unknown, path: string): Place {
  return new Place(value, path);
}

function documentOf(bytes: Uint8Array): Json {
  let text = bytes;
  if (bytes.length >= 12 && utf8(bytes.subarray(0, 4)) === 'glTF') {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (view.getUint32(4, true) !== 2 || view.getUint32(8, true) !== bytes.length)
      throw new SsphhError('not-gltf', 'the GLB file is of another version than 2, or cut off');
    const size = bytes.length >= 20 ? view.getUint32(12, true) : 0;
    if (size > bytes.length - 20 || view.getUint32(16, true) !== 0x4e4f534a) throw new SsphhError('not-gltf', "the GLB file's first chunk is no JSON");
    text = bytes.subarray(20, 20 + size);
  }
  try {
    const document: unknown = JSON.parse(utf8(text) ?? '');
    if (isObject(document) && isObject(document['asset'])) return document;
  } catch {
    // said below
  }
  throw new SsphhError('not-gltf', 'this is no glTF 2.0 file');
}

function product(a: Matrix, b: Matrix): Matrix {
  return a.map((_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + (i % 4)]! * b[4 * Math.floor(i / 4) + k]!, 0));
}

function ownTransform(node: unknown, path: string): Matrix {
  const numbers = (key: string, count: number, otherwise: number[]) =>
    member(node, key) === undefined ? otherwise : [...place(member(node, key), `${path}.${key}`).list(count, count)].map(p => p.number(-1e30, 1e30));
  if (member(node, 'matrix') !== undefined) return numbers('matrix', 16, identity);
  const [x, y, z, w] = numbers('rotation', 4, [0, 0, 0, 1]) as [number, number, number, number];
  const [sx, sy, sz] = numbers('scale', 3, [1, 1, 1]) as [number, number, number];
  return [
    sx * (1 - 2 * (y * y + z * z)), sx * 2 * (x * y + z * w), sx * 2 * (x * z - y * w), 0,
    sy * 2 * (x * y - z * w), sy * (1 - 2 * (x * x + z * z)), sy * 2 * (y * z + x * w), 0,
    sz * 2 * (x * z + y * w), sz * 2 * (y * z - x * w), sz * (1 - 2 * (x * x + y * y)), 0,
    ...numbers('translation', 3, [0, 0, 0]), 1,
  ];
}

/** World transforms of all nodes of the scene; Error where a node has two parents. */
function worldTransforms(document: Json): Map<number, Matrix> {
  const nodes = Array.isArray(document['nodes']) ? document['nodes'] : [], scenes = Array.isArray(document['scenes']) ? document['scenes'] : [];
  const scene: unknown = scenes[typeof document['scene'] === 'number' ? document['scene'] : 0], world = new Map<number, Matrix>();
  const open: [unknown, Matrix][] = [];
  const add = (children: unknown, parent: Matrix) => {
    if (Array.isArray(children)) for (const child of children) open.push([child, parent]);
  };
  add(member(scene, 'nodes'), identity);
  for (let next = open.pop(); next; next = open.pop()) {
    const node = place(next[0], 'nodes').integer(0, nodes.length - 1);
    if (world.has(node)) throw new SsphhError('invalid', `nodes[${node}]: has two parents`);
    const transform = product(next[1], ownTransform(nodes[node], `nodes[${node}]`));
    world.set(node, transform);
    add(member(nodes[node], 'children'), transform);
  }
  return world;
}

function readEmission(at: Place, lightGroup: string, light: unknown): GltfEmission {
  const json = at.value, floats = (p: Place) => p.floats(Array.isArray(p.value) ? p.value.length : 0, limits.coefficient);
  const listed = member(json, 'frames'), one = member(json, 'coefficients');
  const number = (key: string, otherwise: number) => (member(json, key) === undefined ? otherwise : at.at(key).number(-1e30, 1e30));
  const frames = listed !== undefined ? at.at('frames').list(1 << 16, 1).map(floats) : one !== undefined ? [floats(at.at('coefficients'))] : [];
  if (frames.some(f => !Number.isInteger(Math.sqrt(f.length / 3)) || f.length === 0 || f.length > 363 || f.length !== frames[0]!.length))
    at.fail('frames must have 3 (degree + 1)² numbers each, of one degree from 0 to 10');
  const color = member(json, 'color') ?? member(light, 'color') ?? [1, 1, 1];
  return {
    lightGroup, color: place(color, `${at.path}.color`).three(1e30, 0), intensity: number('intensity', 1), frames, rate: number('rate', 0), start: number('start', 0),
    repeat: member(json, 'repeat') === true,
  };
}

function sphlOf(document: Json, node: number, world: Matrix): GltfSphl | null {
  const nodeJson = (document['nodes'] as unknown[])[node], path = `nodes[${node}]`;
  const settings = member(nodeJson, 'extras', 'sphl'), nodeName = member(nodeJson, 'name');
  const ownName = typeof nodeName === 'string' ? nodeName : '';
  const index = member(nodeJson, 'extensions', 'KHR_lights_punctual', 'light');
  const lights = member(document, 'extensions', 'KHR_lights_punctual', 'lights');
  const light: unknown = Array.isArray(lights) && typeof index === 'number' ? lights[index] : undefined;
  const lamp = member(light, 'extras', 'ssphh', 'type') === 'sphl' ? member(light, 'extras', 'ssphh') : undefined;
  const isProbe = settings === undefined ? ownName.startsWith('SPHL') : settings !== false;
  if (!isProbe && lamp === undefined) return null;
  const text = (value: unknown, otherwise: string) => (typeof value === 'string' ? value : otherwise);
  const name = text(member(settings, 'name'), ownName), radius = member(settings, 'radius') ?? member(lamp, 'radius') ?? 0.1;
  const emission = member(settings, 'emission') ?? member(lamp, 'emission');
  const group = text(member(settings, 'light_group') ?? member(light, 'extras', 'light_group'), text(member(light, 'name'), name));
  return {
    name, node, position: [world[12]!, world[13]!, world[14]!],
    radius: place(radius, `${path}.extras.sphl.radius`).number(limits.smallestRadius, limits.coordinate),
    enabled: isProbe && member(settings, 'enabled') !== false,
    emission: emission === undefined ? null : readEmission(place(emission, `${path}: emission`), group, light),
  };
}

/**
 * Reads SPHLs, light modes and lightmap from the extras of a glTF file that `ssphh export`, `ssphh lightmap` or a modeller wrote: GLB or JSON.
 * Errors: `not-gltf`, `invalid` (with the place). With three's GLTFLoader the same stands in `userData`.
 */
export function readGltfExtras(bytes: Bytes): GltfExtras {
  const document = documentOf(viewOf(bytes)), scenes = document['scenes'];
  const scene: unknown = Array.isArray(scenes) ? scenes[typeof document['scene'] === 'number' ? document['scene'] : 0] : undefined;
  const modes = member(scene, 'extras', 'ssphh', 'light_modes'), lightModes: Record<string, string> = {};
  if (isObject(modes))
    for (const [group, mode] of Object.entries(modes)) lightModes[group] = place(mode, `light_modes.${group}`).named(['realtime', 'mixed', 'baked', 'diffuse']);
  const sphls = [...worldTransforms(document)].sort(([a], [b]) => a - b).map(([node, world]) => sphlOf(document, node, world)).filter(s => s !== null);
  return { sphls, lightModes, lightmap: member(scene, 'extras', 'ssphh', 'lightmap') ?? null };
}
