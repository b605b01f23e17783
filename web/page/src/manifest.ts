/** What scene.json holds (schemas/web-scene.schema.json). */
export interface Truth { file: string; width: number; height: number; samples: number }
export interface View {
  name: string;
  world: number[];   // camera to world, by columns
  yfov: number;      // radians
  exposure: number;  // EV
  truth?: Truth;
}
export interface Group { name: string; light_groups: string[]; textures: string[] }
/** Places at which a lamp's light was found, at crossings of planes, and boxes in which it may be. */
export interface LatticeData {
  origin: number[];     // least corner of the first box [m]
  box: number;          // edge of a box [m]
  planes: number[][];   // along each axis, in boxes from the origin
  boxes: string;        // file: of each box, x fastest, bit x + 2y + 4z for each corner of its cell that it sees
  places: number;
  place_of: number[];   // of each crossing, x fastest: index of its place; -1: none
}
/** A lamp that can be dragged. */
export interface Movable {
  name: string;
  group: string;
  type: 'point' | 'spot' | 'sphere';
  at: number[];
  power: number[];      // [W/sr]; of a sphere the radiance of its surface [W/(m² sr)]
  radius: number;
  range: number;        // 0: without end
  spot?: { toward: number[]; inner_cone: number; outer_cone: number };
  lattice: LatticeData;
  textures: string[];   // of each pose: indirect light at all places, one lightmap below another
}
export interface Manifest {
  format: string;
  version: number;
  title: string;
  scene: string;
  tone_curve: 'clip' | 'filmic';
  time: number;     // that pictures of the truth show [s]
  times: number[];  // of the poses whose light there is [s]
  cameras: View[];
  lightmap: {
    width: number;
    height: number;
    groups: Group[];
  };
  /** Their lightmaps, and the file that leads from the scene's charts to theirs. */
  movable?: { width: number; height: number; charts: string; lamps: Movable[] };
  environment_group?: string;
}

export class Failure extends Error {}

export async function fetchWhole(name: string, fresh = false): Promise<Response> {
  const answer = await fetch(name, { cache: fresh ? 'no-cache' : 'default' });
  if (!answer.ok) throw new Failure(`${name} cannot be read: the host says ${answer.status} ${answer.statusText}`);
  return answer;
}

export async function readManifest(): Promise<Manifest> {
  const manifest = await (await fetchWhole('scene.json', true)).json() as Manifest;
  if (manifest.format !== 'ssphh-web' || manifest.version !== 1)
    throw new Failure('scene.json is of another version than this page: write the folder anew with `ssphh web`');
  return manifest;
}
