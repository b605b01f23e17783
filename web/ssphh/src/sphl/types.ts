import { SsphhError } from '../errors.js';
import type { Rgb } from '../sh.js';

/** RGB function on the sphere: r₀ g₀ b₀ r₁ g₁ b₁ …, coefficient k = l(l+1) + m, in the basis of `shBasis`. */
export type Coefficients = Float32Array;
export type Position = [number, number, number];

export interface ProbeSet {
  /** Highest band of every function, 0 to 10. */
  degree: number;
  generator: Generator;
  lightGroups: ProbeLightGroup[];
  probes: Probe[];
  /** Of HIER, whose light is each probe's `neighbor`; null: there was none. */
  hierarchy: { operator: 'coefficient' | 'mean' | 'matrix' | 'raw'; neighbors: number; threshold: number } | null;
  /** Surface points with weights of probes: irradiance there is Σ weights[k] · E of probes[k] for the normal. */
  fitted: FittedPoint[] | null;
  surface: SurfaceRecords | null;
  /** What `ssphh bake --update` compares a scene with is in the file; it is not read. */
  hasBaseline: boolean;
}

export interface Generator {
  operator: 'path' | 'surfel' | 'bounce';
  viz: 'none' | 'path' | 'links';
  vizSource: 'intensity' | 'radiance';
  gen: 'full' | 'local';
  vizPaths: 'all' | 'diffuse';
  maxDepth: number;
  passes: number;
  spp: number;
  vizMaxDepth: number;
  vizPasses: number;
  vizSpp: number;
  faceSize: number;
  seed: bigint;
  directions: number;
  /** Metres. */
  surfelSize: number;
  linkRays: number;
  scene: string;
  /** 32 hexadecimal digits. */
  sceneHash: string;
  /** Pose of the scene [s]. */
  time: number;
}

export interface ProbeLightGroup {
  name: string;
  /** RGB factor on the light as baked. */
  scale: Rgb;
  mode: 'realtime' | 'mixed' | 'baked' | 'diffuse';
}

export interface Probe {
  name: string;
  /** World: right-handed, y up, metres. */
  position: Position;
  radius: number;
  /** Radiance that arrives, as baked, in the order of `lightGroups`: straight from emitters (null: none), and by surfaces. */
  groups: { emitted: Coefficients | null; reflected: Coefficients }[];
  /** Light that comes from probe `from` here, as far as it was traced. `matrix`: row k here, column k′ there, RGB interleaved. */
  edges: { from: number; transfer: number; h: Coefficients; matrix: Float32Array | null }[];
  /** What the hierarchy adds; null where there is none. */
  neighbor: Coefficients | null;
}

export interface FittedPoint {
  position: Position;
  normal: Position;
  probes: number[];
  weights: number[];
}

/**
 * Light at points of surfaces that stand still. Nine numbers for each point and group: RGB irradiance E₀ [W/m²] at its normal, and its RGB
 * derivatives E_x, E_y as the surface turns toward the tangents of `tangentsOf(normal)`: E(n) = E₀ + E_x (n·x) + E_y (n·y).
 */
export interface SurfaceRecords {
  count: number;
  /** Three for each point. */
  positions: Float32Array;
  normals: Float32Array;
  /** Of each light group, as baked: what surfaces reflect, and what emitters send straight (null: the file has none of that group). */
  groups: { reflected: Float32Array; direct: Float32Array | null }[];
}

export const limits = {
  probes: 65536, lightGroups: 256, text: 1024, depth: 65535, samples: 1 << 24, faceSize: 4096, rays: 1 << 24, fittedPoints: 1 << 18, weights: 16,
  surfaceRecords: 1 << 20, surfels: 1 << 24, sceneItems: 1 << 20, fittedWeight: 1e6, coordinate: 1e9, coefficient: 1e30, scale: 1e6, smallestRadius: 1e-9,
  jsonBytes: 2 ** 27,
} as const;

export const names = {
  operator: ['path', 'surfel', 'bounce'], viz: ['none', 'path', 'links'], vizSource: ['intensity', 'radiance'], gen: ['full', 'local'],
  vizPaths: ['all', 'diffuse'], mode: ['realtime', 'mixed', 'baked', 'diffuse'], hierOperator: ['coefficient', 'mean', 'matrix', 'raw'],
} as const;

const fileVersion = 7;
/** Of binary files with packed light. */
export const packedVersion = 8;

/** Error `bad-version` for any other. */
export function expectVersion(version: unknown): void {
  if (version === fileVersion) return;
  throw new SsphhError('bad-version', `the probe file is of version ${version}, not ${fileVersion} or ${packedVersion}: bake it anew, or take a package that reads it`);
}
