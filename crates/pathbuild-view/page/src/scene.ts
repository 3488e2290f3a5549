// The scene as data, in the format of pathbuild-view's src/scene.rs, version 1.

import type { ProgramRecord } from "./programs.js";
import type { Finding } from "../../../../packaging/npm/index.js";

export type { Finding };
export type Point = [number, number];
export type Point3 = [number, number, number];
export type Place = [number | null, number | null, number | null];

export interface Arc {
  axes: [number, number];
  centre: Point;
  clockwise: boolean;
  degrees: number;
}

export type MoveKind = "sweep" | "lift" | "plunge" | "mill" | "mark" | "probe";

export interface Move {
  kind: MoveKind;
  from: Place;
  to: Place;
  arc?: Arc;
  feed?: number;
  length: number;
  element?: number;
  line?: number;
  /** Cutter of the move, as an index into the tools of its path. */
  tool?: number;
}

export type Shape =
  | { type: "line"; from: Point; to: Point }
  | { type: "arc"; from: Point; to: Point; centre: Point; radius: number; clockwise: boolean; degrees: number }
  | { type: "circle"; centre: Point; radius: number };

export interface Element {
  path: number;
  kind: string;
  entity: string;
  layer: string;
  handle: string | null;
  line: number | null;
  shape: Shape;
  order: number | null;
  parameters?: Parameter[];
}

export interface Parameter {
  letter: string;
  value: string;
  from: "own" | "chain" | "path" | "lender" | "option" | "default";
  which?: string;
  /** The line of pathbuild.toml that contains an option's value. */
  line?: number;
}

export interface Label {
  path: number;
  text: string;
  at: Point;
  radius: number;
  elements: number[];
}

export interface Embedded {
  name: string;
  file: string;
  ends: [Point, Point];
  raised: number;
  thickness: number;
  sweep_height: number;
}

/** The shape of a cutter's tip, if it is not flat: the radius of its corners in mm, or unknown. */
export type Tip = { round: number } | "unknown";

export interface Path {
  name: string;
  file: string;
  zero: Point;
  tool: number | null;
  tip?: Tip;
  /** Cutters of a program that was read. */
  tools?: { line: number; diameter: number; tip?: Tip }[];
  thickness: number | null;
  material: string | null;
  /** Speed of rapid moves in mm/min. */
  rapid?: number | null;
  embedded: Embedded[];
  elements: Element[];
  texts: Label[];
  bars: { element: number; shape: Shape; top: number }[];
  parts?: FinishedPart[];
  probes: { number: number; at: Point; height: number; label: string | null }[];
  moves: Move[];
  totals: { milling: number; drilling: number; sweeps: number; minutes: number | null } | null;
  gcode: string | null;
  written: string | null;
  refusal?: { en: string; de: string };
  native?: { gcode: string; lines: (number | null)[] };
  examples?: { name: string; value: string | null }[];
}

export interface FinishedPart {
  rings: Shape[][];
  top: number;
  left: { outline: Shape[]; reach: number }[];
  /** Inner corners that the cutter does not reach, with the distance at which it touches both sides. */
  corners?: { at: Point; reach: number }[];
  gouges?: Shape[];
  lost_bars?: Shape[];
  is_loose?: boolean;
}

export interface KeepOut {
  layer: string;
  outline: Shape[];
  height: number;
}

/** Returns the cutter diameter of a move in mm. */
export function toolOf(path: Path, move: Move): number | null {
  return spanOf(path, move)?.diameter ?? path.tool;
}

/** Returns the shape of the tip of a move's cutter; `undefined` if it is flat. */
export function tipOf(path: Path, move: Move): Tip | undefined {
  const own = spanOf(path, move);
  return own ? own.tip : path.tip;
}

function spanOf({ tools }: Path, move: Move) {
  return move.tool === undefined ? undefined : tools?.[move.tool];
}

