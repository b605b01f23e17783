import { BufferAttribute, Color, DataTexture, DataUtils, HalfFloatType, LinearFilter, Mesh, RGBAFormat, Vector3, Vector4, type BufferGeometry, type IUniform, type Scene, type Texture, type WebGLRenderer } from 'three';
import { readHalves } from './atlas';
import { Lattice } from './lattice';
import { posesAt } from './light';
import { fetchWhole, type Manifest, type Movable } from './manifest';
import { Shadows } from './shadows';

const floatOf = Float32Array.from({ length: 0x7c00 }, (_, half) => DataUtils.fromHalfFloat(half));

/** A lamp that can be dragged, and where it is. */
export class Lamp {
  readonly home: Vector3;
  readonly at: Vector3;
  /** Indirect light at all places, of each pose; nothing before it is loaded. */
  light: Uint16Array[] = [];
  private loading: Promise<void> | undefined;

  constructor(readonly data: Movable, readonly lattice: Lattice) {
    this.home = new Vector3().fromArray(data.at);
    this.at = this.home.clone();
  }
  get moved(): boolean { return !this.at.equals(this.home); }

  /** Of so many texels at each place. */
  load(texels: number): Promise<void> {
    this.loading ??= Promise.all(this.data.textures.map(name => readHalves(name, texels, this.data.lattice.places)))
      .then(light => { this.light = light; });
    return this.loading;
  }
}

/** Lamps that can be dragged: while one is not at its place, its light is drawn here and not by the lightmaps. */
export class Lamps {
  readonly lamps: Lamp[];
  readonly uniforms: { moved: IUniform<DataTexture>; shadows: IUniform<Texture | null>; lampAt: IUniform<Vector4[]>; lampPower: IUniform<Vector4[]>; lampCone: IUniform<Vector4[]> };
  private readonly sum: Float32Array;    // of each texel of the charts, one chart after another
  private readonly texelAt: Int32Array;  // of each texel of the texture the index of that, also in the rim around charts; -1: none
  private readonly chartAt: Int32Array;  // of each texel of the scene's lightmap
  private readonly shadows: Shadows;
  private readonly looked: Vector4[];  // where and when each lamp looked around last

  private constructor(private readonly manifest: Manifest, lattices: Lattice[], private readonly charts: Uint16Array) {
    const { width, height, lamps } = manifest.movable!;
    this.lamps = lamps.map((data, i) => new Lamp(data, lattices[i]!));
    const texture = new DataTexture(new Uint16Array(4 * width * height), width, height, RGBAFormat, HalfFloatType);
    texture.minFilter = texture.magFilter = LinearFilter;
    this.shadows = new Shadows(lamps.length);
    this.looked = lamps.map(() => new Vector4(NaN));
    const vectors = () => ({ value: lamps.map(() => new Vector4(0, 0, 0, 0)) });
    this.uniforms = { moved: { value: texture }, shadows: { value: this.shadows.target.texture }, lampAt: vectors(), lampPower: vectors(), lampCone: vectors() };
    const fine = manifest.lightmap;
    this.chartAt = new Int32Array(fine.width * fine.height);
    this.texelAt = new Int32Array(width * height).fill(-1);
    let texels = 0;
    for (let chart = 0; 8 * chart < charts.length; ++chart) {
      const [x, y, w, h, left, top, across, down] = charts.subarray(8 * chart, 8 * chart + 8) as unknown as number[] & { length: 8 };
      for (let row = y!; row < y! + h!; ++row) this.chartAt.fill(chart, row * fine.width + x!, row * fine.width + x! + w!);
      for (let j = -1; j <= down!; ++j)
        for (let i = -1; i <= across!; ++i) {
          const inside = [Math.min(across! - 1, Math.max(0, i)), Math.min(down! - 1, Math.max(0, j))] as const;
          this.texelAt[(top! + j) * width + left! + i] = texels + inside[1] * across! + inside[0];
        }
      texels += across! * down!;
    }
    this.sum = new Float32Array(3 * texels);
  }

