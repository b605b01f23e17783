import { viewOf, type Bytes } from '../bytes.js';
import { SsphhError } from '../errors.js';
import type { Triple } from '../sh.js';
import { coefficientCount } from '../sh.js';
import { magic, readBinary } from './binary.js';
import { readJson } from './json.js';
import type { Coefficients, ProbeSet } from './types.js';

/**
 * Reads a probe file (`ssphh bake -o FILE.sphl` or `FILE.sphl.json`, version 7, or 8 with packed light), binary or JSON. Errors: `not-sphl`, `bad-version`,
 * `cut-off`, `damaged` (binary: its XXH3 is wrong), `invalid` (with the place and what must stand there).
 */
export function readSphl(bytes: Bytes): ProbeSet {
  const view = viewOf(bytes);
  if (magic.every((b, i) => view[i] === b)) return readBinary(view);
  const first = view.find(b => b !== 0x20 && b !== 0x0a && b !== 0x0d && b !== 0x09);
  if (first === 0x7b) return readJson(view);
  throw new SsphhError('not-sphl', 'this is no probe file: ssphh bake makes them');
}

/**
 * Radiance that arrives at a probe, all light groups at their scales (`scales`: RGB of each group in place of the file's): `all` of it, what
 * surfaces have `reflected` (indirect light), or what is `emitted` straight towards it.
 */
export function probeRadiance(set: ProbeSet, probe: number, part: 'all' | 'reflected' | 'emitted' = 'all', scales?: readonly Triple[]): Coefficients {
  const from = set.probes[probe];
  if (!from) throw new SsphhError('bad-argument', `there is no probe ${probe}; there are ${set.probes.length}`);
  if (scales && scales.length !== set.lightGroups.length)
    throw new SsphhError('bad-argument', `a scale for each of the ${set.lightGroups.length} light groups is needed`);
  const sum = new Float64Array(3 * coefficientCount(set.degree));
  from.groups.forEach(({ emitted, reflected }, g) => {
    const scale = scales?.[g] ?? set.lightGroups[g]!.scale;
    for (const light of [part === 'emitted' ? null : reflected, part === 'reflected' ? null : emitted])
      if (light) for (let i = 0; i < sum.length; ++i) sum[i] = sum[i]! + scale[i % 3]! * light[i]!;
  });
  return Float32Array.from(sum);
}

/** The tangents x and y of surface records at a unit normal (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017). */
export function tangentsOf(normal: Triple): { x: [number, number, number]; y: [number, number, number] } {
  const nx = normal[0]!, ny = normal[1]!, nz = normal[2]!, sign = nz < 0 ? -1 : 1, a = -1 / (sign + nz), b = nx * ny * a;
  return { x: [1 + sign * nx * nx * a, sign * b, -sign * nx], y: [b, sign + ny * ny * a, -ny] };
}
