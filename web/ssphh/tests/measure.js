// How long a lookup takes here and in C, in turns: SSPHH_TOOL=… SSPHH_LOOK_UP=… node tests/measure.js FILE.sphlc... (of files with points).
// Processor time in microseconds for a place, the least of five times 20,000 places on surfaces; C's by its own clock().
import { execFileSync } from 'node:child_process';
import { openCookedSync } from 'ssphh';
import { bytesOf, randomNumbers } from './fixtures.js';

const count = 20000;
const microseconds = of => {
  const begin = process.cpuUsage().user;
  of();
  return process.cpuUsage().user - begin;
};

for (const path of process.argv.slice(2)) {
  const bytes = bytesOf(path), opened = Math.min(...[1, 2, 3, 4, 5].map(() => microseconds(() => openCookedSync(bytes))));
  const light = openCookedSync(bytes), { points, header } = light.file, random = randomNumbers(1), places = new Float32Array(6 * count);
  for (let i = 0; i < count; ++i) {
    const p = 8 * Math.floor(random() * header.pointCount);
    for (let c = 0; c < 3; ++c) {
      places[6 * i + c] = points[p + c] + 0.1 * points[p + 3] * (random() - 0.5);
      places[6 * i + 3 + c] = points[p + 4 + c];
    }
  }
  const columns = first => Float32Array.from({ length: 3 * count }, (_, i) => places[6 * Math.floor(i / 3) + first + (i % 3)]);
  const positions = columns(0), normals = columns(3), out = new Float32Array(3 * count);
  for (const kind of ['still', 'open']) {
    let ours = Infinity, theirs = Infinity;
    for (let turn = 0; turn < 5; ++turn) {
      ours = Math.min(ours, microseconds(() => light.irradianceBatch(positions, normals, out, kind)) / count);
      const said = execFileSync('sh', ['-c', '"$0" "$1" "$2" 2>&1 >/dev/null', process.env.SSPHH_LOOK_UP, path, kind], { input: Buffer.from(places.buffer), encoding: 'utf8' });
      theirs = Math.min(theirs, Number(said));
    }
    console.log(`${path.replace(/.*\//, '')}, ${bytes.byteLength} bytes, opened in ${(opened / 1000).toFixed(1)} ms; ${kind}: ${ours.toFixed(2)} µs, in C ${theirs.toFixed(2)} µs`);
  }
}
