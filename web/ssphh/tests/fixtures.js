// Files that the tool makes once for all tests, and what the C run-time says of them. The programs' paths come from tests/run.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, renameSync } from 'node:fs';

const tool = process.env.SSPHH_TOOL, lookUp = process.env.SSPHH_LOOK_UP;
assert(tool && lookUp, 'run tests/run TOOL LOOK_UP FOLDER');
const folder = new URL('../../fixtures/', import.meta.url).pathname;

/** And metres of a surfel in them, coarse: what is compared is one file's light in two languages. */
const surfelSizes = { cornell: '0.5', 'two-rooms': '1', 'random?seed=7': '4' };
export const scenes = Object.keys(surfelSizes);
export const kinds = { points: ['--records', '200'], weights: ['--records', '0', '--fit'] };

export function run(...words) {
  return execFileSync(tool, [...words, '--progress', 'none'], { encoding: 'utf8', stdio: 'pipe' });
}

export function made(name, make) {
  mkdirSync(folder, { recursive: true });
  const path = folder + name, dot = name.indexOf('.'), part = `${folder}${name.slice(0, dot)}-${process.pid}${name.slice(dot)}`;
  if (!existsSync(path)) {
    make(part);
    renameSync(part, path);
  }
  return path;
}

/** Path of a probe file; `extra` are options of the bake. */
export function probeFile(scene, kind, extra = [], end = '.sphl') {
  return made(`${scene.replace(/\W+/g, '-')}-${kind}${extra.join('').replace(/\W+/g, '-')}${end}`, path =>
    run('bake', `builtin:${scene}`, '-o', path, '--operator', 'surfel', '--viz', 'off', '--quality', 'draft', '--probes', '12', ...kinds[kind],
      '--surfel-size', surfelSizes[scene], ...extra));
}

export function cookedFile(scene, kind, extra = [], cookOptions = ['--scene', `builtin:${scene}`, '--sight', '16']) {
  const probes = probeFile(scene, kind, extra);
  return made(probes.slice(folder.length).replace('.sphl', `${cookOptions.length > 0 ? '' : '-bare'}.sphlc`), path =>
    run('cook', probes, '-o', path, '--points', '0', ...cookOptions));
}

export const bytesOf = path => {
  const bytes = readFileSync(path);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
};

/** Irradiance by the C run-time, and microseconds of processor time for a place. */
export function referenceLight(path, kind, positions, normals, scales = []) {
  const places = new Float32Array(2 * positions.length);
  for (let i = 0; i < positions.length; ++i) {
    const at = 6 * Math.floor(i / 3) + (i % 3);
    places[at] = positions[i];
    places[at + 3] = normals[i];
  }
  const out = execFileSync(lookUp, [path, kind, ...scales.map(String)], { input: Buffer.from(places.buffer), maxBuffer: 1 << 28, stdio: ['pipe', 'pipe', 'ignore'] });
  return new Float32Array(out.buffer.slice(out.byteOffset, out.byteOffset + out.length));
}

/** Results of ssphh_runtime_open with single bytes changed, as error codes. */
export function referenceVerdicts(path, changes) {
  const codes = ['ok', 'bad-argument', 'bad-memory', 'not-cooked', 'bad-version', 'cut-off', 'damaged', 'invalid'];
  const out = execFileSync(lookUp, [path, 'verdicts'], { input: changes.map(c => c.join(' ')).join('\n'), encoding: 'utf8' });
  return out.trim().split('\n').map(n => codes[Number(n)]);
}

/** Numbers from 0 to 1, the same each time. */
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const mixed = Math.imul(state ^ (state >>> 15), 0x2c1b3c6d);
    return ((mixed ^ (mixed >>> 13)) >>> 0) / 2 ** 32;
  };
}

export function randomUnit(random) {
  const z = 2 * random() - 1, angle = 2 * Math.PI * random(), r = Math.sqrt(1 - z * z);
  return [r * Math.cos(angle), r * Math.sin(angle), z];
}

/** Places near the surfaces that a cooked file has points of, exactly on them at first, then all through its box. */
export function somePlaces(light, count, seed) {
  const random = randomNumbers(seed), { points, header } = light.file, positions = [], normals = [];
  for (let i = 0; i < count; ++i) {
    const inBox = header.pointCount === 0 || i % 3 === 2, p = 8 * Math.floor(random() * header.pointCount);
    const side = header.probeCells.map(n => n * header.probeCellSize);
    const shift = i % 3 === 0 ? 0 : 0.7 * points[p + 3];
    for (let c = 0; c < 3; ++c) positions.push(inBox ? header.probeOrigin[c] + (1.2 * random() - 0.1) * side[c] : points[p + c] + shift * (random() - 0.5));
    normals.push(...(inBox || i % 7 === 0 ? randomUnit(random) : points.subarray(p + 4, p + 7)));
  }
  return { positions: Float32Array.from(positions), normals: Float32Array.from(normals) };
}
