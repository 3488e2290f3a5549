// The heights of the stock after any number of moves, over a grid of square texels.
//
// A step from one move to another can only change texels that the moves between them touch: forwards these moves are cut, backwards the
// box round them is copied from a keyframe and cut again.

import { Blank, Box, Cutting, EMPTY, WIDTH, joined } from "./pieces.js";

/** Maximum number of texels along the longer side, and of the whole map. */
const [MOST_LONG, MOST_TEXELS] = [2048, 1_200_000];
/** Maximum memory for keyframes in bytes. */
const MOST_BYTES = 64_000_000;
/** Value that stands for a texel without stock, instead of its height in mm. */
export const NOTHING = -1e9;
/** Height in mm by which rapid moves are raised, so that a move along the floor of a cut does not count as cutting. */
const RAPID_RAISE = 0.002;

/** A rectangle of texels: first column, first row, and the column and row after the last ones. */
export type Texels = Box;

interface Keyframe {
  heights: Float32Array;
  rapid: Uint8Array;
  /** Number of pieces that are cut in the keyframe. */
  count: number;
}

export class Heights {
  readonly columns: number;
  readonly rows: number;
  /** Side of a texel in mm. */
  readonly texel: number;
  readonly heights: Float32Array;
  /** Heights of the uncut stock in mm. */
  readonly tops: Float32Array;
  /** Heights in mm at or below which the stock is cut through. */
  readonly through: Float32Array;
  /** 255 for each texel cut by a rapid move, otherwise 0. */
  readonly rapid: Uint8Array;
  /** Whether any rapid move so far has cut. */
  hasRapidCut = false;
  private count = 0;
  /** Texels touched by the last move, if only a part of it is cut. */
  private partial: Texels | null = null;
  private keyframes: Keyframe[] = [];
  private mostKeyframes: number;

  constructor(readonly cutting: Cutting) {
    const [left, lower, right, upper] = cutting.box;
    const [wide, tall] = [right - left, upper - lower];
    this.texel = Math.max(Math.max(wide, tall) / MOST_LONG, Math.sqrt((wide * tall) / MOST_TEXELS));
    [this.columns, this.rows] = [Math.ceil(wide / this.texel), Math.ceil(tall / this.texel)];
    this.tops = new Float32Array(this.columns * this.rows).fill(NOTHING);
    this.through = new Float32Array(this.columns * this.rows);
    for (const blank of cutting.blanks) this.lay(blank);
    this.heights = this.tops.slice();
    this.rapid = new Uint8Array(this.columns * this.rows);
    this.mostKeyframes = Math.floor(MOST_BYTES / (5 * this.columns * this.rows));
  }

  whole(): Texels {
    return [0, 0, this.columns, this.rows];
  }

  /** Cuts the first `moves` moves, and a share of the next one. Returns the texels that may have changed. */
  seek(moves: number, share = 0): Texels | null {
    const wanted = this.until(moves);
    const undone = this.partial;
    if (undone) this.undo(undone);
    const changed = this.cutUpTo(wanted);
    this.partial = share > 0 ? this.cutShare(wanted, this.until(moves + 1), share) : null;
    return [undone, changed, this.partial].reduce((all, texels) => (all && texels ? joined(all, texels) : (all ?? texels)), null);
  }

  /** Returns the number of pieces of the first `moves` moves. */
  private until(moves: number): number {
    return moves === 0 ? 0 : this.cutting.until[moves - 1];
  }

  private cutUpTo(wanted: number): Texels | null {
    if (wanted === this.count) return null;
    const { pieces } = this.cutting;
    const changed = this.touched(pieces, Math.min(wanted, this.count), Math.max(wanted, this.count));
    const keyframe = this.keyframes.filter((it) => it.count <= wanted).at(-1);
    const isBack = wanted < this.count;
    if (isBack || (keyframe && keyframe.count > this.count)) {
      if (changed) this.restore(keyframe, changed);
      if (changed) this.cut(pieces, keyframe?.count ?? 0, wanted, changed);
      this.count = wanted;
    }
    this.advance(wanted);
    return changed;
  }

  /** Restores the texels of the move that was cut only in part. */
  private undo(texels: Texels): void {
    const keyframe = this.keyframes.filter((it) => it.count <= this.count).at(-1);
    this.restore(keyframe, texels);
    this.cut(this.cutting.pieces, keyframe?.count ?? 0, this.count, texels);
  }

