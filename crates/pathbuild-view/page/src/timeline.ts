// Times and positions of the tool along the moves of a scene.

import { Model, Step } from "./model.js";
import { isRapid, pointsOfMove } from "./scene.js";

/** Speeds in mm/min assumed while the tool is animated, if a program states none. Times that depend on them are not shown. */
const [ASSUMED_RAPID, ASSUMED_FEED] = [3000, 300];

/** Factor by which machines are slower than length / speed: SLOWDOWN of pathbuild-toolpath. */
const SLOWER = 1.4;

export class Timeline {
  /** Seconds until the end of each move. */
  readonly ends: Float64Array;
  /** Whether the speeds of all moves are known. */
  readonly isKnown: boolean;
  /** Cutting time in seconds; `null` if any feed is unknown. */
  readonly cutting: number | null;

  /** `rapid` is the speed of rapid moves in mm/min if a program does not state it. */
  constructor(model: Model, rapid: number | null) {
    this.ends = new Float64Array(model.steps.length);
    let [seconds, isKnown] = [0, true];
    let cutting: number | null = 0;
    model.steps.forEach(({ path, move }, index) => {
      const rapidly = isRapid(move.kind);
      const speed = rapidly ? (path.rapid ?? rapid) : (move.feed ?? null);
      if (move.length > 0) {
        isKnown &&= speed !== null;
        const took = (60 * SLOWER * move.length) / (speed ?? (rapidly ? ASSUMED_RAPID : ASSUMED_FEED));
        seconds += took;
        if (!rapidly) cutting = speed === null || cutting === null ? null : cutting + took;
      }
      this.ends[index] = seconds;
    });
    [this.isKnown, this.cutting] = [isKnown, cutting];
  }

  /** Returns the time of all moves in seconds. */
  get total(): number {
    return this.ends.at(-1) ?? 0;
  }

  /** Returns the time in seconds until `count` moves and a share of the next one are made. */
  seconds(count: number, share = 0): number {
    const begin = count === 0 ? 0 : this.ends[count - 1];
    return share === 0 ? begin : begin + share * (this.ends[count] - begin);
  }

  /** Returns the number of moves made after this many seconds, and the share of the next one. */
  at(seconds: number): [count: number, share: number] {
    let [low, high] = [0, this.ends.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.ends[middle] <= seconds) low = middle + 1;
      else high = middle;
    }
    if (low === this.ends.length) return [low, 0];
    const begin = this.seconds(low);
    return [low, (seconds - begin) / (this.ends[low] - begin)];
  }
}

type Place = [number, number, number];

/**
 * Returns the points of a move up to a share of its length, in coordinates of the drawing, with unknown heights of rapid moves at `unknownZ`. Empty if its
 * ends are unknown.
 */
export function wayUpTo({ path, move }: Step, share: number, unknownZ: number): Place[] {
  const points = pointsOfMove(move, 0.001, unknownZ).map(([x, y, z]): Place => [x + path.zero[0], y + path.zero[1], z]);
  const lengths = points.slice(1).map((to, index) => Math.hypot(...to.map((part, axis) => part - points[index][axis])));
  let left = share * lengths.reduce((sum, length) => sum + length, 0);
  const way = points.slice(0, 1);
  for (const [index, length] of lengths.entries()) {
    const part = length > left ? left / length : 1;
    way.push(points[index].map((from, axis) => from + (points[index + 1][axis] - from) * part) as Place);
    left -= length;
    if (left <= 0) break;
  }
  return way;
}

/** Formats seconds as hours, minutes and seconds. */
export function clock(seconds: number): string {
  const whole = Math.round(seconds);
  const two = (part: number) => String(part).padStart(2, "0");
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}
