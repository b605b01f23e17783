import { Color, Vector4, type DataArrayTexture, type IUniform } from 'three';
import type { Lamps } from './lamps';
import type { Manifest } from './manifest';

/** The two poses that a time lies between, and the later one's share. */
export function posesAt(times: number[], time: number): [number, number, number] {
  const last = times.length - 1;
  let k = 0;
  while (k < last - 1 && times[k + 1]! <= time) ++k;
  if (last < 1) return [0, 0, 0];
  const share = (time - times[k]!) / (times[k + 1]! - times[k]!);
  return [k, k + 1, Math.min(1, Math.max(0, share))];
}

const black = new Color(0, 0, 0);

/** What lamps and poses are now, as the shaders take it: E = Σ weight · layer. */
export class Light {
  readonly scales: Color[];
  /** Of each group at two poses: red, green, blue, and the layer. */
  readonly layers: IUniform<Vector4[]>;
  readonly atlas: IUniform<DataArrayTexture>;

  constructor(private readonly manifest: Manifest, atlas: DataArrayTexture, readonly lamps: Lamps | undefined) {
    const { groups } = manifest.lightmap;
    this.scales = groups.map(() => new Color(1, 1, 1));
    this.atlas = { value: atlas };
    this.layers = { value: Array.from({ length: 2 * groups.length }, () => new Vector4()) };
    this.update(manifest.time);
  }

  /** The factor on emitters of a light group. */
  scaleOf(lightGroup: string | undefined): Color | undefined {
    return this.scales[this.manifest.lightmap.groups.findIndex(g => g.light_groups.includes(lightGroup ?? ''))];
  }

  update(time: number): void {
    const { times, lightmap } = this.manifest, [a, b, share] = posesAt(times, time);
    const weights: [number, number][] = [[a, 1 - share], [b, share]];
    this.lamps?.update(time, group => this.scaleOf(group));
    lightmap.groups.forEach(({ name }, g) => {
      const { r, g: green, b: blue } = this.lamps?.draws(name) ? black : this.scales[g]!;
      weights.forEach(([pose, w], k) =>
        this.layers.value[2 * g + k]!.set(w * r, w * green, w * blue, g * times.length + pose));
    });
  }
}