  /** Cuts a share of the move that consists of these pieces. */
  private cutShare(from: number, to: number, share: number): Texels | null {
    const pieces = this.cutting.pieces.slice(from * WIDTH, to * WIDTH);
    const lengths = Array.from({ length: to - from }, (_, index) => Math.hypot(...[0, 1, 2].map((axis) => pieces[index * WIDTH + 3 + axis] - pieces[index * WIDTH + axis])));
    let left = share * lengths.reduce((sum, length) => sum + length, 0);
    let count = 0;
    for (const length of lengths) {
      if (left <= 0) break;
      if (length > left) for (const axis of [0, 1, 2]) pieces[count * WIDTH + 3 + axis] = pieces[count * WIDTH + axis] + ((pieces[count * WIDTH + 3 + axis] - pieces[count * WIDTH + axis]) * left) / length;
      left -= length;
      count++;
    }
    const texels = this.touched(pieces, 0, count);
    if (texels) this.cut(pieces, 0, count, texels);
    return texels;
  }

  /** Returns the height at a point, whose coordinates are in mm. */
  at(x: number, y: number): number {
    const [left, lower] = this.cutting.box;
    const [column, row] = [Math.floor((x - left) / this.texel), Math.floor((y - lower) / this.texel)];
    const isInside = column >= 0 && row >= 0 && column < this.columns && row < this.rows;
    return isInside ? this.heights[row * this.columns + column] : NOTHING;
  }

  /** Cuts pieces up to `wanted`, and stores a keyframe after each equal part of all pieces. */
  private advance(wanted: number): void {
    const part = Math.ceil(this.cutting.pieces.length / WIDTH / (this.mostKeyframes + 1));
    while (this.count < wanted) {
      const next = Math.floor(this.count / part) + 1;
      const until = Math.min(wanted, next * part);
      this.cut(this.cutting.pieces, this.count, until, this.whole());
      this.count = until;
      if (until === next * part && this.keyframes.length < next && next <= this.mostKeyframes) {
        this.keyframes.push({ heights: this.heights.slice(), rapid: this.rapid.slice(), count: until });
      }
    }
  }

  /** Adds a rectangle of stock to the uncut map. If several overlap, the highest upper face counts. */
  private lay({ box, top, through }: Blank): void {
    const { columns, rows, texel } = this;
    const [left, lower] = this.cutting.box;
    const begin = Math.floor((box[0] - left) / texel);
    const end = Math.min(columns, Math.ceil((box[2] - left) / texel));
    const last = Math.min(rows, Math.ceil((box[3] - lower) / texel));
    for (let row = Math.floor((box[1] - lower) / texel); row < last; row++) {
      for (let at = row * columns + begin; at < row * columns + end; at++) {
        if (this.tops[at] >= top) continue;
        this.tops[at] = top;
        this.through[at] = through;
      }
    }
  }

  /** Copies texels from a keyframe, or from the uncut stock. */
  private restore(keyframe: Keyframe | undefined, [x0, y0, x1, y1]: Texels): void {
    const heights = keyframe?.heights ?? this.tops;
    for (let row = y0; row < y1; row++) {
      const [from, to] = [row * this.columns + x0, row * this.columns + x1];
      this.heights.set(heights.subarray(from, to), from);
      if (keyframe) this.rapid.set(keyframe.rapid.subarray(from, to), from);
      else this.rapid.fill(0, from, to);
    }
  }

  /** Returns the texels that pieces may touch. */
  private touched(pieces: Float32Array, from: number, to: number): Texels | null {
    const { top } = this.cutting;
    const [left, lower] = this.cutting.box;
    // Plain numbers instead of arrays, because a jump visits hundreds of thousands of pieces.
    let [x0, y0, x1, y1] = EMPTY;
    for (let at = from * WIDTH; at < to * WIDTH; at += WIDTH) {
      if (Math.min(pieces[at + 2], pieces[at + 5]) >= top) continue;
      const radius = pieces[at + 6];
      x0 = Math.min(x0, pieces[at] - radius, pieces[at + 3] - radius);
      y0 = Math.min(y0, pieces[at + 1] - radius, pieces[at + 4] - radius);
      x1 = Math.max(x1, pieces[at] + radius, pieces[at + 3] + radius);
      y1 = Math.max(y1, pieces[at + 1] + radius, pieces[at + 4] + radius);
    }
    const first = (side: number, origin: number) => Math.max(0, Math.floor((side - origin) / this.texel) - 1);
    const behind = (side: number, origin: number, most: number) => Math.min(most, Math.ceil((side - origin) / this.texel) + 1);
    const texels: Texels = [first(x0, left), first(y0, lower), behind(x1, left, this.columns), behind(y1, lower, this.rows)];
    return texels[0] < texels[2] && texels[1] < texels[3] ? texels : null;
  }

