/** Whether a file holds together. Lookups check nothing: whatever they follow is looked at here, as in libs/runtime's validate.c. */
import { utf8 } from '../bytes.js';
import { SsphhError, type ErrorCode } from '../errors.js';
import { checksum } from './checksum.js';
import type { CookedFile, Group } from './file.js';
import { bitCount } from './float.js';
import * as layout from './layout.js';
import type { Grid, Header, SectionName } from './layout.js';

const messages: Partial<Record<ErrorCode, string>> = {
  'not-cooked': 'this is no cooked file: ssphh cook makes them of probe files',
  'bad-version': 'the cooked file is of another version of the format: cook its probe file anew',
  'cut-off': 'the cooked file has another size than it says: it was cut off or added to',
  damaged: 'the cooked file is damaged: its checksum is wrong',
};
function refuse(code: ErrorCode, why = ''): never {
  throw new SsphhError(code, messages[code] ?? `the cooked file contradicts itself: ${why}`);
}

const isLength = (v: number) => v > 0 && Number.isFinite(v);
const areFinite = (values: Float32Array) => values.every(Number.isFinite);

/** Product of a grid's cells; 0 where they are too many. */
function cellsOf(cells: number[]): number {
  const product = cells.reduce((p, n) => p * n, 1);
  return cells.some(n => n > layout.mostCells) || product > layout.mostCells ? 0 : product;
}

function gridsHold(grids: [Grid, Grid]): boolean {
  let first = 0;
  return grids.every((grid, g) => {
    const empty = g > 0 && grid.cells.every(n => n === 0);
    const good = (empty || cellsOf(grid.cells) > 0) && isLength(grid.cellSize) && areFinite(grid.origin) && grid.firstBrick === first;
    first += layout.bricksOf(grid);
    return good;
  });
}

function countsHold(h: Header): boolean {
  const coefficients = h.degree === 4 ? 18 : (h.degree + 1) ** 2;
  if (h.groupCount > layout.mostGroups || h.probeCount < 1 || h.probeCount > layout.mostProbes) return false;
  if (h.degree > 4 || h.degree === 3 || h.probeStride !== Math.ceil(coefficients / 8) * 8 || h.sightSize > layout.mostSight) return false;
  if (h.probeListLength < 1 || h.probeListLength > layout.mostListedProbes || cellsOf(h.probeCells) === 0) return false;
  if (h.pointCount > layout.mostPoints || !(h.probeSpacing >= 0) || !Number.isFinite(h.probeSpacing)) return false;
  if (!areFinite(h.probeOrigin) || !isLength(h.probeCellSize) || !Number.isFinite(h.time)) return false;
  if (h.pointCount === 0) return h.pointFloats === 0 && h.entryCount === 0 && h.maskCount === 0;
  return (h.pointFloats === layout.recordFloats || h.pointFloats === layout.fittedFloats) && gridsHold(h.grids);
}

/** Bytes of each section by the header's counts; of names no more than these. */
function sizesOf(h: Header): Record<SectionName, number> {
  const points = h.pointCount;
  return {
    groups: h.groupCount * 32,
    names: h.groupCount * (layout.mostName + 1),
    probes: h.probeCount * 16,
    probeCells: cellsOf(h.probeCells) * h.probeListLength * 2,
    sight: h.probeCount * 6 * h.sightSize ** 2 * 2,
    bricks: points ? (layout.bricksOf(h.grids[0]) + layout.bricksOf(h.grids[1])) * 16 : 0,
    cells: points ? (h.cellCount + 1) * 8 : 0,
    entries: h.entryCount * 4,
    masks: h.maskCount * 8,
    points: points * 32,
    light: h.groupCount * (h.probeCount * 3 * h.probeStride + points * h.pointFloats) * 4,
  };
}

function sectionsHold(h: Header): boolean {
  const sizes = sizesOf(h);
  let end = h.headerSize;
  for (const name of layout.sectionNames) {
    const s = h.sections[name], aligned = Math.ceil(end / layout.alignment) * layout.alignment;
    const fits = name === 'names' ? s.size <= sizes[name] : s.size === sizes[name];
    if (s.offset !== aligned || !fits || aligned > h.fileSize || s.size > h.fileSize - aligned) return false;
    end = aligned + s.size;
  }
  return h.fileSize - end < layout.alignment;
}

/** The groups, or undefined where they do not hold. */
function readGroups(bytes: Uint8Array, h: Header): Group[] | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), groups: Group[] = [];
  const names = h.sections.names;
  for (let g = 0; g < h.groupCount; ++g) {
    const at = h.sections.groups.offset + 32 * g, u32 = (k: number) => view.getUint32(at + k, true);
    const begin = u32(0), length = u32(4), mode = u32(20);
    if (length > layout.mostName || begin >= names.size || length >= names.size - begin || mode > 2 || u32(24) !== 0 || u32(28) !== 0) return undefined;
    const text = bytes.subarray(names.offset + begin, names.offset + begin + length);
    if (bytes[names.offset + begin + length] !== 0 || text.includes(0)) return undefined;
    const scale: [number, number, number] = [8, 12, 16].map(k => view.getFloat32(at + k, true)) as [number, number, number];
    if (!scale.every(v => v >= 0 && v <= 1e6)) return undefined;
    groups.push({ name: utf8(text) ?? Array.from(text, b => String.fromCharCode(b)).join(''), mode, scale });
  }
  return groups;
}