export interface Scene {
  /** Facts about a program dropped on the page. */
  program?: ProgramRecord;
  schema: string;
  version: number;
  title: string;
  /** Height in mm above the plate at or below which a cut goes through the material. */
  through: number;
  paths: Path[];
  other_layers: ({ type: "shape"; layer: string; shape: Shape } | { type: "text"; text: string; at: Point })[];
  keep_outs: KeepOut[];
  /** Outlines of parts that no path cuts. */
  uncut?: Shape[][];
  findings: Finding[];
}

/** Returns the corners of a part that the cutter does not reach, if a finding (PB216) is about such corners. */
export function cornersOf({ findings }: Scene, { corners }: FinishedPart): { at: Point; reach: number }[] {
  return findings.some(({ code }) => code === "PB216") ? (corners ?? []) : [];
}

/** Largest angle in degrees of an arc that is approximated by one chord. */
const STEP = 6;

/** Returns the angle in degrees of a chord that stays within `sagitta` mm of its arc. */
function step(radius: number, sagitta: number): number {
  return Math.min(STEP, (360 / Math.PI) * Math.acos(Math.max(-1, 1 - sagitta / radius)) || STEP);
}

/** Maximum distance in mm between a drawn arc and its chords. */
const SAGITTA = 0.02;

/**
 * Returns the points of a move from start to end; empty if its route is unknown. Chords stay within `sagitta` mm of an arc. Ends of rapid moves at an
 * unknown height are at `unknownZ` if it is given; other unknown heights are those of the move's other end, or 0.
 */
export function pointsOfMove(move: Move, sagitta = SAGITTA, unknownZ?: number): [number, number, number][] {
  const { from, to, arc } = move;
  const z = (place: Place) => place[2] ?? (isRapid(move.kind) ? unknownZ : undefined) ?? from[2] ?? to[2] ?? 0;
  if (from[0] === null || from[1] === null || to[0] === null || to[1] === null) return [];
  const begin: [number, number, number] = [from[0], from[1], z(from)];
  const end: [number, number, number] = [to[0], to[1], z(to)];
  if (!arc) return [begin, end];
  const [a, b] = arc.axes;
  const third = 3 - a - b;
  const spoke = (at: number[]) => [at[a] - arc.centre[0], at[b] - arc.centre[1]];
  const [x, y] = spoke(begin);
  const [radius, last] = [Math.hypot(x, y), Math.hypot(...(spoke(end) as Point))];
  const start = Math.atan2(y, x);
  const pieces = Math.max(2, Math.ceil(arc.degrees / step(Math.max(radius, last), sagitta)));
  const way = ((arc.clockwise ? -1 : 1) * arc.degrees * Math.PI) / 180;
  const points = [begin];
  for (let piece = 1; piece < pieces; piece++) {
    const share = piece / pieces;
    const r = radius + (last - radius) * share;
    const at: [number, number, number] = [0, 0, 0];
    at[a] = arc.centre[0] + r * Math.cos(start + way * share);
    at[b] = arc.centre[1] + r * Math.sin(start + way * share);
    at[third] = begin[third] + (end[third] - begin[third]) * share;
    points.push(at);
  }
  points.push(end);
  return points;
}

/** Returns the least and greatest coordinates of a move in mm, exactly also for arcs; `null` if its route is unknown. */
export function extentOfMove(move: Move): [low: Point3, high: Point3] | null {
  const [begin, ...others] = pointsOfMove({ ...move, arc: undefined });
  if (!begin) return null;
  const [low, high]: [Point3, Point3] = [[...begin], [...begin]];
  for (const point of [...others, ...(move.arc ? extremes(begin, move.arc) : [])]) {
    point.forEach((value, axis) => {
      low[axis] = Math.min(low[axis], value);
      high[axis] = Math.max(high[axis], value);
    });
  }
  return [low, high];
}

