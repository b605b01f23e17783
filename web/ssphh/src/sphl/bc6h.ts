import type { Triple } from '../sh.js';

/** Of a mode: its number, bits of an end, bits of the differences of red, green and blue that stand for ends 1 to 3 (0: they stand themselves), and the
 *  bits behind the number: rw, rx, ry, rz are red of ends 0 to 3, digits the bits of it. Three letters of ends and more than x: two lines of colours. */
type Mode = readonly [number: number, endBits: number, delta: readonly [number, number, number], bits: string];
/** The table of the Khronos Data Format Specification 1.3, §20.2. */
const modes: readonly Mode[] = [
  [0x00, 10, [5, 5, 5], 'gy4 by4 bz4 rw0-9 gw0-9 bw0-9 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 bz3'],
  [0x01, 7, [6, 6, 6], 'gy5 gz4 gz5 rw0-6 bz0 bz1 by4 gw0-6 by5 bz2 gy4 bw0-6 bz3 bz5 bz4 rx0-5 gy0-3 gx0-5 gz0-3 bx0-5 by0-3 ry0-5 rz0-5'],
  [0x02, 11, [5, 4, 4], 'rw0-9 gw0-9 bw0-9 rx0-4 rw10 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-4 bz2 rz0-4 bz3'],
  [0x06, 11, [4, 5, 4], 'rw0-9 gw0-9 bw0-9 rx0-3 rw10 gz4 gy0-3 gx0-4 gw10 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-3 bz0 bz2 rz0-3 gy4 bz3'],
  [0x0a, 11, [4, 4, 5], 'rw0-9 gw0-9 bw0-9 rx0-3 rw10 by4 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-4 bw10 by0-3 ry0-3 bz1 bz2 rz0-3 bz4 bz3'],
  [0x0e, 9, [5, 5, 5], 'rw0-8 by4 gw0-8 gy4 bw0-8 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 bz3'],
  [0x12, 8, [6, 5, 5], 'rw0-7 gz4 by4 gw0-7 bz2 gy4 bw0-7 bz3 bz4 rx0-5 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-5 rz0-5'],
  [0x16, 8, [5, 6, 5], 'rw0-7 bz0 by4 gw0-7 gy5 gy4 bw0-7 gz5 bz4 rx0-4 gz4 gy0-3 gx0-5 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 bz3'],
  [0x1a, 8, [5, 5, 6], 'rw0-7 bz1 by4 gw0-7 by5 gy4 bw0-7 bz5 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-5 by0-3 ry0-4 bz2 rz0-4 bz3'],
  [0x1e, 6, [0, 0, 0], 'rw0-5 gz4 bz0 bz1 by4 gw0-5 gy5 by5 bz2 gy4 bw0-5 gz5 bz3 bz5 bz4 rx0-5 gy0-3 gx0-5 gz0-3 bx0-5 by0-3 ry0-5 rz0-5'],
  [0x03, 10, [0, 0, 0], 'rw0-9 gw0-9 bw0-9 rx0-9 gx0-9 bx0-9'],
  [0x07, 11, [9, 9, 9], 'rw0-9 gw0-9 bw0-9 rx0-8 rw10 gx0-8 gw10 bx0-8 bw10'],
  [0x0b, 12, [8, 8, 8], 'rw0-9 gw0-9 bw0-9 rx0-7 rw11-10 gx0-7 gw11-10 bx0-7 bw11-10'],
  [0x0f, 16, [4, 4, 4], 'rw0-9 gw0-9 bw0-9 rx0-3 rw15-10 gx0-3 gw15-10 bx0-3 bw15-10'],
];
/** Texels of the second of two lines, texel 0 the lowest bit; and the texel of it whose index has no highest bit. */
const shapes = [
  0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80, 0xe800, 0xffe8, 0xff00, 0xfff0, 0xf000,
  0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310, 0x3100, 0x8cce, 0x088c, 0x3110, 0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c,
];
const anchors = [15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 2, 8, 2, 2, 8, 8, 15, 2, 8, 2, 2, 8, 8, 2, 2];
const weightsOfOne = [0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64];
const weightsOfTwo = [0, 9, 18, 27, 37, 46, 55, 64];

function unquantized(end: number, bits: number): number {
  if (bits >= 15 || end === 0) return end;
  return end === (1 << bits) - 1 ? 0xffff : ((end << 16) + 0x8000) >> bits;
}

/** Calls `place` with each bit's end, channel and place in it. */
function forBits(text: string, place: (end: number, channel: number, bit: number) => void): void {
  for (const word of text.split(' ')) {
    const [first, last = first] = word.slice(2).split('-').map(Number) as [number, number?];
    const step = last < first ? -1 : 1;
    for (let bit = first; bit !== last + step; bit += step) place('wxyz'.indexOf(word[1]!), 'rgb'.indexOf(word[0]!), bit);
  }
}

/** Bits of half floats of a block's sixteen colours (BC6H_UF16), row by row; of reserved modes 0. */
export function bitsOfBc6h(block: Uint8Array): Triple[] {
  let at = 0;
  const get = (count: number): number => {
    let value = 0;
    for (let i = 0; i < count; ++i, ++at) value |= ((block[at >> 3]! >> (at & 7)) & 1) << i;
    return value;
  };
  let number = get(2);
  if (number > 1) number |= get(3) << 2;
  const mode = modes.find(m => m[0] === number);
  if (!mode) return Array.from({ length: 16 }, () => [0, 0, 0]);

  const [, endBits, delta, layout] = mode, two = layout.includes('z');
  const ends = [0, 1, 2, 3].map(() => [0, 0, 0]);
  forBits(layout, (end, channel, bit) => (ends[end]![channel]! |= get(1) << bit));
  for (let end = 1; end < 4; ++end)
    for (let c = 0; c < 3; ++c) {
      const sign = (1 << delta[c]!) >> 1;
      if (delta[c]) ends[end]![c] = (ends[0]![c]! + (ends[end]![c]! ^ sign) - sign) & ((1 << endBits) - 1);
    }
  const shape = two ? get(5) : 0, weights = two ? weightsOfTwo : weightsOfOne;
  return Array.from({ length: 16 }, (_, i) => {
    const line = two ? (shapes[shape]! >> i) & 1 : 0, isAnchor = i === (line ? anchors[shape] : 0);
    const weight = weights[get((two ? 3 : 4) - (isAnchor ? 1 : 0))]!;
    return [0, 1, 2].map(c => {
      const a = unquantized(ends[2 * line]![c]!, endBits), b = unquantized(ends[2 * line + 1]![c]!, endBits);
      return (((a * (64 - weight) + b * weight + 32) >> 6) * 31) >> 6;
    });
  });
}