  /** Cuts pieces where they touch these texels. Each piece is the area within a radius of a segment, filled row by row. */
  private cut(pieces: Float32Array, from: number, to: number, [x0, y0, x1, y1]: Texels): void {
    const { top, box } = this.cutting;
    const { heights, rapid, columns } = this;
    const scale = 1 / this.texel;
    for (let at = from * WIDTH; at < to * WIDTH; at += WIDTH) {
      const isRapid = pieces[at + 7] > 0;
      const raise = isRapid ? RAPID_RAISE : 0;
      const [begin, end] = [pieces[at + 2] + raise, pieces[at + 5] + raise];
      if (Math.min(begin, end) >= top) continue;
      // Coordinates in texels, whose centres are at integers.
      const ax = (pieces[at] - box[0]) * scale - 0.5;
      const ay = (pieces[at + 1] - box[1]) * scale - 0.5;
      const bx = (pieces[at + 3] - box[0]) * scale - 0.5;
      const by = (pieces[at + 4] - box[1]) * scale - 0.5;
      const radius = pieces[at + 6] * scale;
      const square = radius * radius;
      const [dx, dy] = [bx - ax, by - ay];
      const length = Math.sqrt(dx * dx + dy * dy);
      const isPoint = length < 1e-6;
      const [ux, uy] = isPoint ? [1, 0] : [dx / length, dy / length];
      const slope = isPoint ? 0 : (end - begin) / length;
      const low = Math.min(begin, end);
      const round = pieces[at + 8] * scale;
      const flat = radius - round;
      const last = Math.min(y1 - 1, Math.floor(Math.max(ay, by) + radius));
      for (let row = Math.max(y0, Math.ceil(Math.min(ay, by) - radius)); row <= last; row++) {
        // The least and greatest column of this row: those of the discs at both ends and of the two sides between them.
        let [least, most] = [Infinity, -Infinity];
        const [va, vb] = [row - ay, row - by];
        if (va * va <= square) {
          const half = Math.sqrt(square - va * va);
          least = ax - half;
          most = ax + half;
        }
        if (vb * vb <= square) {
          const half = Math.sqrt(square - vb * vb);
          least = Math.min(least, bx - half);
          most = Math.max(most, bx + half);
        }
        if (dy !== 0) {
          for (let side = -radius; ; side = radius) {
            const share = (va - ux * side) / dy;
            const x = ax + dx * share - uy * side;
            if (share >= 0 && share <= 1) {
              least = Math.min(least, x);
              most = Math.max(most, x);
            }
            if (side === radius) break;
          }
        }
        const first = row * columns + Math.max(x0, Math.ceil(least));
        const final = row * columns + Math.min(x1 - 1, Math.floor(most));
        for (let cell = first; cell <= final; cell++) {
          let z = low;
          if (slope !== 0 || round > 0) {
            // The cutter covers this texel from `along - half` to `along + half`. If it is flat, it is lowest at one of these ends.
            const across = cell - row * columns - ax;
            const along = across * ux + va * uy;
            const beside = va * ux - across * uy;
            const half = Math.sqrt(Math.max(0, square - beside * beside));
            z =
              round === 0
                ? begin + slope * (slope > 0 ? Math.max(along - half, 0) : Math.min(along + half, length))
                : begin + this.texel * roundHeight(slope * scale, along, beside, Math.max(along - half, 0), Math.min(along + half, length), flat, round);
          }
          if (heights[cell] > z) {
            heights[cell] = z;
            if (isRapid) {
              rapid[cell] = 255;
              this.hasRapidCut = true;
            }
          }
        }
      }
    }
  }
}

/** Number of steps of the search for the lowest place of a bull nose. */
const SEARCH_STEPS = 14;

/**
 * Returns the least height of a cutter with round corners over a texel while it moves from `first` to `last`. The texel is at `along`, and at
 * `beside` from the line of the move. All values are in texels.
 */
function roundHeight(slope: number, along: number, beside: number, first: number, last: number, flat: number, round: number): number {
  const height = (at: number): number => {
    const outside = Math.min(Math.max(Math.hypot(beside, along - at) - flat, 0), round);
    return slope * at + round - Math.sqrt(round * round - outside * outside);
  };
  const within = (at: number) => Math.min(Math.max(at, first), last);
  if (slope === 0) return height(within(along));
  if (flat < 1e-6) return height(within(along - slope * Math.sqrt(Math.max(0, round * round - beside * beside) / (1 + slope * slope))));
  // The height is a convex function of the place.
  for (let step = 0; step < SEARCH_STEPS; step++) {
    const third = (last - first) / 3;
    if (height(first + third) < height(last - third)) last -= third;
    else first += third;
  }
  return height((first + last) / 2);
}
