// The moves of all paths in sequence, converted once into flat arrays.

import { Color, color as named, depthColor, depths } from "./palette.js";
import { Move, Path, Scene, depthOfMove, isCut, pointsOfMove, pointsOfShape, toolOf } from "./scene.js";

export interface Step {
  path: Path;
  move: Move;
}

/** Lines of moves in the same style: 6 numbers for each piece, and the number of pieces up to each step. */
export interface Pieces {
  points: number[];
  colors: number[];
  until: number[];
  step: number[];
}

export interface Model {
  steps: Step[];
  /** Discs as wide as the cutter, in triangles: three points each. */
  holes: Pieces;
  cuts: Pieces;
  rapids: Pieces;
  arrows: Pieces;
  rapidArrows: Pieces;
  /** The box round the drawing and its cuts, up to the highest move. */
  low: [number, number, number];
  high: [number, number, number];
  /** Z at which ends of rapid moves with an unknown height are drawn: the highest known one, because the tool is usually above it. */
  unknownZ: number;
  deepest: number;
  shallowest: number;
}

export function model(scene: Scene): Model {
  const steps = scene.paths.flatMap((path) => path.moves.map((move) => ({ path, move })));
  const heights = steps.filter((it) => isCut(it.move.kind)).map((it) => depthOfMove(it.move) ?? 0);
  const shallowest = heights.reduce((a, b) => Math.max(a, b), -Infinity);
  const deepest = heights.reduce((a, b) => Math.min(a, b), Infinity);
  const empty = (): Pieces => ({ points: [], colors: [], until: [], step: [] });
  const made: Model = {
    steps,
    holes: empty(),
    cuts: empty(),
    rapids: empty(),
    arrows: empty(),
    rapidArrows: empty(),
    low: [Infinity, Infinity, Infinity],
    high: [-Infinity, -Infinity, -Infinity],
    unknownZ: steps.reduce((highest, { move }) => Math.max(highest, move.from[2] ?? -Infinity, move.to[2] ?? -Infinity), -Infinity),
    deepest,
    shallowest,
  };
  if (made.unknownZ === -Infinity) made.unknownZ = 0;
  const grow = (at: number[]) => {
    for (let axis = 0; axis < 3; axis++) {
      made.low[axis] = Math.min(made.low[axis], at[axis]);
      made.high[axis] = Math.max(made.high[axis], at[axis]);
    }
  };
  for (const path of scene.paths) {
    for (const { shape } of path.elements) for (const [x, y] of pointsOfShape(shape)) grow([x + path.zero[0], y + path.zero[1], 0]);
  }
  for (const shape of scene.keep_outs.flatMap((it) => it.outline)) for (const [x, y] of pointsOfShape(shape)) grow([x, y, 0]);
  for (const [x, y] of scene.findings.flatMap((it) => (it.at ? [it.at] : []))) grow([x, y, 0]);
  const flat = steps.map(({ path, move }) =>
    pointsOfMove(move, undefined, made.unknownZ).map(([x, y, z]): [number, number, number] => [x + path.zero[0], y + path.zero[1], z]),
  );
  const hasElements = scene.paths.some((path) => path.elements.length > 0);
  flat.forEach((points, index) => {
    const { path, move } = steps[index];
    const radius = isCut(move.kind) ? (toolOf(path, move) ?? 0) / 2 : 0;
    for (const [, , z] of points) made.high[2] = Math.max(made.high[2], z);
    if (!isCut(move.kind) && hasElements) return;
    for (const [x, y, z] of points) for (const side of [-radius, radius]) grow([x + side, y + side, z]);
  });
  if (!Number.isFinite(made.low[0])) {
    made.low = [0, 0, 0];
    made.high = [10, 10, 0];
  }
  const extent = Math.max(made.high[0] - made.low[0], made.high[1] - made.low[1], 1);
  const [stops, rapid]: [Color[], Color] = [depths(), named("rapid")];
  steps.forEach(({ path, move }, index) => {
    const cuts = isCut(move.kind);
    const share = shallowest > deepest ? (shallowest - (depthOfMove(move) ?? 0)) / (shallowest - deepest) : 0.5;
    const color = cuts ? depthColor(stops, share) : rapid;
    const into = cuts ? made.cuts : made.rapids;
    const points = flat[index];
    for (let piece = 1; piece < points.length; piece++) push(into, points[piece - 1], points[piece], color, index);
    arrow(cuts ? made.arrows : made.rapidArrows, points, color, index, extent);
    if (isHole(path, move, steps[index + 1]?.move)) disc(made.holes, points.at(-1)!, (toolOf(path, move) ?? extent * DOT) / 2, color, index);
    for (const pieces of [made.holes, made.cuts, made.rapids, made.arrows, made.rapidArrows]) pieces.until.push(pieces.step.length);
  });
  return made;
}

/** Diameter of a hole's disc if the cutter is unknown, as a share of the picture's size. */
const DOT = 0.012;

/** Whether an element consists of this plunge alone or, in a program without elements, whether no cut starts at its end. */
function isHole({ elements }: Path, { kind, element, to }: Move, next: Move | undefined): boolean {
  const isAlone = element === undefined ? next?.kind !== "mill" : elements[element].shape.type === "circle";
  return kind === "plunge" && to[0] !== null && to[1] !== null && isAlone;
}

/** Number of triangles of a disc. */
const SECTORS = 24;

function disc(into: Pieces, [x, y, z]: number[], radius: number, color: number[], step: number): void {
  const rim = (sector: number) => [x + radius * Math.cos((2 * Math.PI * sector) / SECTORS), y + radius * Math.sin((2 * Math.PI * sector) / SECTORS), z];
  for (let sector = 0; sector < SECTORS; sector++) {
    into.points.push(x, y, z, ...rim(sector), ...rim(sector + 1));
    into.colors.push(...color, ...color, ...color);
    into.step.push(step);
  }
}

function push(into: Pieces, from: number[], to: number[], color: number[], step: number): void {
  into.points.push(...from, ...to);
  into.colors.push(...color, ...color);
  into.step.push(step);
}

/** Adds an arrowhead of two strokes at three fifths of a move. */
function arrow(into: Pieces, points: number[][], color: number[], step: number, extent: number): void {
  if (points.length < 2) return;
  const piece = points.length === 2 ? 1 : Math.floor(points.length * 0.6);
  const [from, to] = [points[piece - 1], points[piece]];
  const way = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(way[0], way[1]);
  const whole = points.length === 2 ? length : length * points.length;
  const size = Math.min(extent * 0.012, whole * 0.3);
  if (length === 0 || whole < extent * 0.02) return;
  const share = points.length === 2 ? 0.6 : 1;
  const tip = [0, 1, 2].map((axis) => from[axis] + (to[axis] - from[axis]) * share);
  const [dx, dy] = way.map((part) => (part / length) * size);
  for (const side of [1, -1]) {
    push(into, tip, [tip[0] - dx + side * dy * 0.5, tip[1] - dy - side * dx * 0.5, tip[2]], color, step);
  }
}
