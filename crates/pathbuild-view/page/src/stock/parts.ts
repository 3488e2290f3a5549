// Errors of finished parts, as regions of the map of heights. Still pictures fill the same regions.

import { FinishedPart, Path, Point, Scene, Shape, cornersOf, pointsOfShape } from "../scene.js";
import { Heights } from "./heights.js";
import { SAGITTA } from "./pieces.js";

/**
 * Marks of a texel: a wrong cut through it; stock left over beside a part or in an outline that is not cut; stock of a part that nothing holds;
 * stock in a corner, of which only what no cut touches is left over.
 */
export const [FORBIDDEN, BESIDE, LOOSE, CORNER] = [1, 2, 4, 8];

/** Width in texels on either side of an outline that counts as neither side, since a texel's height is that of its centre. */
const BAND = 0.75;

type Segment = [Point, Point];

/** Returns the marks of each texel. */
export function marks(map: Heights, scene: Scene): Uint8Array {
  const marked = new Uint8Array(map.columns * map.rows);
  for (const path of scene.paths) for (const part of path.parts ?? []) mark(map, scene, path, part, marked);
  for (const ring of scene.uncut ?? []) {
    const inside = new Uint8Array(marked.length);
    fill(map, ring.flatMap((shape) => segmentsOf(map, shape, [0, 0])), inside, 1);
    inside.forEach((isInside, at) => (marked[at] |= isInside * BESIDE));
  }
  return marked;
}

function mark(map: Heights, scene: Scene, path: Path, part: FinishedPart, marked: Uint8Array): void {
  const segments = (shapes: Shape[]) => shapes.flatMap((shape) => segmentsOf(map, shape, path.zero));
  const inside = new Uint8Array(marked.length);
  // A ring inside an opening never belongs to a part: its area remains open.
  part.rings.forEach((ring, number) => fill(map, segments(ring), inside, number === 0 ? 1 : 0));
  const put = (mark: number, isInside: number) => (at: number) => {
    if (inside[at] === isInside) marked[at] |= mark;
  };
  const radius = (path.tool ?? 0) / 2 / map.texel;
  near(map, segments(part.gouges ?? []), radius, put(FORBIDDEN, 1));
  near(map, segments(part.lost_bars ?? []), radius, (at) => (marked[at] |= FORBIDDEN), false);
  for (const { outline, reach } of part.left) near(map, segments(outline), reach / map.texel + BAND, put(BESIDE, 0));
  for (const { at, reach } of cornersOf(scene, part)) near(map, segments([{ type: "line", from: at, to: at }]), reach / map.texel, put(CORNER, 0));
  if (part.is_loose) inside.forEach((_, at) => put(LOOSE, 1)(at));
}

/** Converts a shape to segments in texels, whose centres have integer coordinates. */
function segmentsOf({ cutting: { box }, texel }: Heights, shape: Shape, zero: Point): Segment[] {
  const points = pointsOfShape(shape, SAGITTA).map(([x, y]): Point => [(x + zero[0] - box[0]) / texel - 0.5, (y + zero[1] - box[1]) / texel - 0.5]);
  return points.slice(1).map((point, index) => [points[index], point]);
}

/** Sets the texels inside a ring. */
function fill({ columns, rows }: Heights, ring: Segment[], into: Uint8Array, value: number): void {
  const crossed: number[][] = Array.from({ length: rows }, () => []);
  for (const [[ax, ay], [bx, by]] of ring) {
    const last = Math.min(rows, Math.ceil(Math.max(ay, by)));
    for (let row = Math.max(0, Math.ceil(Math.min(ay, by))); row < last; row++) crossed[row].push(ax + ((bx - ax) * (row - ay)) / (by - ay));
  }
  crossed.forEach((places, row) => {
    places.sort((a, b) => a - b);
    for (let place = 1; place < places.length; place += 2) {
      const [first, behind] = [Math.max(0, Math.ceil(places[place - 1])), Math.min(columns, Math.ceil(places[place]))];
      if (first < behind) into.fill(value, row * columns + first, row * columns + behind);
    }
  });
}

/** Calls `found` for each texel within a distance, in texels, of segments; beyond their ends only if `isRound` is set. */
function near({ columns, rows }: Heights, segments: Segment[], reach: number, found: (at: number) => void, isRound = true): void {
  for (const [[ax, ay], [bx, by]] of segments) {
    const [dx, dy] = [bx - ax, by - ay];
    const square = dx * dx + dy * dy;
    const [left, right] = [Math.max(0, Math.ceil(Math.min(ax, bx) - reach)), Math.min(columns - 1, Math.floor(Math.max(ax, bx) + reach))];
    const upper = Math.min(rows - 1, Math.floor(Math.max(ay, by) + reach));
    for (let row = Math.max(0, Math.ceil(Math.min(ay, by) - reach)); row <= upper; row++) {
      for (let column = left; column <= right; column++) {
        const along = square === 0 ? 0 : ((column - ax) * dx + (row - ay) * dy) / square;
        const share = Math.min(1, Math.max(0, along));
        if (share !== along && !isRound) continue;
        const [x, y] = [column - ax - dx * share, row - ay - dy * share];
        if (x * x + y * y <= reach * reach) found(row * columns + column);
      }
    }
  }
}
