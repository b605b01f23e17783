/** Irradiance from points on surfaces: a linear fit in the tangent plane to those around that the place sees. libs/runtime's points.c, in float32. */
import { groupFloats, probeFloats, type CookedFile } from './file.js';
import { bitCount, dot3, type Float3 } from './float.js';
import { mostListedPoints, pointOf, recordFloats } from './layout.js';

const f = Math.fround;
const reach = 3, leastCosine = f(0.7), offPlane = f(0.5), offPlaneSlope = f(0.1), ridge = f(0.05), mostNegative = f(0.25), coarser = 2.5;

const sharePoint = new Uint32Array(mostListedPoints);
const shareWeight = new Float32Array(mostListedPoints), shareX = new Float32Array(mostListedPoints), shareY = new Float32Array(mostListedPoints);
const shareDistance2 = new Float32Array(mostListedPoints), shareSpacing = new Float32Array(mostListedPoints);
const parts = new Uint8Array(4), at = new Uint32Array(3), part = new Uint8Array(3);
const tangentX = new Float32Array(3), tangentY = new Float32Array(3);
const basis = new Float32Array(10), sum = new Float32Array(32), e = new Float32Array(3);

/** The place's cell that holds surface, and its part of the cell by each cut; −1: there is none. */
function findCell(file: CookedFile, x: Float3): number {
  for (const grid of file.header.grids) {
    let inside = true;
    for (let c = 0; c < 3 && inside; ++c) {
      const u = f(f(x[c]! - grid.origin[c]!) / grid.cellSize);
      inside = u >= 0 && u < f(grid.cells[c]!);
      if (!inside) break;
      at[c] = u;
      part[c] = f(f(u - at[c]!) * 8);
    }
    if (!inside) continue;
    const [i, j, k] = at as unknown as [number, number, number];
    const bricksX = (grid.cells[0]! + 3) >>> 2, bricksY = (grid.cells[1]! + 3) >>> 2;
    const brick = 4 * (grid.firstBrick + ((k >> 2) * bricksY + (j >> 2)) * bricksX + (i >> 2));
    const bit = (i & 3) + 4 * (j & 3) + 16 * (k & 3), low = file.bricks[brick]!, high = file.bricks[brick + 1]!;
    if ((((bit < 32 ? low : high) >>> (bit & 31)) & 1) === 0) return -1;
    const below = bit < 32 ? bitCount(low & ((1 << bit) - 1)) : bitCount(low) + bitCount(high & ((1 << (bit & 31)) - 1));
    const px = part[0]!, py = part[1]!, pz = part[2]!;
    parts[0] = py + 8 * pz;
    parts[1] = px + 8 * pz;
    parts[2] = px + 8 * py;
    parts[3] = (px >> 1) + 4 * (py >> 1) + 16 * (pz >> 1);
    return file.bricks[brick + 2]! + below;
  }
  return -1;
}

function setTangents(n: Float3): void {
  const x = n[0]!, y = n[1]!, z = n[2]!, sign = z < 0 ? -1 : 1, a = f(-1 / f(sign + z)), b = f(f(x * y) * a);
  tangentX[0] = 1 + f(f(f(sign * x) * x) * a), tangentX[1] = sign * b, tangentX[2] = -sign * x;
  tangentY[0] = b, tangentY[1] = sign + f(f(y * y) * a), tangentY[2] = -y;
}

/** Of the point that begins at `p`; (x, y, z) leads to it from the place. */
function weightOf(points: Float32Array, cover: number, p: number, x: number, y: number, z: number, nx: number, ny: number, nz: number): number {
  const spacing = points[p + 3]!, d2 = dot3(x, y, z, x, y, z), s2 = f(spacing * spacing);
  let t = f(1 - f(d2 / f(reach * reach * s2)));
  if (!(t > 0)) return 0;
  const facing = f(f(dot3(points[p + 4]!, points[p + 5]!, points[p + 6]!, nx, ny, nz) - leastCosine) / f(1 - leastCosine));
  if (!(facing > 0)) return 0;
  const off = f(dot3(x, y, z, nx, ny, nz) / f(f(offPlane * spacing) + f(offPlaneSlope * f(Math.sqrt(d2)))));
  const level = f(1 - f(off * off));
  if (!(level > 0)) return 0;
  t = f(t * t), t = f(t * t), t = f(t * t);
  const weight = f(f(f(f(t / spacing) * facing) * level) * level);
  if (cover === 0) return weight;
  const open = 1 << cover, q = f(f(f(d2 * open) * open) / s2);
  return f(weight * f(1 / f(1 + f(q * q))));
}