  static async read(manifest: Manifest): Promise<Lamps | undefined> {
    if (!manifest.movable) return undefined;
    const bytes = async (name: string) => (await fetchWhole(name)).arrayBuffer();
    const lattices = await Promise.all(manifest.movable.lamps.map(async ({ lattice }) => new Lattice(lattice, new Uint8Array(await bytes(lattice.boxes)))));
    return new Lamps(manifest, lattices, new Uint16Array(await bytes(manifest.movable.charts)));
  }

  /** Where the vertices of a mesh lie in the lightmaps of lamps. */
  place(geometry: BufferGeometry): BufferAttribute {
    const fine = this.manifest.lightmap, { width, height } = this.manifest.movable!, from = geometry.getAttribute('uv1');
    const out = new Float32Array(2 * from.count);
    for (let i = 0; i < from.count; ++i) {
      const at = [from.getX(i) * fine.width, from.getY(i) * fine.height] as const;
      const chart = 8 * this.chartAt[Math.floor(at[1]) * fine.width + Math.floor(at[0])]!, c = this.charts.subarray(chart, chart + 8);
      for (const k of [0, 1] as const)
        out[2 * i + k] = (c[4 + k]! + 0.5 + (at[k] - c[k]! - 0.5) * (c[6 + k]! - 1) / (c[2 + k]! - 1)) / (k === 0 ? width : height);
    }
    return new BufferAttribute(out, 2);
  }

  load(lamp: Lamp): Promise<void> { return lamp.load(this.sum.length / 3); }

  /** Whether a light group is drawn here. */
  draws(group: string): boolean {
    return this.lamps.some(lamp => lamp.moved && lamp.data.group === group);
  }

  /** Takes places, factors and time: the indirect light of all lamps that are not at their places, and the uniforms. */
  update(time: number, scaleOf: (group: string) => Color | undefined): void {
    const { times } = this.manifest, [a, b, later] = posesAt(times, time), { sum } = this;
    sum.fill(0);
    this.lamps.forEach((lamp, i) => {
      const { data } = lamp, scale = lamp.moved ? scaleOf(data.group) ?? new Color(1, 1, 1) : new Color(0, 0, 0);
      const power = new Color().fromArray(data.power).multiply(scale);
      this.uniforms.lampPower.value[i]!.set(power.r, power.g, power.b, data.range);
      this.uniforms.lampAt.value[i]!.set(...lamp.at.toArray(), data.radius);
      if (data.spot) {  // a point, whose radius gives its place to what is added to the ramp
        const outer = Math.cos(data.spot.outer_cone), ramp = 1 / Math.max(0.001, Math.cos(data.spot.inner_cone) - outer);
        this.uniforms.lampCone.value[i]!.set(...data.spot.toward as [number, number, number], ramp);
        this.uniforms.lampAt.value[i]!.w = -outer * ramp;
      }
      if (!lamp.moved) return;
      for (const [place, weight] of lamp.lattice.shares(lamp.at))
        for (const [pose, share] of [[a, 1 - later], [b, later]] as const) if (weight * share > 0) this.add(lamp.light[pose]!, place, scale, weight * share);
    });
    this.upload();
  }

  private add(light: Uint16Array, place: number, scale: Color, weight: number): void {
    const { sum } = this, first = place * sum.length, factors = scale.toArray().map(x => x * weight);
    for (let c = 0; c < 3; ++c)
      for (let i = c, factor = factors[c]!; i < sum.length; i += 3) sum[i]! += factor * floatOf[light[first + i]!]!;
  }

  private upload(): void {
    const texture = this.uniforms.moved.value, texels = texture.image.data as Uint16Array, { sum } = this;
    this.texelAt.forEach((texel, p) => {
      if (texel >= 0) for (let c = 0; c < 3; ++c) texels[4 * p + c] = DataUtils.toHalfFloat(Math.min(65504, sum[3 * texel + c]!));
    });
    texture.needsUpdate = true;
  }

  /** Shadows of lamps that moved, or around which something did. */
  look(renderer: WebGLRenderer, scene: Scene, time: number, balls: Iterable<Mesh>): void {
    const all = [...balls];
    this.lamps.forEach((lamp, i) => {
      const now = new Vector4(...lamp.at.toArray(), time);
      if (!lamp.moved || this.looked[i]!.equals(now)) return;
      this.looked[i]!.copy(now);
      this.shadows.look(renderer, scene, i, lamp.at, all);
    });
  }
}