function probesHold(file: CookedFile): boolean {
  for (let i = 0; i < file.probes.length; ++i) if (i % 4 === 3 ? !isLength(file.probes[i]!) : !Number.isFinite(file.probes[i]!)) return false;
  return file.probeCells.every(probe => probe === layout.noProbe || probe < file.header.probeCount);
}

function bricksHold({ bricks, header }: CookedFile): boolean {
  let found = 0;
  for (let i = 0; i < bricks.length; i += 4) {
    if (bricks[i + 2] !== found || bricks[i + 3] !== 0) return false;
    found += bitCount(bricks[i]!) + bitCount(bricks[i + 1]!);
  }
  return found === header.cellCount;
}

function cellsHold({ cells, entries, header }: CookedFile): boolean {
  let masks = 0;
  if (cells[0] !== 0 || cells[1] !== 0) return false;
  for (let i = 0; i < header.cellCount; ++i) {
    const first = cells[2 * i]!, end = cells[2 * i + 2]!;
    if (end < first || end - first > layout.mostListedPoints || end > header.entryCount) return false;
    for (let k = first; k < end; ++k) {
      masks += entries[k]! >>> 31;
      if ((entries[k]! & layout.pointOf) >= header.pointCount) return false;
    }
    if (cells[2 * i + 3] !== masks) return false;
  }
  return cells[2 * header.cellCount] === header.entryCount && masks === header.maskCount;
}

function pointsHold({ points, pointWords }: CookedFile): boolean {
  for (let i = 0; i < points.length; i += 8) {
    if (!areFinite(points.subarray(i, i + 3)) || !areFinite(points.subarray(i + 4, i + 7))) return false;
    if (!isLength(points[i + 3]!) || pointWords[i + 7]! > 7) return false;
  }
  return true;
}

/** The header and groups of a file, or an error: not its lists, light and checksum. `bytes` are aligned to 8. */
export function checkHeader(bytes: Uint8Array): { header: Header; groups: Group[] } {
  if (bytes.length < 8 || layout.magic.some((b, i) => bytes[i] !== b)) refuse('not-cooked');
  if (bytes.length < 16) refuse('cut-off');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint32(8, true) !== layout.version) refuse('bad-version');
  if (bytes.length < layout.headerSize || Number(view.getBigUint64(16, true)) !== bytes.length) refuse('cut-off');
  const header = layout.readHeader(bytes);
  if (header.headerSize !== layout.headerSize || bytes.length % 8 !== 0) refuse('invalid', 'sizes in its header');
  if (!countsHold(header)) refuse('invalid', 'counts or places in its header');
  if (!sectionsHold(header)) refuse('invalid', 'where its sections lie');
  const groups = readGroups(bytes, header);
  if (!groups) refuse('invalid', 'its light groups');
  return { header, groups };
}

function viewsOf(bytes: Uint8Array, header: Header, groups: Group[]): CookedFile {
  const at = (name: SectionName, unit: number): [ArrayBuffer, number, number] => {
    const s = header.sections[name];
    return [bytes.buffer as ArrayBuffer, bytes.byteOffset + s.offset, s.size / unit];
  };
  return {
    bytes, header, groups,
    probes: new Float32Array(...at('probes', 4)),
    probeCells: new Uint16Array(...at('probeCells', 2)),
    sight: new Uint16Array(...at('sight', 2)),
    bricks: new Uint32Array(...at('bricks', 4)),
    cells: new Uint32Array(...at('cells', 4)),
    entries: new Uint32Array(...at('entries', 4)),
    masks: new Uint32Array(...at('masks', 4)),
    points: new Float32Array(...at('points', 4)),
    pointWords: new Uint32Array(...at('points', 4)),
    light: new Float32Array(...at('light', 4)),
  };
}

function checksumIsRight(bytes: Uint8Array): boolean {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), [low, high] = checksum(bytes);
  return view.getUint32(layout.checksumAt, true) === low && view.getUint32(layout.checksumAt + 4, true) === high;
}

/** Everything about a file, as views; or an error. `bytes` are aligned to 8 and stay as they are. */
export function checkAll(bytes: Uint8Array): CookedFile {
  let found: { header: Header; groups: Group[] };
  try {
    found = checkHeader(bytes);
  } catch (error) {
    // What is damaged is rather that than invalid
    if ((error as SsphhError).code === 'invalid' && bytes.length % 8 === 0 && !checksumIsRight(bytes)) refuse('damaged');
    throw error;
  }
  if (!checksumIsRight(bytes)) refuse('damaged');
  const file = viewsOf(bytes, found.header, found.groups);
  if (!probesHold(file)) refuse('invalid', 'its probes or their lists');
  if (file.header.pointCount > 0 && !(bricksHold(file) && cellsHold(file) && pointsHold(file))) refuse('invalid', 'its points or their lists');
  if (!areFinite(file.light)) refuse('invalid', 'light that is not finite');
  return file;
}
