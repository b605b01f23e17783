/** What stands between a place and a probe, by six faces of distances around the probe: libs/runtime's sight.c, in float32. */
import type { CookedFile } from './file.js';
import { clamp, dot, type Float3 } from './float.js';

const f = Math.fround;
const unit = f(1 / 65535), belowSurface = 0.0625;

const away = new Float32Array(3), d = new Float32Array(3), ray = new Float32Array(3);

/** Face of a direction in the order of cube maps; `on`: along its axis, and right and down on the face for 1 along the axis. */
const on = new Float32Array(3);
function faceOf(v: Float3): number {
  const x = v[0]!, y = v[1]!, z = v[2]!, ax = Math.abs(x), ay = Math.abs(y), az = Math.abs(z);
  if (ax >= ay && ax >= az) {
    on[0] = ax, on[1] = x > 0 ? -z : z, on[2] = -y;
    return x > 0 ? 0 : 1;
  }
  if (ay >= az) {
    on[0] = ay, on[1] = x, on[2] = y > 0 ? z : -z;
    return y > 0 ? 2 : 3;
  }
  on[0] = az, on[1] = z > 0 ? x : -x, on[2] = -y;
  return z > 0 ? 4 : 5;
}

function setRay(face: number, right: number, down: number): void {
  const side = face % 2 === 0 ? 1 : -1;
  if (face < 2) ray[0] = side, ray[1] = -down, ray[2] = -side * right;
  else if (face < 4) ray[0] = right, ray[1] = side, ray[2] = side * down;
  else ray[0] = side * right, ray[1] = -down, ray[2] = side;
}

/** Whether probe and place see each other, sight beginning `lift` metres above it. `still`: the place is on a surface. */
export function sees(file: CookedFile, probe: number, still: boolean, x: Float3, n: Float3, lift: number): boolean {
  const size = file.header.sightSize;
  if (size === 0) return true;
  for (let c = 0; c < 3; ++c) {
    away[c] = x[c]! - file.probes[4 * probe + c]!;
    d[c] = away[c]! + f(lift * n[c]!);
  }
  const height = -dot(n, away);
  if (still && height < 0 && f(height * height) > f(belowSurface * dot(away, away))) return false;
  const face = faceOf(d), major = on[0]!;
  if (!(major > 0)) return true; // the probe stands there
  const half = f(0.5 * size);
  const i = Math.trunc(clamp(f(f(f(on[1]! / major) + 1) * half), 0, size - 1));
  const j = Math.trunc(clamp(f(f(f(on[2]! / major) + 1) * half), 0, size - 1));
  let asked = major;
  if (still && height > 0) {
    // Along the texel's ray the surface itself may stand nearer
    setRay(face, f(f((i + 0.5) / half) - 1), f(f((j + 0.5) / half) - 1));
    const slope = -dot(n, ray);
    if (height < f(asked * slope)) asked = f(height / slope);
  }
  const stored = file.sight[((probe * 6 + face) * size + j) * size + i]!;
  return stored === 0xffff || f(f(f(stored * unit) * file.probes[4 * probe + 3]!) * f(1 + f(1.5 / size))) >= asked;
}
