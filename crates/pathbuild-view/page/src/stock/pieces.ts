// The moves as straight pieces of the cutter's path, and the stock that they are cut from.

import { Move, Path, Scene, isCut, isRapid, pointsOfMove, tipOf, toolOf } from "../scene.js";

/** Number of values of a piece: from x y z, to x y z, the cutter's radius, 1 for a rapid move, and the radius of the cutter's corners. */
export const WIDTH = 9;

/** A rectangle in mm: left, lower, right and upper side. */
export type Box = [number, number, number, number];

/** A rectangle of stock with the upper face and plate of one or more paths, as large as the cuts of these paths need. */
export interface Blank {
  box: Box;
  /** Z of the upper face in mm. */
  top: number;
  /** Z in mm at or below which a cut goes through the stock. If Z = 0 is the upper face, no cut does. */
  through: number;
}

/** Values entered by the user that a program read from a file does not state. */
export interface Assumed {
  tool: number | null;
  thickness: number | null;
  /** Z of the upper face in mm. */
  surface: number | null;
}

export interface Cutting {
  pieces: Float32Array;
  /** Number of pieces up to the end of each move. */
  until: Uint32Array;
  blanks: Blank[];
  box: Box;
  /** Highest upper face and deepest cut in mm. */
  top: number;
  low: number;
  /** Whether the shape of a cutter is unknown, so that its cuts have a flat bottom. */
  hasUnknownTip: boolean;
}

/** Maximum distance in mm between an arc and its chords. */
export const SAGITTA = 0.004;

export function joined(a: Box, b: Box): Box {
  return [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
}

export const EMPTY: Box = [Infinity, Infinity, -Infinity, -Infinity];

/** Returns the pieces of all moves; `null` if no cutter is known or nothing is cut. */
export function cutting(scene: Scene, assumed: Assumed): Cutting | null {
  const numbers: number[] = [];
  const until: number[] = [];
  const blanks = new Map<string, Blank>();
  let low = Infinity;
  let hasUnknownTip = false;
  for (const path of scene.paths) {
    for (const move of path.moves) {
      const tool = toolOf(path, move) ?? assumed.tool;
      const radius = (tool ?? 0) / 2;
      const tip = tipOf(path, move);
      const round = typeof tip === "object" ? Math.min(tip.round, radius) : 0;
      const rapidly = isRapid(move.kind);
      // Whether a rapid move at an unknown height hits material is unknown as well.
      const isUnknown = move.kind === "probe" || (rapidly && [...move.from, ...move.to].includes(null));
      const points = tool === null || isUnknown ? [] : pointsOfMove(move, SAGITTA);
      for (const at of points) for (const axis of [0, 1]) at[axis] += path.zero[axis];
      for (let index = 1; index < points.length; index++) numbers.push(...points[index - 1], ...points[index], radius, rapidly ? 1 : 0, round);
      until.push(numbers.length / WIDTH);
      if (!isCut(move.kind) || points.length === 0) continue;
      hasUnknownTip ||= tip === "unknown";
      const [top, raised] = faces(scene, path, move, assumed);
      const through = top > raised ? raised + scene.through : -Infinity;
      const name = `${top} ${through}`;
      let box = blanks.get(name)?.box ?? EMPTY;
      for (const [x, y, z] of points) {
        box = joined(box, [x - 2 * radius, y - 2 * radius, x + 2 * radius, y + 2 * radius]);
        low = Math.min(low, z);
      }
      blanks.set(name, { box, top, through });
    }
  }
  if (blanks.size === 0) return null;
  const all = [...blanks.values()];
  widen(all, numbers);
  return {
    pieces: new Float32Array(numbers),
    until: new Uint32Array(until),
    blanks: all,
    box: all.map((it) => it.box).reduce(joined),
    top: Math.max(...all.map((it) => it.top)),
    low,
    hasUnknownTip,
  };
}

/** Widens the lowest blank by the rapid moves below every upper face: they run through material wherever the stock reaches that far. */
function widen(blanks: Blank[], pieces: number[]): void {
  const lowest = blanks.reduce((one, other) => (other.top < one.top ? other : one));
  for (let at = 0; at < pieces.length; at += WIDTH) {
    if (pieces[at + 7] === 0 || Math.min(pieces[at + 2], pieces[at + 5]) >= lowest.top) continue;
    const [ax, ay, , bx, by, , radius] = pieces.slice(at, at + WIDTH);
    const margin = 2 * radius;
    lowest.box = joined(lowest.box, [Math.min(ax, bx) - margin, Math.min(ay, by) - margin, Math.max(ax, bx) + margin, Math.max(ay, by) + margin]);
  }
}

/** Returns Z of the upper face and of the plate where a move cuts, in mm: components may be raised. */
function faces(scene: Scene, path: Path, move: Move, assumed: Assumed): [number, number] {
  const element = move.element === undefined ? undefined : path.elements[move.element];
  const component = path.embedded[element?.path ?? 0];
  const known = component?.thickness ?? path.thickness;
  if (known !== null) return [known, component?.raised ?? 0];
  const thickness = assumed.thickness ?? 0;
  // Only on Z 0 does the thickness lift the upper face.
  const top = assumed.surface ?? (scene.program?.is_on_zero ? thickness : 0);
  return [top, top - thickness];
}