/** The points of the cell that count, and the linear fit's weights. */
function findShares(file: CookedFile, x: Float3, n: Float3): number {
  const cell = findCell(file, x);
  if (cell < 0) return 0;
  const { points, pointWords, entries, masks } = file, nx = n[0]!, ny = n[1]!, nz = n[2]!, x0 = x[0]!, x1 = x[1]!, x2 = x[2]!;
  const end = file.cells[2 * cell + 2]!, unit = f(1 / file.header.grids[0].cellSize);
  let mask = 2 * file.cells[2 * cell + 1]!, count = 0;
  let total = 0, perSpacing = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, spacings = 0;
  setTangents(n);
  const ax = tangentX[0]!, ay = tangentX[1]!, az = tangentX[2]!, bx = tangentY[0]!, by = tangentY[1]!, bz = tangentY[2]!;
  for (let i = file.cells[2 * cell]!; i < end; ++i) {
    const entry = entries[i]!, point = entry & pointOf, p = 8 * point, cover = pointWords[p + 7]!;
    if (entry >>> 31) {
      const of = parts[(entry >>> 29) & 3]!, word = masks[of < 32 ? mask : mask + 1]!;
      mask += 2;
      if (((word >>> (of & 31)) & 1) === 0) continue;
    }
    const ox = f(points[p]! - x0), oy = f(points[p + 1]! - x1), oz = f(points[p + 2]! - x2);
    const w = weightOf(points, cover, p, ox, oy, oz, nx, ny, nz);
    if (!(w > 0)) continue;
    const spacing = points[p + 3]!;
    sharePoint[count] = point;
    shareWeight[count] = w;
    shareX[count] = f(dot3(ox, oy, oz, ax, ay, az) * unit);
    shareY[count] = f(dot3(ox, oy, oz, bx, by, bz) * unit);
    shareDistance2[count] = dot3(ox, oy, oz, ox, oy, oz);
    shareSpacing[count] = spacing;
    ++count;
    total += w;
    perSpacing += f(w / spacing);
  }
  if (!(total > 0)) return 0;
  // A far point of a plain, with its long lever, would tilt the fit of a room
  const mean = f(total / perSpacing), far2 = f(f(coarser * coarser * mean) * mean);
  total = 0;
  for (let i = 0; i < count; ++i) {
    const q = f(shareDistance2[i]! / far2), w = f(shareWeight[i]! / f(1 + f(q * q)));
    const dx = shareX[i]!, dy = shareY[i]!, spacing = f(shareSpacing[i]! * unit);
    shareWeight[i] = w;
    total += w, sx += w * dx, sy += w * dy;
    sxx += w * dx * dx, sxy += w * dx * dy, syy += w * dy * dy;
    spacings += w * spacing * spacing;
  }
  // First row of the inverse of [1 x y; x xx xy; y xy yy], to a factor
  const mx = sx / total, my = sy / total, r = (ridge * spacings) / total;
  const xx = sxx / total + r, xy = sxy / total, yy = syy / total + r;
  const c0 = xx * yy - xy * xy, c1 = my * xy - mx * yy, c2 = mx * xy - my * xx, determinant = c0 + mx * c1 + my * c2;
  const row0 = f(c0 / determinant), row1 = f(c1 / determinant), row2 = f(c2 / determinant);
  let negative = 0, all = 0;
  for (let i = 0; i < count; ++i) {
    const relative = f(f(row0 + f(row1 * shareX[i]!)) + f(row2 * shareY[i]!));
    shareX[i] = relative;
    if (relative < 0) negative = f(negative + f(shareWeight[i]! * -relative));
  }
  // Of the way from the mean to the fit
  const allowed = f(mostNegative * f(total)), most = negative > allowed ? f(allowed / negative) : 1;
  for (let i = 0; i < count; ++i) {
    shareWeight[i] = shareWeight[i]! * f(f(1 - most) + f(most * shareX[i]!));
    all = f(all + shareWeight[i]!);
  }
  for (let i = 0; i < count; ++i) shareWeight[i] = shareWeight[i]! / all;
  return count;
}

/** What each three floats of a point's light count for; how many there are. */
function setBasis(floats: number, n: Float3): number {
  const x = n[0]!, y = n[1]!, z = n[2]!;
  if (floats === recordFloats) {
    basis[0] = x, basis[1] = y, basis[2] = z, basis[3] = 1;
    return 4;
  }
  const h1 = f(0.488602512), h2 = f(1.092548431);
  basis[0] = 0.282094792;
  basis[1] = h1 * y, basis[2] = h1 * z, basis[3] = h1 * x;
  basis[4] = f(h2 * x) * y, basis[5] = f(h2 * y) * z;
  basis[6] = f(0.315391565) * f(f(f(3 * z) * z) - 1), basis[7] = f(h2 * x) * z;
  basis[8] = f(0.546274215) * f(f(x * x) - f(y * y)), basis[9] = 1;
  return 10;
}

/** Whether any point lights the place; then its irradiance is in `rgb`. */
export function byPoints(file: CookedFile, light: Float32Array, scales: Float32Array, x: Float3, n: Float3, rgb: Float3): boolean {
  const h = file.header;
  if (h.pointCount === 0) return false;
  const count = findShares(file, x, n);
  if (count === 0) return false;
  const floats = h.pointFloats, terms = setBasis(floats, n), numbers = 3 * terms;
  e.fill(0);
  for (let g = 0; g < h.groupCount; ++g) {
    if (scales[3 * g] === 0 && scales[3 * g + 1] === 0 && scales[3 * g + 2] === 0) continue;
    const first = g * groupFloats(h) + probeFloats(h);
    sum.fill(0);
    for (let i = 0; i < count; ++i) {
      const from = first + floats * sharePoint[i]!, w = shareWeight[i]!;
      for (let k = 0; k < numbers; ++k) sum[k] = sum[k]! + f(w * light[from + k]!);
    }
    for (let k = 0; k < terms; ++k)
      for (let c = 0; c < 3; ++c) e[c] = e[c]! + f(f(scales[3 * g + c]! * basis[k]!) * sum[3 * k + c]!);
  }
  for (let c = 0; c < 3; ++c) rgb[c] = e[c]! > 0 ? e[c]! : 0;
  return true;
}
