// The operations of a scene: the cuts between two rapid moves in the plane, or the sections of a program that names them in comments.

import { Model } from "./model.js";
import { MoveKind, depthOfMove, isCut, toolOf } from "./scene.js";
import { Timeline } from "./timeline.js";

export interface Operation {
  /** Range of the operation's moves, excluding the end. */
  moves: [number, number];
  kind: MoveKind;
  /** Name of the operation: numbers of elements, or the comment above it. */
  name: string;
  /** Lowest Z of the operation in mm. */
  depth: number | null;
  /** Length of the operation's cuts in mm. */
  length: number;
  seconds: number;
  tool: number | null;
}

/** Number of operations without names above which no table is shown, because it would be of no use. */
export const MOST_OPERATIONS = 2000;

export function operations(model: Model, timeline: Timeline): Operation[] {
  const { steps } = model;
  const sections = sectionsOf(model);
  const found: Operation[] = [];
  let current: Operation | null = null;
  let numbers: [number, number] | null = null;
  let hasTravelled = true;
  const close = (end: number) => {
    if (!current) return;
    current.moves[1] = end;
    current.seconds = timeline.seconds(end) - timeline.seconds(current.moves[0]);
    if (numbers && !current.name) current.name = numbers[0] === numbers[1] ? String(numbers[0]) : `${numbers[0]}–${numbers[1]}`;
    [current, numbers] = [null, null];
  };
  let last = 0;
  steps.forEach(({ path, move }, index) => {
    if (!isCut(move.kind)) {
      hasTravelled ||= move.kind === "sweep";
      return;
    }
    const isNamed = sections !== null;
    const isNew = isNamed ? !current || sections[index] !== sections[last] : hasTravelled;
    if (!current || isNew || steps[last].path !== path || current.tool !== toolOf(path, move)) {
      close(last + 1);
      current = { moves: [index, index + 1], kind: move.kind, name: sections?.[index] ?? "", depth: null, length: 0, seconds: 0, tool: toolOf(path, move) };
      found.push(current);
    }
    [hasTravelled, last] = [false, index];
    current.length += move.length;
    if (current.kind === "plunge") current.kind = move.kind;
    const depth = depthOfMove(move);
    if (depth !== null && depth < (current.depth ?? Infinity)) current.depth = depth;
    const order = move.element === undefined ? null : path.elements[move.element].order;
    if (order !== null) numbers = numbers ? [Math.min(numbers[0], order), Math.max(numbers[1], order)] : [order, order];
  });
  close(last + 1);
  return found;
}

/** Returns the comment above each move if comments divide the program into a few sections, otherwise `null`. */
function sectionsOf({ steps }: Model): string[] | null {
  if (steps.length === 0 || steps.some(({ path }) => path.elements.length > 0 || !path.gcode)) return null;
  const names: string[] = [];
  const found = new Set<string>();
  let [path, lines, next, name] = [steps[0].path, steps[0].path.gcode!.split("\n"), 0, ""];
  let run = 0;
  for (const { path: own, move } of steps) {
    if (own !== path) [path, lines, next, name] = [own, own.gcode!.split("\n"), 0, ""];
    for (; next < (move.line ?? 0) - 1; next++) {
      const comment = /^\s*(?:N\d+\s*)?(?:\((.*)\)|;(.*))\s*$/.exec(lines[next]);
      const text = (comment?.[1] ?? comment?.[2] ?? "").trim();
      if (text) [name, run] = [text, run + 1];
    }
    names.push(name);
    if (isCut(move.kind)) found.add(`${run} ${name}`);
  }
  return found.size > 1 && found.size <= 200 ? names : null;
}
