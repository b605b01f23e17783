import { SsphhError } from './errors.js';

export type Rgb = [number, number, number];
/** Three numbers of any kind: an array, a typed array. */
export type Triple = ArrayLike<number>;

/** Highest degree of this project's files. */
export const maxDegree = 10;

/** (degree + 1)². */
export function coefficientCount(degree: number): number {
  return (degree + 1) * (degree + 1);
}

/** Degree of a function of so many coefficients. Error `bad-argument` where there is none of 0 to 10. */
export function degreeOf(coefficients: number): number {
  const degree = Math.round(Math.sqrt(coefficients)) - 1;
  if (!(degree >= 0 && degree <= maxDegree) || coefficientCount(degree) !== coefficients)
    throw new SsphhError('bad-argument', `${coefficients} coefficients are of no degree from 0 to ${maxDegree}`);
  return degree;
}

/**
 * Y_lm(d) of all bands up to `degree` (0 to 10), coefficient k = l(l+1) + m. Real, orthonormal, without Condon–Shortley's sign:
 * Y₀₀ = 0.282095, Y₁₋₁ = 0.488603 y, Y₁₀ = 0.488603 z, Y₁₁ = 0.488603 x, as in three.js. `direction` is of length 1, y is up.
 */
export function shBasis(degree: number, direction: Triple, out: Float64Array = new Float64Array(coefficientCount(degree))): Float64Array {
  if (!Number.isInteger(degree) || degree < 0 || degree > maxDegree)
    throw new SsphhError('bad-argument', `a degree is a whole number from 0 to ${maxDegree}, not ${degree}`);
  const x = direction[0]!, y = direction[1]!, z = direction[2]!;
  let cosine = 1, sine = 0, diagonal = 1; // real and imaginary part of (x + iy)^m; (2m − 1)!!
  for (let m = 0; m <= degree; ++m) {
    let below = 0, legendre = diagonal;
    for (let l = m; l <= degree; ++l) {
      if (l > m) {
        const next = ((2 * l - 1) * z * legendre - (l + m - 1) * below) / (l - m);
        below = legendre;
        legendre = next;
      }
      const scaled = norm(l, m) * legendre;
      out[l * (l + 1) + m] = scaled * cosine;
      if (m > 0) out[l * (l + 1) - m] = scaled * sine;
    }
    [cosine, sine] = [x * cosine - y * sine, x * sine + y * cosine];
    diagonal *= 2 * m + 1;
  }
  return out;
}

function norm(l: number, m: number): number {
  let ratio = 1; // (l + m)! / (l − m)!
  for (let k = l - m + 1; k <= l + m; ++k) ratio *= k;
  return Math.sqrt(((2 * l + 1) / (4 * Math.PI) / ratio) * (m > 0 ? 2 : 1));
}

/** A_l: what the clamped cosine makes of band l of radiance, π, 2π/3, π/4, 0, −π/24, 0, π/64 … */
export function cosineFactor(l: number): number {
  if (l === 1) return (2 * Math.PI) / 3;
  if (l % 2 === 1) return 0;
  let binomial = 1; // l! / (2^l (l/2)!²)
  for (let k = 1; k <= l / 2; ++k) binomial *= (l / 2 + k) / (4 * k);
  return ((l / 2) % 2 === 0 ? -1 : 1) * (l === 0 ? -1 : 1) * ((2 * Math.PI) / ((l + 2) * Math.abs(l - 1))) * binomial;
}

/** The value in a direction of an RGB function r₀ g₀ b₀ r₁ g₁ b₁ … of degree 0 to 10: radiance of radiance, irradiance of irradiance. */
export function shEvaluate(coefficients: ArrayLike<number>, direction: Triple): Rgb {
  const y = shBasis(degreeOf(coefficients.length / 3), direction);
  const rgb: Rgb = [0, 0, 0];
  for (let k = 0; k < y.length; ++k) for (let c = 0; c < 3; ++c) rgb[c]! += coefficients[3 * k + c]! * y[k]!;
  return rgb;
}

/** Coefficients of irradiance E(n) [W/m²] from those of radiance, RGB as in `shEvaluate`. A Lambertian surface of albedo a leaves a E/π. */
export function irradianceFromRadiance(coefficients: ArrayLike<number>): Float32Array {
  const degree = degreeOf(coefficients.length / 3), out = new Float32Array(coefficients.length);
  for (let l = 0; l <= degree; ++l)
    for (let i = 3 * l * l; i < 3 * (l + 1) * (l + 1); ++i) out[i] = cosineFactor(l) * coefficients[i]!;
  return out;
}

/** Irradiance [W/m²] by coefficients of radiance on a surface with a unit normal; not negative. */
export function shIrradiance(radiance: ArrayLike<number>, normal: Triple): Rgb {
  return shEvaluate(irradianceFromRadiance(radiance), normal).map(v => Math.max(v, 0)) as Rgb;
}
