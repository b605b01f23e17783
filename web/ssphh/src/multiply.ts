/** The high 32 bits of the product of two unsigned 32-bit numbers; `Math.imul` has the low ones. */
export function multiplyHigh(p: number, q: number): number {
  const a = p >>> 16, b = p & 0xffff, c = q >>> 16, d = q & 0xffff;
  const middle = a * d + ((b * d) >>> 16), other = b * c + (middle & 0xffff);
  return (a * c + (middle >>> 16) + (other >>> 16)) >>> 0;
}
