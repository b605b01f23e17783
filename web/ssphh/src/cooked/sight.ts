/** What stands between a place and a probe, by six faces of distances around the probe: libs/runtime's sight.c, in float32. */
import type { CookedFile } from './file.js';
import { clamp, dot3, type Float3 } from './float.js';

const f = Math.fround;
const unit = f(1 / 65535);

/** Whether probe and place see each other, sight beginning `lift` metres above it. `still`: the place is on a surface. */
export function sees(file: CookedFile, probe: number, still: boolean, x: Float3, n: Float3, lift: number): boolean {
  const size = file.header.sightSize, probes = file.probes, nx = n[0]!, ny = n[1]!, nz = n[2]!;
  if (size === 0) return true;
  const awayX = f(x[0]! - probes[4 * probe]!), awayY = f(x[1]! - probes[4 * probe + 1]!), awayZ = f(x[2]! - probes[4 * probe + 2]!);
  const dx = f(awayX + f(lift * nx)), dy = f(awayY + f(lift * ny)), dz = f(awayZ + f(lift * nz));
  const height = -dot3(nx, ny, nz, awayX, awayY, awayZ);
  // From so far below a surface, light reaches a place only over an edge nearer than a fifth of the way
  if (still && height < 0 && f(height * height) > f(0.0025 * dot3(awayX, awayY, awayZ, awayX, awayY, awayZ))) return false;
  const sizeX = Math.abs(dx), sizeY = Math.abs(dy), sizeZ = Math.abs(dz);
  const axis = sizeX >= sizeY && sizeX >= sizeZ ? 0 : sizeY >= sizeZ ? 1 : 2, major = axis === 0 ? sizeX : axis === 1 ? sizeY : sizeZ;
  if (!(major > 0)) return true; // the probe stands there
  const side = (axis === 0 ? dx : axis === 1 ? dy : dz) > 0 ? 1 : -1, half = f(0.5 * size);
  // Right and down on the face, in the order and orientation of cube maps
  const right = axis === 0 ? -side * dz : axis === 1 ? dx : side * dx, down = axis === 1 ? side * dz : -dy;
  const i = Math.trunc(clamp(f(f(f(right / major) + 1) * half), 0, size - 1)), j = Math.trunc(clamp(f(f(f(down / major) + 1) * half), 0, size - 1));
  let asked = major;
  if (still && height > 0) {
    // Along the texel's ray the surface itself may stand nearer
    const u = f(f((i + 0.5) / half) - 1), v = f(f((j + 0.5) / half) - 1);
    const slope = -(axis === 0 ? dot3(nx, ny, nz, side, -v, -side * u) : axis === 1 ? dot3(nx, ny, nz, u, side, side * v) : dot3(nx, ny, nz, side * u, -v, side));
    if (height < f(asked * slope)) asked = f(height / slope);
  }
  const face = 2 * axis + (side > 0 ? 0 : 1), stored = file.sight[((probe * 6 + face) * size + j) * size + i]!;
  // Nothing was found as far as anything asks
  return stored === 0xffff || f(f(f(stored * unit) * probes[4 * probe + 3]!) * f(1 + f(1.5 / size))) >= asked;
}
