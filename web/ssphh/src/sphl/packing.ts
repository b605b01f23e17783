import { coefficientCount, shBasis, type Triple } from '../sh.js';
import { bitsOfBc6h } from './bc6h.js';
import { radianceFromMap } from './irradiance_map.js';
import type { Coefficients } from './types.js';

/** How a probe file holds light; docs/compact-probes.md of ssphh has the layouts. */
export type Packing = 'none' | 'half' | 'rgb9e5' | 'zh3' | 'bc6h';
/** In the order of the file's numbers. */
export const packings: readonly Packing[] = ['none', 'half', 'rgb9e5', 'zh3', 'bc6h'];

/** Whether it carries functions of that degree. */
export function packs(packing: Packing, degree: number): boolean {
  return packing === 'zh3' ? degree === 2 : packing !== 'bc6h' || degree === 2 || degree === 4;
}

export function packedBytes(packing: Packing, degree: number): number {
  const k = coefficientCount(degree);
  return { none: 12 * k, half: 1 + 6 * k, rgb9e5: 4 + 3 * (k - 1), zh3: 16, bc6h: degree <= 2 ? 17 : 65 }[packing];
}

function fromHalf(bits: number): number {
  const magnitude = bits & 0x7fff, exponent = magnitude >> 10, mantissa = magnitude & 0x3ff;
  if (exponent === 31) return NaN;
  const value = exponent === 0 ? mantissa * 2 ** -24 : (1024 + mantissa) * 2 ** (exponent - 25);
  return bits & 0x8000 ? -value : value;
}

/** Three mantissas of 9 bits, red lowest, and an exponent of 5. */
function fromRgb9e5(word: number): Triple {
  const unit = 2 ** ((word >>> 27) - 24);
  return [unit * (word & 0x1ff), unit * ((word >>> 9) & 0x1ff), unit * ((word >>> 18) & 0x1ff)];
}

/** Bytes in shares of the most that a coefficient of band l has where no light is negative: √(2l+1) of coefficient 0. */
const share = (byte: number, mean: number, l: number) => (byte / 127) * Math.sqrt(2 * l + 1) * mean;

function unpackHalf(view: DataView, out: Float32Array): void {
  const unit = 2 ** view.getInt8(0);
  for (let i = 0; i < out.length; ++i) out[i] = unit * fromHalf(view.getUint16(1 + 2 * i, true));
}

/** Coefficients 0 to `last`. */
function unpackShares(view: DataView, out: Float32Array, last: number): void {
  const mean = fromRgb9e5(view.getUint32(0, true));
  out.set(mean);
  for (let k = 1; k <= last; ++k)
    for (let c = 0; c < 3; ++c) out[3 * k + c] = share(view.getInt8(1 + 3 * k + c), mean[c]!, Math.floor(Math.sqrt(k)));
}

/** Band 2 is one lobe about the axis of band 1 of the luminance. */
function unpackZh3(view: DataView, out: Float32Array): void {
  unpackShares(view, out, 3);
  const linear = (k: number) => 0.2126 * out[3 * k]! + 0.7152 * out[3 * k + 1]! + 0.0722 * out[3 * k + 2]!;
  const axis = [linear(3), linear(1), linear(2)] as const, length = Math.hypot(...axis);
  if (!(length > 0)) return;
  const basis = shBasis(2, axis.map(v => v / length));
  for (let k = 4; k < 9; ++k)
    for (let c = 0; c < 3; ++c) out[3 * k + c] = Math.sqrt((4 * Math.PI) / 5) * basis[k]! * share(view.getInt8(13 + c), out[c]!, 2);
}

const rowsOfMap = new Map<number, Float64Array[]>();

/** Irradiance, raised by half its mean, as an octahedral map: 4×4 texels in one block, or 8×8 in four. */
function unpackBc6h(view: DataView, out: Float32Array, degree: number): void {
  const side = degree === 2 ? 4 : 8, unit = 2 ** view.getInt8(0), blocks = side / 4, texels: number[][] = [];
  for (let block = 0; block < blocks * blocks; ++block)
    bitsOfBc6h(new Uint8Array(view.buffer, view.byteOffset + 1 + 16 * block, 16)).forEach((bits, i) => {
      const row = 4 * Math.floor(block / blocks) + (i >> 2), column = 4 * (block % blocks) + (i & 3);
      texels[row * side + column] = Array.from(bits, b => unit * fromHalf(b));
    });
  const rows = rowsOfMap.get(degree) ?? radianceFromMap(side, degree);
  rowsOfMap.set(degree, rows);
  rows.forEach((row, k) => {
    for (let c = 0; c < 3; ++c) out[3 * k + c] = row.reduce((sum, share, t) => sum + share * texels[t]![c]!, 0) / (k === 0 ? 1.5 : 1);
  });
}

/** The function behind `packedBytes` of a file. */
export function unpack(bytes: Uint8Array, packing: Exclude<Packing, 'none'>, degree: number): Coefficients {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), out = new Float32Array(3 * coefficientCount(degree));
  if (packing === 'half') unpackHalf(view, out);
  else if (packing === 'rgb9e5') unpackShares(view, out, coefficientCount(degree) - 1);
  else if (packing === 'zh3') unpackZh3(view, out);
  else unpackBc6h(view, out, degree);
  return out;
}
