import { fetchBytes, viewOf, type Bytes, type BytesSource } from '../bytes.js';
import { SsphhError } from '../errors.js';
import type { Rgb, Triple } from '../sh.js';
import type { CookedFile } from './file.js';
import { byPoints } from './points.js';
import { byProbes } from './probes.js';
import { checkAll } from './validate.js';

/**
 * What is asked for: `still`, a place on a surface that stands still; `open`, one on something that moves, or in the open: points of
 * surfaces are not asked, nor does anything hide what is behind the place.
 */
export type PlaceKind = 'still' | 'open';

export interface LightGroup {
  readonly name: string;
  /** RGB as it is now, relative to the bake. */
  readonly scale: Readonly<Rgb>;
  /** Surfaces get its direct light from here, too: leave it out where you draw. */
  readonly baked: boolean;
}

export interface LightInfo {
  readonly probes: number;
  /** Points of surfaces with light of their own; 0: the probes light all. */
  readonly points: number;
  /** Of the probes' irradiance: 0, 1, 2 or 4. */
  readonly degree: number;
  /** Lookups know what stands between a place and a probe. */
  readonly hasSight: boolean;
  /** Pose of the scene at the bake [s]. */
  readonly time: number;
  /** Equal for files whose light can be swapped. */
  readonly geometry: bigint;
  /** Hash of the scene at the bake, 32 hexadecimal digits. */
  readonly scene: string;
}

const position = new Float32Array(3), normal = new Float32Array(3), found = new Float32Array(3);

function setThree(out: Float32Array, from: Triple, at: number): boolean {
  for (let c = 0; c < 3; ++c) out[c] = from[at + c]!;
  return Number.isFinite(out[0]!) && Number.isFinite(out[1]!) && Number.isFinite(out[2]!);
}

function hex(value: bigint): string {
  return value.toString(16).padStart(16, '0');
}

/** An opened cooked file: light of a scene at any place. World: right-handed, y up, metres; light is linear RGB. */
export class CookedLight {
  readonly info: LightInfo;
  /** The file, for who puts it onto a graphics card. Not to be written to. */
  readonly file: CookedFile;
  /** Grows when a scale or the light changes. */
  version = 0;
  #scales: Float32Array;
  #light: Float32Array;

  /** @internal Of a checked file: call `openCooked`. */
  constructor(file: CookedFile) {
    const h = file.header;
    this.file = file;
    this.#light = file.light;
    this.#scales = new Float32Array(file.groups.flatMap(g => g.scale));
    this.info = {
      probes: h.probeCount, points: h.pointCount, degree: h.degree, hasSight: h.sightSize > 0, time: h.time, geometry: h.geometry,
      scene: hex(h.scene[0]) + hex(h.scene[1]),
    };
  }

