import { Vector3 } from 'three';
import type { LatticeData } from './manifest';

/** A place of the lattice, and how much it counts. */
export type Share = [place: number, weight: number];

/** Where a lamp may be, and of which places its light is blended there: pipeline::lamp_shares of the tool. */
export class Lattice {
  private readonly boxes: number[];

  /** `seen`: of each box, the corners that it sees. */
  constructor(private readonly data: LatticeData, private readonly seen: Uint8Array) {
    this.boxes = data.planes.map(planes => planes.at(-1)!);
  }

  private boxAt(at: Vector3): [place: number[], box: number[]] | undefined {
    const place = at.toArray().map((x, i) => (x - this.data.origin[i]!) / this.data.box);
    if (place.some((x, i) => !(x >= 0 && x <= this.boxes[i]!))) return undefined;
    return [place, place.map((x, i) => Math.min(Math.floor(x), this.boxes[i]! - 1))];
  }

  private seenBy(box: number[]): number {
    return this.seen[(box[2]! * this.boxes[1]! + box[1]!) * this.boxes[0]! + box[0]!]!;
  }

  isFree(at: Vector3): boolean {
    const found = this.boxAt(at);
    return found !== undefined && this.seenBy(found[1]) !== 0;
  }

  /** Shares with a sum of 1; none where the lamp may not be. */
  shares(at: Vector3): Share[] {
    const found = this.boxAt(at);
    if (!found) return [];
    const [place, box] = found, { planes } = this.data, seen = this.seenBy(box);
    const cell = box.map((b, i) => planes[i]!.findLastIndex(plane => plane <= b));
    const share = cell.map((c, i) => (place[i]! - planes[i]![c]!) / (planes[i]![c + 1]! - planes[i]![c]!));
    const shares: Share[] = [];
    for (let corner = 0; corner < 8; ++corner) {
      if (!(seen >> corner & 1)) continue;
      const side = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
      const [x, y, z] = side.map((s, i) => cell[i]! + s) as [number, number, number];
      const weight = side.reduce((product, s, i) => product * (s ? share[i]! : 1 - share[i]!), 1);
      shares.push([this.data.place_of[(z * planes[1]!.length + y) * planes[0]!.length + x]!, weight]);
    }
    const sum = shares.reduce((all, [, weight]) => all + weight, 0);
    return shares.map(([at, weight]) => [at, sum > 0 ? weight / sum : 1 / shares.length]);
  }

  /** How far one comes from a free place on the way to another: in short steps, along walls where they are in the way. */
  go(from: Vector3, to: Vector3): Vector3 {
    const at = from.clone(), steps = Math.ceil(from.distanceTo(to) / (0.4 * this.data.box));
    for (let k = 0; k < steps; ++k) {
      const step = to.clone().sub(at).divideScalar(steps - k).clampLength(0, 0.4 * this.data.box);
      for (const axes of [[0, 1, 2], [0], [1], [2]]) {
        const next = at.clone();
        for (const axis of axes) next.setComponent(axis, at.getComponent(axis) + step.getComponent(axis));
        if (!this.isFree(next)) continue;
        at.copy(next);
        if (axes.length > 1) break;  // all of the step
      }
    }
    return at;
  }
}
