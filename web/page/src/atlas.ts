import { DataArrayTexture, LinearFilter, RGBFormat, UnsignedInt5999Type } from 'three';
import { Failure, fetchWhole, type Manifest } from './manifest';

/** A half float of 15 bits (no sign) as mantissa · 2^exponent. */
function parts(half: number): [number, number] {
  const exponent = half >> 10 & 31, mantissa = half & 1023;
  return exponent === 0 ? [mantissa, -24] : [mantissa | 1024, exponent - 25];
}

/** Three halves as RGB9E5: nine bits each under the exponent of the largest (OpenGL ES 3.0, 3.8.3.2). */
function sharedExponent(r: number, g: number, b: number): number {
  const [m, e] = parts(Math.max(r, g, b));
  if (m === 0) return 0;
  let shared = Math.max(-16, e + 31 - Math.clz32(m)) + 1;
  if (Math.round(m * 2 ** (e - shared + 9)) === 512 && shared < 16) ++shared;
  const nine = (half: number) => {
    const [mantissa, exponent] = parts(half);
    return Math.min(511, Math.round(mantissa * 2 ** (exponent - shared + 9)));
  };
  return (shared + 15 << 27 | nine(b) << 18 | nine(g) << 9 | nine(r)) >>> 0;
}

/** The reverse of report::pack_half: planes of low and high bytes of differences to the left, red and blue to green. */
function unpack(planes: Uint8Array, width: number, height: number, take: (pixel: number, r: number, g: number, b: number) => void): void {
  const count = 3 * width * height, pixels = width * height, row = new Uint16Array(3 * width);
  const value = (c: number, p: number) => planes[c * pixels + p]! | planes[count + c * pixels + p]! << 8;
  for (let y = 0, p = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x, ++p) {
      const before = x > 0 ? 3 * (x - 1) : 0;  // of the first in a row: the one above
      for (let c = 0; c < 3; ++c) row[3 * x + c] = value(c, p) + (p > 0 ? row[before + c]! : 0);
      const g = row[3 * x + 1]!;
      take(p, row[3 * x]! + g & 0x7fff, g & 0x7fff, row[3 * x + 2]! + g & 0x7fff);
    }
  }
}

async function readPacked(name: string, width: number, height: number, take: (pixel: number, r: number, g: number, b: number) => void): Promise<void> {
  const packed = (await fetchWhole(name)).body!.pipeThrough(new DecompressionStream('deflate'));
  const planes = new Uint8Array(await new Response(packed).arrayBuffer());
  if (planes.length !== 6 * width * height) throw new Failure(`${name} is broken: it holds ${planes.length} bytes`);
  unpack(planes, width, height, take);
}

/** The halves of a packed picture, three a pixel. */
export async function readHalves(name: string, width: number, height: number): Promise<Uint16Array> {
  const out = new Uint16Array(3 * width * height);
  await readPacked(name, width, height, (p, r, g, b) => { out[3 * p] = r, out[3 * p + 1] = g, out[3 * p + 2] = b; });
  return out;
}

/** Lightmaps as layers of one texture: that of group g at pose k is layer g · poses + k. */
export async function readAtlas(manifest: Manifest, progress: (share: number) => void): Promise<DataArrayTexture> {
  const { width, height, groups } = manifest.lightmap, names = groups.flatMap(group => group.textures);
  const texels = new Uint32Array(width * height * names.length);
  let done = 0;
  for (const [i, name] of names.entries()) {
    const first = i * width * height;
    await readPacked(name, width, height, (p, r, g, b) => { texels[first + p] = sharedExponent(r, g, b); });
    progress(++done / names.length);
  }
  const texture = new DataArrayTexture(texels, width, height, names.length);
  texture.format = RGBFormat;
  texture.type = UnsignedInt5999Type;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}
