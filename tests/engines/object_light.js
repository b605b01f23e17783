// What the pages of engines that light an object by nine colours share: spheres on which each normal is once,
// and the E/π that they should show, from the grid that was written for three.js.
import { lightAt } from './light_at.js';

export const columns = 5, rows = 2, spheres = columns * rows, size = 96;

/** Bits of a half float to a number. */
function fromHalf(bits) {
  const exponent = bits >> 10 & 31, mantissa = bits & 1023;
  const value = exponent === 0 ? mantissa * 2 ** -24 : (1024 + mantissa) * 2 ** (exponent - 25);
  return bits & 0x8000 ? -value : value;
}

/** Places across the grid, a quarter of it away from its sides, which no point of it holds. */
export function placesIn({ min, max }) {
  return Array.from({ length: spheres }, (_, i) => {
    const share = [(i % columns + 0.5) / columns, 0.3 + 0.4 * Math.floor(i / columns), 0.25 + 0.5 * (i * 0.618 % 1)];
    return share.map((t, k) => min[k] + (0.25 + 0.5 * t) * (max[k] - min[k]));
  });
}

export async function readGrid(name) {
  const header = await (await fetch(`${name}.json`)).json();
  const data = await (await fetch((header.light ?? header.texture).file)).arrayBuffer();
  return { header, data };
}

/** The radiance at each point of three.js' texture, as `lightAt` takes it. */
function radianceOf({ header, data }) {
  const halves = new Uint16Array(data), [nx, ny, nz] = header.resolution, numbers = new Float32Array(27 * nx * ny * nz);
  for (let z = 0; z < nz; ++z)
    for (let i = 0; i < nx * ny; ++i)
      for (let n = 0; n < 27; ++n)
        numbers[27 * (z * nx * ny + i) + n] = fromHalf(halves[4 * (((n >> 2) * (nz + 2) + z + 1) * nx * ny + i) + n % 4]);
  return numbers;
}

/** E(n)/π of nine coefficients of radiance. */
function lambert(c, [x, y, z]) {
  const basis = [0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z, 0.315392 * (3 * z * z - 1),
    1.092548 * x * z, 0.546274 * (x * x - y * y)];
  return [0, 1, 2].map(k => basis.reduce((sum, b, i) => sum + (i === 0 ? 1 : i < 4 ? 2 / 3 : 1 / 4) * b * c[3 * i + k], 0));
}

/** Compares pictures of spheres of radius 0.5 at (column, row, 0), seen along −z (front) and z (back), rows from below, RGBA, each sphere
 *  `size` pixels wide, and leaves what is found in the document. */
export async function compare(places, { front, back }) {
  const three = await readGrid('three'), radiance = radianceOf(three), width = columns * size;
  let count = 0, sum = 0, most = 0, negative = 0, mean = 0;
  for (const [picture, side] of [[front, 1], [back, -1]]) {
    for (let i = 0; i < spheres; ++i) {
      const coefficients = lightAt(three.header, radiance, places[i]);
      for (let v = 0; v < size; ++v) {
        for (let u = 0; u < size; ++u) {
          const x = side * (2 * (u + 0.5) / size - 1), y = 2 * (v + 0.5) / size - 1, z2 = 1 - x * x - y * y;
          if (z2 < 0.1) continue;  // edges of a sphere of triangles
          const column = side > 0 ? i % columns : columns - 1 - i % columns;
          const pixel = 4 * ((Math.floor(i / columns) * size + v) * width + column * size + u);
          const truth = lambert(coefficients, [x, y, side * Math.sqrt(z2)]);
          for (let c = 0; c < 3; ++c) {
            if (truth[c] < 0) { ++negative; continue; }
            const error = Math.abs(picture[pixel + c] - truth[c]);
            ++count, sum += error, mean += truth[c], most = Math.max(most, error);
          }
        }
      }
    }
  }
  mean /= count;
  document.title = `${count} numbers of mean ${mean.toPrecision(3)}: mean error ${(sum / count / mean * 100).toPrecision(2)} %, ` +
    `largest ${(most / mean * 100).toPrecision(2)} % of the mean; ${negative} were negative`;
}
