// Facts about a move or about the whole scene: pairs of a name and a value, listed beside the picture.

import { $, node } from "./dom.js";
import { Step } from "./model.js";
import { Move, Parameter, Path, Scene, extentOfMove, isCut } from "./scene.js";
import { Timeline } from "./timeline.js";
import { Lang, Word, mm, say, sayKind, sayOption, wholeMm } from "./words.js";

export type Facts = [name: string, value: string][];

/** Returns the facts about a move and its element. `numbered` is the line of the step, with its number. */
export function factsOfStep(at: number, { path, move }: Step, numbered: [number, string] | null, lang: Lang): Facts {
  const list: Facts = [[say("step", lang), `${at + 1}: ${sayKind(move.kind, lang)}`]];
  list.push(["→", coordinates(move.to, mm)]);
  if (move.feed) list.push([say("feed", lang), `${mm(move.feed)} mm/min`]);
  if (numbered) list.push(["G-code", numbered.join(": ")]);
  const element = move.element === undefined ? undefined : path.elements[move.element];
  if (element) {
    const inside = path.embedded[element.path];
    const own = path.texts.filter((label) => label.elements.includes(move.element!));
    const starts = path.elements.flatMap((it, index) => (it.path === element.path && it.kind === "start" ? [index] : []));
    const ofPath = path.texts.filter((label) => label.elements.some((index) => starts.includes(index)));
    const joined = (labels: { text: string }[]) => labels.map((label) => label.text).join(" | ") || say("none", lang);
    list.push([say("element", lang), `${element.entity} ${element.handle ?? ""} · ${sayKind(element.kind, lang)}`]);
    list.push([say("layer", lang), element.layer]);
    if (element.line !== null) list.push([say("line", lang), `${element.line} · ${inside?.file ?? path.file}`]);
    list.push([say("fromOwn", lang), joined(own)]);
    list.push([`${say("pathText", lang)} ${inside?.name ?? path.name}`, joined(ofPath)]);
    for (const parameter of element.parameters ?? []) list.push([parameter.letter, `${parameter.value} · ${provider(parameter, lang)}`]);
  }
  return list;
}

/** Describes the origin of a parameter. */
function provider({ from, which, line }: Parameter, lang: Lang): string {
  if (line !== undefined) return `\`${which ?? ""}\` ${say("fromLine", lang)} ${line}`;
  const words = { own: "fromOwn", chain: "fromChain", path: "fromPath", lender: "fromLender", option: "fromOption", default: "fromDefault" } as const;
  return `${say(words[from], lang)}${from === "option" ? "" : " "}${which ?? ""}`.trim();
}

/** Returns the facts about the whole scene. */
export function factsOfScene(scene: Scene, timeline: Timeline, lang: Lang): Facts {
  const list: Facts = [];
  for (const path of scene.paths) {
    list.push([say(path.name === path.file ? "program" : "path", lang), path.name === path.file ? path.name.replace(/^.*[\\/]/, "") : `${path.name} · ${path.file}`]);
    if (scene.program) list.push([say("readAs", lang), scene.program.read_as[lang]]);
    for (const [word, box] of path.elements.length === 0 ? extents(path) : []) list.push([say(word, lang), box]);
    if (path.tools && path.tool === null) list.push([say("tools", lang), path.tools.map(({ diameter }) => mm(diameter)).join(", ")]);
    if (path.tool !== null) list.push([say("cutterO", lang), mm(path.tool)]);
    if (path.thickness !== null) list.push([say("thickness", lang), mm(path.thickness)]);
    if (path.material) list.push([say("materialM", lang), path.material]);
    const { totals } = path;
    if (totals && path.moves.length > 0) {
      for (const kind of Object.keys(TOTALS) as (keyof typeof TOTALS)[]) list.push([say(TOTALS[kind], lang), `${wholeMm(totals[kind])} mm`]);
      const { cutting, isKnown, total } = timeline;
      const isOnly = scene.paths.length === 1;
      if (totals.minutes !== null) list.push([say("time", lang), `${totals.minutes} min`]);
      else if (isKnown && isOnly) list.push([say("time", lang), `${Math.ceil(total / 60)} min`]);
      else if (cutting !== null && isOnly) list.push([say("time", lang), `${Math.ceil(cutting / 60)} min ${say("withoutRapids", lang)}`]);
    }
    if (scene.program?.waits) list.push([say("waits", lang), scene.program.waits[lang]]);
    const examples = path.examples ?? [];
    const known = examples.filter(({ value }) => value !== null).map(({ name, value }) => `${name} ${value}`);
    const unknown = examples.filter(({ value }) => value === null).map(({ name }) => sayOption(name, lang));
    if (known.length > 0) list.push([say("examples", lang), known.join(", ")]);
    if (unknown.length > 0) list.push([say("notGiven", lang), unknown.join(", ")]);
  }
  return list;
}

/** Keys of the words for total lengths. */
const TOTALS = { milling: "mill", drilling: "drilling", sweeps: "sweep" } as const;

const known = new WeakMap<Path, [Word, string][]>();

/** Formats the extents of a program's moves and of its cuts. They are stored, because computing them is slow for a long program. */
function extents(path: Path): [Word, string][] {
  const cuts = path.moves.filter(({ kind }) => isCut(kind));
  const found = known.get(path) ?? [["extent", extent(path.moves)] as [Word, string], ["extentOfCuts", extent(cuts)] as [Word, string]].filter(([, box]) => box !== "");
  known.set(path, found);
  return found;
}

function extent(moves: Move[]): string {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const move of moves) {
    const box = extentOfMove(move) ?? [move.to, move.to];
    for (const axis of [0, 1, 2].filter((axis) => move.to[axis] !== null)) {
      low[axis] = Math.min(low[axis], box[0][axis]!);
      high[axis] = Math.max(high[axis], box[1][axis]!);
    }
  }
  return [0, 1, 2].filter((axis) => low[axis] <= high[axis]).map((axis) => `${"XYZ"[axis]} ${mm(low[axis])} … ${mm(high[axis])}`).join(", ");
}

/** Shows these facts. */
export function showFacts(list: Facts): void {
  $("details").replaceChildren(
    ...list.flatMap(([name, value]) => {
      const said = node("dd", "");
      // Keep a number on one line with its sign and its letter.
      value.split(" ").forEach((word, index) => said.append(index > 0 ? " " : "", node("span", word, word.length <= 24 ? "whole" : "")));
      return [node("dt", name), said];
    }),
  );
}

/** Formats the known coordinates of a place. */
export function coordinates(place: (number | null)[], format: (value: number) => string): string {
  return place.flatMap((value, axis) => (value === null ? [] : [`${"XYZ"[axis]}${format(value)}`])).join(" ");
}
