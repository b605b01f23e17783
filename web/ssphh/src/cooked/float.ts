/** Arithmetic of float32, in the order of libs/runtime's, so that choices fall as there and light has the same bits. */

export type Float3 = Float32Array;
const f = Math.fround;

export function dot(a: Float3, b: Float3): number {
  return f(f(f(a[0]! * b[0]!) + f(a[1]! * b[1]!)) + f(a[2]! * b[2]!));
}
/** The same of single numbers, which are float32. */
export function dot3(ax: number, ay: number, az: number, bx: number, by: number, bz: number): number {
  return f(f(f(ax * bx) + f(ay * by)) + f(az * bz));
}
export function clamp(v: number, low: number, high: number): number {
  return v < low ? low : v > high ? high : v;
}
export function bitCount(v: number): number {
  v -= (v >>> 1) & 0x55555555;
  v = (v & 0x33333333) + ((v >>> 2) & 0x33333333);
  return Math.imul((v + (v >>> 4)) & 0x0f0f0f0f, 0x01010101) >>> 24;
}