/** Returns the points of an arc that are farthest along one of the axes of its plane. */
function extremes(begin: Point3, { axes: [a, b], centre, clockwise, degrees }: Arc): Point3[] {
  const [x, y] = [begin[a] - centre[0], begin[b] - centre[1]];
  const radius = Math.hypot(x, y);
  const start = (Math.atan2(y, x) * 180) / Math.PI;
  return [0, 90, 180, 270].flatMap((angle) => {
    const turn = ((((clockwise ? start - angle : angle - start) % 360) + 360) % 360);
    if (turn > degrees) return [];
    const at: Point3 = [...begin];
    at[a] = centre[0] + radius * Math.round(Math.cos((angle * Math.PI) / 180));
    at[b] = centre[1] + radius * Math.round(Math.sin((angle * Math.PI) / 180));
    return [at];
  });
}

/** Returns the lowest Z of a move in mm; `null` if no height is known. */
export function depthOfMove(move: Move): number | null {
  const ends = [move.from[2], move.to[2]].filter((z) => z !== null);
  const lowest = move.arc ? extentOfMove(move)?.[0][2] : undefined;
  return lowest ?? (ends.length > 0 ? Math.min(...ends) : null);
}

/** Returns the points of a shape. Chords stay within `sagitta` mm of an arc. */
export function pointsOfShape(shape: Shape, sagitta = Infinity): Point[] {
  if (shape.type === "line") return [shape.from, shape.to];
  const { centre, radius } = shape;
  const degrees = shape.type === "circle" ? 360 : shape.degrees;
  const start = shape.type === "circle" ? 0 : Math.atan2(shape.from[1] - centre[1], shape.from[0] - centre[0]);
  const way = ((shape.type === "arc" && shape.clockwise ? -1 : 1) * degrees * Math.PI) / 180;
  const pieces = Math.max(2, Math.ceil(degrees / step(radius, sagitta)));
  return Array.from({ length: pieces + 1 }, (_, piece): Point => {
    const angle = start + (way * piece) / pieces;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
  });
}

export function isCut(kind: MoveKind): boolean {
  return kind === "mill" || kind === "mark" || kind === "plunge";
}

export function isRapid(kind: MoveKind): boolean {
  return kind === "sweep" || kind === "lift";
}

/** Returns the point halfway along an arc. */
export function middleOfArc({ from, centre, clockwise, degrees }: Extract<Shape, { type: "arc" }>): Point {
  const [x, y] = [from[0] - centre[0], from[1] - centre[1]];
  const angle = ((clockwise ? -1 : 1) * degrees * Math.PI) / 360;
  return [centre[0] + x * Math.cos(angle) - y * Math.sin(angle), centre[1] + x * Math.sin(angle) + y * Math.cos(angle)];
}

/** Distance in mm up to which two places are equal. */
const SAME_PLACE = 1e-3;

function isNear([x, y]: Point, other: Point): boolean {
  return Math.hypot(x - other[0], y - other[1]) < SAME_PLACE;
}

function ends(shape: Shape): [Point, Point] {
  return shape.type === "circle" ? [shape.centre, shape.centre] : [shape.from, shape.to];
}

/** Whether elements of two versions have the same shape at the same place, drawn in either direction. */
export function isSamePlace({ shape: one }: Element, { shape: other }: Element): boolean {
  const [[a, b], [c, d]] = [ends(one), ends(other)];
  if (!(isNear(a, c) && isNear(b, d)) && !(isNear(a, d) && isNear(b, c))) return false;
  if (one.type === "circle") return other.type === "circle" && Math.abs(one.radius - other.radius) < SAME_PLACE;
  if (one.type === "arc") return other.type === "arc" && isNear(middleOfArc(one), middleOfArc(other));
  return other.type === "line";
}

/** Whether elements of two versions have the same handle, and also the same kind or a common end: some CAD programs give a handle to another element. */
export function isSameHandle(one: Element, other: Element): boolean {
  const hasCommonEnd = () => ends(one.shape).some((end) => ends(other.shape).some((place) => isNear(end, place)));
  return one.handle !== null && one.handle === other.handle && one.shape.type === other.shape.type && (one.kind === other.kind || hasCommonEnd());
}
