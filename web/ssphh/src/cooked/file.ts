import type { Header } from './layout.js';

/** An opened file: views of its sections where they lie. Numbers of 64 bits are pairs, low half first. */
export interface CookedFile {
  bytes: Uint8Array;
  header: Header;
  groups: Group[];
  /** Four for each probe: position, reach. */
  probes: Float32Array;
  probeCells: Uint16Array;
  sight: Uint16Array;
  /** Four for each: mask, first cell, 0. */
  bricks: Uint32Array;
  /** Two for each: first entry, first mask. */
  cells: Uint32Array;
  entries: Uint32Array;
  masks: Uint32Array;
  /** Eight for each: position, spacing, normal, cover. */
  points: Float32Array;
  /** The same memory, for `cover`. */
  pointWords: Uint32Array;
  light: Float32Array;
}

export interface Group {
  name: string;
  /** 0 realtime, 1 mixed, 2 baked. */
  mode: number;
  scale: [number, number, number];
}

/** Floats of one group's light: of probes, then of points. */
export function groupFloats(header: Header): number {
  return probeFloats(header) + header.pointCount * header.pointFloats;
}
export function probeFloats(header: Header): number {
  return header.probeCount * 3 * header.probeStride;
}
