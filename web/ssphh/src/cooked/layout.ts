/** What stands where in a cooked file of version 3 (docs/cooked-files.md). */

export const version = 3, headerSize = 376, alignment = 64;
export const mostGroups = 256, mostProbes = 65535, mostCells = 1 << 24, mostName = 1024, mostPoints = 1 << 19;
export const mostListedProbes = 32, mostListedPoints = 96, pointOf = 0x1fffffff, noProbe = 0xffff, mostSight = 1024;
export const recordFloats = 12, fittedFloats = 32;
export const magic = [0x53, 0x50, 0x48, 0x43, 0x0d, 0x0a, 0x1a, 0x0a];
export const checksumAt = 24;

export const sectionNames = ['groups', 'names', 'probes', 'probeCells', 'sight', 'bricks', 'cells', 'entries', 'masks', 'points', 'light'] as const;
export type SectionName = (typeof sectionNames)[number];
export interface Section {
  offset: number;
  size: number;
}

export interface Grid {
  origin: Float32Array;
  cellSize: number;
  cells: number[];
  firstBrick: number;
}

export interface Header {
  headerSize: number;
  fileSize: number;
  scene: [bigint, bigint];
  geometry: bigint;
  groupCount: number;
  time: number;
  probeCount: number;
  degree: number;
  probeStride: number;
  sightSize: number;
  probeListLength: number;
  probeSpacing: number;
  probeOrigin: Float32Array;
  probeCellSize: number;
  probeCells: number[];
  pointCount: number;
  pointFloats: number;
  cellCount: number;
  entryCount: number;
  maskCount: number;
  grids: [Grid, Grid];
  sections: Record<SectionName, Section>;
}

/** Of at least `headerSize` bytes; nothing is checked. */
export function readHeader(bytes: Uint8Array): Header {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const u32 = (at: number) => view.getUint32(at, true), f32 = (at: number) => view.getFloat32(at, true);
  const u64 = (at: number) => view.getBigUint64(at, true), size = (at: number) => Number(u64(at));
  const three = (at: number) => Float32Array.of(f32(at), f32(at + 4), f32(at + 8));
  const counts = (at: number) => [u32(at), u32(at + 4), u32(at + 8)];
  const grid = (at: number): Grid => ({ origin: three(at), cellSize: f32(at + 12), cells: counts(at + 16), firstBrick: u32(at + 28) });
  const sections = {} as Record<SectionName, Section>;
  sectionNames.forEach((name, i) => (sections[name] = { offset: size(200 + 16 * i), size: size(208 + 16 * i) }));
  return {
    headerSize: u32(12), fileSize: size(16), scene: [u64(32), u64(40)], geometry: u64(48), groupCount: u32(56), time: f32(60),
    probeCount: u32(64), degree: u32(68), probeStride: u32(72), sightSize: u32(76), probeListLength: u32(80),
    probeSpacing: f32(84), probeOrigin: three(88), probeCellSize: f32(100), probeCells: counts(104),
    pointCount: u32(116), pointFloats: u32(120), cellCount: u32(124), entryCount: u32(128), maskCount: u32(132),
    grids: [grid(136), grid(168)], sections,
  };
}

/** Cells of the bricks of a grid: 4 × 4 × 4 each. */
export function bricksOf(grid: Grid): number {
  return grid.cells.reduce((product, cells) => product * Math.floor((cells + 3) / 4), 1);
}
