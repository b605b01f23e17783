import { multiplyHigh } from '../multiply.js';
import { checksumAt } from './layout.js';

const factorHigh = 0x9e3779b9, factorLow = 0x7f4a7c15;

/** The checksum of a file of a multiple of 8 bytes, low and high half; its own eight bytes count as zeros. */
export function checksum(bytes: Uint8Array): [number, number] {
  const words = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
  const low = [0, 1, 2, 3], high = [0, 0, 0, 0];
  const add = (lane: number, wordLow: number, wordHigh: number) => {
    const l = low[lane]! ^ wordLow, h = high[lane]! ^ wordHigh;
    const up = (multiplyHigh(l, factorLow) + Math.imul(l, factorHigh) + Math.imul(h, factorLow)) | 0;
    low[lane] = Math.imul(l, factorLow) ^ up;
    high[lane] = up;
  };
  const whole = words.length - (words.length % 8);
  for (let i = 0; i < words.length; i += 2) {
    const own = i === checksumAt / 4;
    add(i < whole ? (i / 2) % 4 : 0, own ? 0 : words[i]!, own ? 0 : words[i + 1]!);
  }
  for (let lane = 1; lane < 4; ++lane) add(0, low[lane]!, high[lane]!);
  add(0, bytes.byteLength | 0, Math.floor(bytes.byteLength / 2 ** 32));
  return [low[0]! >>> 0, high[0]! >>> 0];
}
