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
