import { coefficientCount, cosineFactor, shBasis } from '../sh.js';

/** Unit direction of the centre of texel i of an octahedral map of `side` × `side`, +z in its middle. */
function octahedralTexel(i: number, side: number): [number, number, number] {
  const u = (2 * (i % side) + 1) / side - 1, v = (2 * Math.floor(i / side) + 1) / side - 1, z = 1 - Math.abs(u) - Math.abs(v);
  const [x, y] = z < 0 ? [(1 - Math.abs(v)) * Math.sign(u), (1 - Math.abs(u)) * Math.sign(v)] : [u, v];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** Solves a x = b for the rows of b, a symmetric and positive definite; x takes b's place. */
function solve(a: Float64Array[], b: Float64Array[]): void {
  a.forEach((row, i) => {
    a.forEach((other, j) => {
      if (j === i) return;
      const factor = other[i]! / row[i]!;
      row.forEach((v, k) => (other[k]! -= factor * v));
      b[i]!.forEach((v, k) => (b[j]![k]! -= factor * v));
    });
  });
  b.forEach((row, i) => row.forEach((v, k) => (row[k] = v / a[i]![i]!)));
}

/** What turns a map of irradiance into radiance, in least squares: row k has the share of each texel in coefficient k. Band 3 has no irradiance and is 0. */
export function radianceFromMap(side: number, degree: number): Float64Array[] {
  const count = coefficientCount(degree), texels = side * side;
  const basis = Array.from({ length: texels }, (_, t) => shBasis(degree, octahedralTexel(t, side)).map((y, k) => y * cosineFactor(Math.floor(Math.sqrt(k)))));
  const rows = Array.from({ length: count }, (_, k) => Float64Array.from(basis, y => y[k]!));
  const gram = rows.map(row => Float64Array.from(rows, other => row.reduce((sum, v, t) => sum + v * other[t]!, 0)));
  gram.forEach((row, k) => (row[k] ||= 1));
  solve(gram, rows);
  return rows;
}
