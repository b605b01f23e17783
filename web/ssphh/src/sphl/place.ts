import { SsphhError } from '../errors.js';

/** A place in a JSON document, whose error messages say where it is. */
export class Place {
  constructor(
    readonly value: unknown,
    readonly path: string,
  ) {}

  fail(problem: string): never {
    throw new SsphhError('invalid', `${this.path}: ${problem}`);
  }
  /** An object with all of `needed`, perhaps some of `further`, and nothing else. */
  members(needed: readonly string[], further: readonly string[] = []): this {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('must be an object');
    for (const key of Object.keys(this.value)) if (!needed.includes(key) && !further.includes(key)) this.fail(`has an unknown member "${key}"`);
    for (const key of needed) if (!Object.hasOwn(this.value, key)) this.fail(`lacks the member "${key}"`);
    return this;
  }
  has(key: string): boolean {
    return Object.hasOwn(this.value as object, key);
  }
  at(key: string): Place {
    return new Place((this.value as Record<string, unknown>)[key], `${this.path}.${key}`);
  }
  /** The elements of an array of so many. */
  list(most: number, least = 0): Place[] {
    if (!Array.isArray(this.value)) this.fail('must be an array');
    if (this.value.length < least || this.value.length > most)
      this.fail(least === most ? `must have ${least} elements, not ${this.value.length}` : `must have at most ${most} elements, not ${this.value.length}`);
    return this.value.map((v, i) => new Place(v, `${this.path}[${i}]`));
  }
  number(low: number, high: number): number {
    const v = this.value;
    if (typeof v !== 'number' || !(v >= low && v <= high)) this.fail(`must be a number from ${low} to ${high}`);
    return v;
  }
  integer(low: number, high: number): number {
    const v = this.number(low, high);
    return Number.isInteger(v) ? v : this.fail('must be a whole number');
  }
  text(mostBytes: number): string {
    const v = this.value;
    if (typeof v !== 'string') this.fail('must be a text');
    let bytes = 0;
    for (const c of v) bytes += c < '\x80' ? 1 : c < '\u0800' ? 2 : c.length === 2 ? 4 : 3;
    return bytes <= mostBytes ? v : this.fail(`must have at most ${mostBytes} bytes`);
  }
  matching(pattern: RegExp): string {
    return typeof this.value === 'string' && pattern.test(this.value) ? this.value : this.fail(`must be a text like ${pattern.source}`);
  }
  named<T extends string>(names: readonly T[]): T {
    return names.find(name => name === this.value) ?? this.fail(`must be one of ${names.join(', ')}`);
  }
  three(limit: number, low = -limit): [number, number, number] {
    return this.list(3, 3).map(p => p.number(low, limit)) as [number, number, number];
  }
  floats(count: number, limit: number): Float32Array {
    if (!Array.isArray(this.value) || this.value.length !== count) this.fail(`must be ${count} numbers`);
    const bad = this.value.findIndex(v => typeof v !== 'number' || !(Math.abs(v) <= limit));
    if (bad >= 0) this.fail(`element ${bad} must be a number of magnitude at most ${limit}`);
    return Float32Array.from(this.value as number[]);
  }
}
