import { utf8 } from '../bytes.js';
import { SsphhError } from '../errors.js';
import { coefficientCount } from '../sh.js';
import { packedBytes, unpack, type Packing } from './packing.js';
import type { Coefficients } from './types.js';

/** Reads little-endian numbers one after another, each within limits; sizes are looked at before memory is taken. */
export class Reader {
  #at = 0;
  readonly #view: DataView;
  constructor(readonly bytes: Uint8Array) {
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get left(): number {
    return this.bytes.length - this.#at;
  }
  fail(what: string, problem: string): never {
    throw new SsphhError('invalid', `probe file, byte ${this.#at}: ${what} ${problem}`);
  }
  #take(size: number, what: string): number {
    if (size > this.left) this.fail(what, 'is cut off');
    this.#at += size;
    return this.#at - size;
  }
  #within(value: number, what: string, low: number, high: number): number {
    if (!(value >= low && value <= high)) this.fail(what, `must be from ${low} to ${high}, not ${value}`);
    return value;
  }

  u8(what: string, high: number, low = 0): number {
    return this.#within(this.#view.getUint8(this.#take(1, what)), what, low, high);
  }
  i16(what: string, high: number): number {
    return this.#within(this.#view.getInt16(this.#take(2, what), true), what, -high, high);
  }
  u32(what: string, high: number, low = 0): number {
    return this.#within(this.#view.getUint32(this.#take(4, what), true), what, low, high);
  }
  i32(what: string, low: number, high: number): number {
    return this.#within(this.#view.getInt32(this.#take(4, what), true), what, low, high);
  }
  f32(what: string, low: number, high: number): number {
    return this.#within(this.#view.getFloat32(this.#take(4, what), true), what, low, high);
  }
  u64(what: string): bigint {
    return this.#view.getBigUint64(this.#take(8, what), true);
  }
  hash(what: string): string {
    return [this.u64(what), this.u64(what)].map(half => half.toString(16).padStart(16, '0')).join('');
  }
  three(what: string, limit: number, low = -limit): [number, number, number] {
    return [this.f32(what, low, limit), this.f32(what, low, limit), this.f32(what, low, limit)];
  }
  floats(what: string, count: number, limit: number): Float32Array {
    const begin = this.#take(4 * count, what), out = new Float32Array(count);
    for (let i = 0; i < count; ++i) out[i] = this.#view.getFloat32(begin + 4 * i, true);
    if (!out.every(v => Math.abs(v) <= limit)) this.fail(what, 'holds a number out of range');
    return out;
  }
  /** A function on the sphere as `packing` has it. */
  light(what: string, packing: Packing, degree: number, limit: number): Coefficients {
    if (packing === 'none') return this.floats(what, 3 * coefficientCount(degree), limit);
    const size = packedBytes(packing, degree), begin = this.#take(size, what), out = unpack(this.bytes.subarray(begin, begin + size), packing, degree);
    return out.every(v => Math.abs(v) <= limit) ? out : this.fail(what, 'holds a number out of range');
  }
  text(what: string, limit: number): string {
    const size = this.u32(what, limit), begin = this.#take(size, what);
    return utf8(this.bytes.subarray(begin, begin + size)) ?? this.fail(what, 'is no UTF-8');
  }
  name<T extends string>(what: string, of: readonly T[]): T {
    return of[this.u8(what, of.length - 1)]!;
  }
  /** A count of things that take at least so many bytes each. */
  count(what: string, limit: number, bytesEach: number): number {
    const n = this.u32(what, limit);
    if (n * bytesEach > this.left) this.fail(what, `of ${n} needs more bytes than the file has`);
    return n;
  }
  skip(what: string, size: number): void {
    this.#take(size, what);
  }
  end(): void {
    if (this.left > 0) this.fail('the end', `is expected: ${this.left} bytes follow`);
  }
}
