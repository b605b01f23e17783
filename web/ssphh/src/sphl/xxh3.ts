/** XXH3 of 128 bits, seed 0, of more than 16 bytes: the checksum of binary probe files (xxHash's specification, version 0.2.0). */
import { multiplyHigh } from '../multiply.js';

const secret = Uint8Array.from(
  ('b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221b8084674f743248ee03590e6813a264c' +
    '3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364' +
    'eac5ac8334d3ebc3c581a0fffa1363eb170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e')
    .match(/../g)!
    .map(digits => parseInt(digits, 16)),
);
const secretView = new DataView(secret.buffer);
const prime32 = [0x9e3779b1n, 0x85ebca77n, 0xc2b2ae3dn] as const;
const prime64 = [0x9e3779b185ebca87n, 0xc2b2ae3d27d4eb4fn, 0x165667b19e3779f9n, 0x85ebca77c2b2ae63n, 0x27d4eb2f165667c5n] as const;
const word = (1n << 64n) - 1n;
const secretAt = (at: number) => secretView.getBigUint64(at, true);

function folded(a: bigint, b: bigint): bigint {
  const product = a * b;
  return (product & word) ^ (product >> 64n);
}
function avalanche(h: bigint): bigint {
  h ^= h >> 37n;
  h = (h * 0x165667919e3779f9n) & word;
  return h ^ (h >> 32n);
}

/** Of 17 to 240 bytes. */
function middle(data: DataView): [bigint, bigint] {
  const length = data.byteLength, at = (i: number) => data.getBigUint64(i, true);
  const mix = (i: number, s: number) => folded(at(i) ^ secretAt(s), at(i + 8) ^ secretAt(s + 8));
  let low = (BigInt(length) * prime64[0]) & word, high = 0n;
  const mixPair = (i: number, j: number, s: number) => {
    low = ((low + mix(i, s)) & word) ^ ((at(j) + at(j + 8)) & word);
    high = ((high + mix(j, s + 16)) & word) ^ ((at(i) + at(i + 8)) & word);
  };
  if (length <= 128) {
    for (let k = Math.ceil(length / 32) - 1; k >= 0; --k) mixPair(16 * k, length - 16 * (k + 1), 32 * k);
  } else {
    for (let i = 32; i < 160; i += 32) mixPair(i - 32, i - 16, i - 32);
    low = avalanche(low);
    high = avalanche(high);
    for (let i = 160; i <= length; i += 32) mixPair(i - 32, i - 16, 3 + i - 160);
    mixPair(length - 16, length - 32, 136 - 17 - 16);
  }
  const end = (low * prime64[0] + high * prime64[3] + BigInt(length) * prime64[1]) & word;
  return [-avalanche(end) & word, avalanche((low + high) & word)];
}

/** Eight sums of 64 bits, low half first. */
type Sums = Uint32Array;

function addStripe(sums: Sums, data: DataView, at: number, s: number): void {
  for (let i = 0; i < 16; i += 2) {
    const low = data.getUint32(at + 4 * i, true), high = data.getUint32(at + 4 * i + 4, true), other = i ^ 2;
    const keyLow = (low ^ secretView.getUint32(s + 4 * i, true)) >>> 0, keyHigh = (high ^ secretView.getUint32(s + 4 * i + 4, true)) >>> 0;
    add(sums, other, low, high);
    add(sums, i, Math.imul(keyLow, keyHigh) >>> 0, multiplyHigh(keyLow, keyHigh));
  }
}
function add(sums: Sums, i: number, low: number, high: number): void {
  const sum = sums[i]! + low;
  sums[i] = sum;
  sums[i + 1] = sums[i + 1]! + high + (sum > 0xffffffff ? 1 : 0);
}
function scramble(sums: Sums): void {
  const prime = Number(prime32[0]), s = secret.length - 64;
  for (let i = 0; i < 16; i += 2) {
    const high = (sums[i + 1]! ^ secretView.getUint32(s + 4 * i + 4, true)) >>> 0;
    const low = (sums[i]! ^ (sums[i + 1]! >>> 15) ^ secretView.getUint32(s + 4 * i, true)) >>> 0;
    sums[i] = Math.imul(low, prime);
    sums[i + 1] = Math.imul(high, prime) + multiplyHigh(low, prime);
  }
}

/** Of more than 240 bytes. */
function long(data: DataView): [bigint, bigint] {
  const length = data.byteLength, start = [prime32[2], prime64[0], prime64[1], prime64[2], prime64[3], prime32[1], prime64[4], prime32[0]];
  const sums = new Uint32Array(new BigUint64Array(start).buffer), stripes = Math.floor((length - 1) / 64);
  for (let i = 0; i < stripes; ++i) {
    addStripe(sums, data, 64 * i, 8 * (i % 16));
    if (i % 16 === 15) scramble(sums);
  }
  addStripe(sums, data, length - 64, secret.length - 64 - 7);
  const ends = new BigUint64Array(sums.buffer);
  const merged = (s: number, h: bigint) => {
    for (let i = 0; i < 4; ++i) h += folded(ends[2 * i]! ^ secretAt(s + 16 * i), ends[2 * i + 1]! ^ secretAt(s + 16 * i + 8));
    return avalanche(h & word);
  };
  const size = BigInt(length);
  return [merged(secret.length - 64 - 11, ~(size * prime64[1]) & word), merged(11, (size * prime64[0]) & word)];
}

/** High and low half. Error of type RangeError for 16 bytes or less. */
export function xxh3(bytes: Uint8Array): [bigint, bigint] {
  if (bytes.length <= 16) throw new RangeError('xxh3 of 16 bytes or less');
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return bytes.length <= 240 ? middle(data) : long(data);
}