  /** The light groups of the bake, in its order. */
  get groups(): LightGroup[] {
    return this.file.groups.map(({ name, mode }, g) => ({
      name, baked: mode === 2, scale: [...this.#scales.subarray(3 * g, 3 * g + 3)] as Rgb,
    }));
  }

  /**
   * Indirect irradiance [W/m²] (and the direct irradiance of baked groups) at a place [m] for a unit normal; never negative. A
   * Lambertian surface of albedo a leaves a E/π. Error `bad-argument` where position or normal is not finite.
   */
  irradiance(at: Triple, unitNormal: Triple, kind: PlaceKind = 'still'): Rgb {
    if (!setThree(position, at, 0) || !setThree(normal, unitNormal, 0))
      throw new SsphhError('bad-argument', 'position and normal must be three finite numbers each');
    this.#lookUp(kind);
    return [found[0]!, found[1]!, found[2]!];
  }

  /**
   * The same for many places: three numbers of each in `positions` and `normals`, three in `out`, which is returned. The same bits as
   * one by one; 0 for a place that is not finite. Errors `bad-argument`: lengths that do not fit.
   */
  irradianceBatch(positions: ArrayLike<number>, normals: ArrayLike<number>, out = new Float32Array(positions.length), kind: PlaceKind = 'still'): Float32Array {
    const length = positions.length;
    if (length % 3 !== 0 || normals.length !== length || out.length < length)
      throw new SsphhError('bad-argument', `positions, normals and out must have three numbers for each place: ${length}, ${normals.length}, ${out.length}`);
    for (let i = 0; i < length; i += 3) {
      found.fill(0);
      const good = setThree(position, positions, i);
      if (setThree(normal, normals, i) && good) this.#lookUp(kind);
      for (let c = 0; c < 3; ++c) out[i + c] = found[c]!;
    }
    return out;
  }

  #lookUp(kind: PlaceKind): void {
    if (kind !== 'still' && kind !== 'open') throw new SsphhError('bad-argument', `a place is "still" or "open", not ${JSON.stringify(kind)}`);
    if (kind === 'still' && byPoints(this.file, this.#light, this.#scales, position, normal, found)) return;
    byProbes(this.file, this.#light, this.#scales, kind === 'still', position, normal, found);
  }

  /** Dims, switches or colours a light group, by name or number: `scale` is RGB of 0 to 1e6 (or one number), relative to the bake. */
  setGroupScale(group: string | number, scale: Triple | number): void {
    const g = typeof group === 'number' ? group : this.file.groups.findIndex(({ name }) => name === group);
    if (!Number.isInteger(g) || g < 0 || g >= this.file.groups.length)
      throw new SsphhError('bad-argument', `there is no light group ${JSON.stringify(group)}; there are: ${this.file.groups.map(({ name }) => name).join(', ')}`);
    const rgb = typeof scale === 'number' ? [scale, scale, scale] : [scale[0]!, scale[1]!, scale[2]!];
    if (!rgb.every(v => v >= 0 && v <= 1e6)) throw new SsphhError('bad-argument', `a scale is three numbers from 0 to 1e6, not ${rgb.join(', ')}`);
    this.#scales.set(rgb, 3 * g);
    ++this.version;
  }

  /** Sets all groups to the scales of the bake. */
  resetGroupScales(): void {
    this.file.groups.forEach((group, g) => this.setGroupScale(g, group.scale));
  }

  /**
   * Looks up the light of another file from now on, cooked later of the same probes and surfaces (`ssphh cook --places-of`) with the same
   * groups; scales stay. All of the file is checked. Errors `other-geometry`, `other-groups` and those of `openCooked`.
   */
  swapLight(bytes: Bytes): void {
    const other = checkAll(aligned(viewOf(bytes))), own = this.file.header, h = other.header;
    const counts = ['geometry', 'probeCount', 'degree', 'pointCount', 'pointFloats'] as const;
    if (counts.some(name => h[name] !== own[name]))
      throw new SsphhError('other-geometry', 'light of other probes or surfaces cannot be swapped in: ssphh cook --places-of takes those of a file');
    const same = other.groups.length === this.file.groups.length &&
      other.groups.every(({ name, mode }, g) => name === this.file.groups[g]!.name && mode === this.file.groups[g]!.mode);
    if (!same) throw new SsphhError('other-groups', 'light of other light groups cannot be swapped in: open the file');
    this.#light = other.light;
    ++this.version;
  }

  /** Light of all groups at their scales: 3 × stride floats for each probe (bands 0, 1, 2, 4 of red, of green, of blue), then a point's floats. */
  summedLight(out: Float32Array): void {
    const h = this.file.header, probeNumbers = h.probeCount * 3 * h.probeStride, each = probeNumbers + h.pointCount * h.pointFloats;
    out.fill(0);
    for (let g = 0; g < h.groupCount; ++g) {
      for (let i = 0; i < each; ++i) {
        const inProbe = i < probeNumbers;
        const colour = inProbe ? Math.floor(i / h.probeStride) % 3 : ((i - probeNumbers) % h.pointFloats) % 3;
        out[i] = out[i]! + this.#scales[3 * g + colour]! * this.#light[g * each + i]!;
      }
    }
  }
}

/** Views of 32-bit numbers want it; bytes that lie so already are not copied. */
function aligned(bytes: Uint8Array): Uint8Array {
  return bytes.byteOffset % 8 === 0 ? bytes : bytes.slice();
}

/**
 * Opens a cooked file (`ssphh cook`, version 3) where it lies: the bytes must stay as they are. Reads all of it once and refuses what is
 * damaged or contradicts itself, with an `SsphhError` of code `not-cooked`, `bad-version`, `cut-off`, `damaged` or `invalid`. Light groups
 * begin with the scales of the bake. Bytes that begin at no multiple of 8 in their ArrayBuffer are copied.
 */
export function openCookedSync(bytes: Bytes): CookedLight {
  if (new Uint8Array(Uint32Array.of(1).buffer)[0] !== 1)
    throw new SsphhError('bad-argument', 'cooked files are used where they lie, in the byte order of little-endian machines');
  return new CookedLight(checkAll(aligned(viewOf(bytes))));
}

/** The same of bytes, a `Response` or a `Blob`: `await openCooked(await fetch('room.sphlc'))`. */
export async function openCooked(source: Bytes | BytesSource): Promise<CookedLight> {
  return openCookedSync(await fetchBytes(source));
}
