// The viewer of a scene: the picture, its G-code, and the interaction between them.

import { $, node, tableRow } from "./dom.js";
import { coordinates, factsOfScene, factsOfStep, showFacts } from "./facts.js";
import { sayKeys, toggleHelp } from "./help.js";
import { Spot } from "./labels.js";
import { sayLegend, sayScale, showLegend } from "./legend.js";
import { Listing } from "./listing.js";
import { Model, Step, model } from "./model.js";
import { MOST_OPERATIONS, Operation, operations } from "./operations.js";
import { Element, Finding, Path, Scene, cornersOf, isCut, isRapid, isSameHandle, isSamePlace, middleOfArc, pointsOfShape } from "./scene.js";
import { Stage, isThick } from "./stage.js";
import { NOTHING } from "./stock/heights.js";
import { Assumed } from "./stock/pieces.js";
import { Stock } from "./stock/stock.js";
import { stockColors } from "./palette.js";
import { remember, remembered } from "./remembered.js";
import { FIELDS, ProgramSettings, fragmentOf } from "./programs.js";
import { Timeline, clock, wayUpTo } from "./timeline.js";
import { visible } from "./visible.js";
import { Lang, Word, hundredths, mm, say, sayKind, wholeMm } from "./words.js";

const slider = $<HTMLInputElement>("slider");
const speed = $<HTMLSelectElement>("speed");
const picture = $("picture");
const listing = new Listing();

/** Maximum number of labels with numbers and texts: more would cover the picture. */
const MOST_SPOTS = 600;

export let lang: Lang = (remembered("lang") ?? document.documentElement.lang) === "de" ? "de" : "en";
let dark = (remembered("theme") ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
let scene: Scene = { schema: "", version: 1, title: "", through: 0, paths: [], other_layers: [], keep_outs: [], findings: [] };
let made: Model = model(scene);
let timeline = new Timeline(made, null);
let work: Operation[] = [];
/** Index of the current operation. */
let working: number | null = null;
/** Whether a scene is shown; otherwise this module ignores keys. */
let isOpen = false;
/** Draws the still picture if WebGL is not available. */
let drawStill: () => void = () => {};
/** Callbacks for a change of the language. */
const hearers: (() => void)[] = [];
let stage: Stage | null = null;
/** The stock of the scene; `undefined` until it is shown. */
let stock: Stock | null | undefined;
let space = false;
let count = made.steps.length;
/** Share of the next move that is done. */
let share = 0;
let chosen: number | null = null;
/** Handle of the next animation frame; 0 while paused. */
let frame = 0;
let measured: [number, number][] | null = null;
/** The parts of the picture that are shown. On a phone, texts would cover it. */
const shown = { stock: true, rapids: true, arrows: true, order: true, texts: innerWidth > 700, other: true, explain: innerWidth > 700 };
/** Shows a scene. If it is a new version of the current one, the view is kept. */
export function show(next: Scene, isSame: boolean, still: () => void = () => {}): void {
  // Between two versions with moves there may be one with errors.
  if (!isSame) shownBefore = null;
  else if (made.steps.length > 0) shownBefore = { count, atEnd: count === made.steps.length, current: marked(count > 0 ? count - 1 : null), chosen: marked(chosen) };
  scene = next;
  stock = undefined;
  drawStill = still;
  isOpen = true;
  placeProgram();
  listing.load(scene.paths);
  $("title").textContent = visible(scene.title);
  document.title = visible(scene.title);
  if (!isSame) {
    if (measured) acts.measure();
    if (frame) play();
  }
  start(isSame);
  slider.max = String(made.steps.length);
  const current = shownBefore?.current && found(shownBefore.current);
  if (!shownBefore || shownBefore.atEnd) count = made.steps.length;
  else count = Math.min(typeof current === "number" ? current + 1 : shownBefore.count, made.steps.length);
  chosen = shownBefore?.chosen ? found(shownBefore.chosen) : null;
  speak();
}

/** Shows the controls for G-code programs if the page shows one, with its findings and, as placeholders of input fields, the values that it states. */
function placeProgram(): void {
  const { program } = scene;
  document.getElementById("download")?.toggleAttribute("hidden", program !== undefined);
  for (const id of ["typeDialect", "settings"]) $(id).hidden = !program?.dialects;
  for (const id of ["typeSurface", "checked"]) $(id).hidden = !program;
  if (!program) return;
  const checks = program.checks.map(({ outcome, text: said }) => node("li", said[lang], outcome));
  $("checks").replaceChildren(...checks);
  const tool = $<HTMLInputElement>("assumedTool");
  tool.title = tool.placeholder = [...new Set(program.cutters.map(({ diameter }) => mm(diameter)))].join(", ");
  // The arrows of a number field take the space of about three digits.
  tool.style.width = `clamp(5em, ${tool.placeholder.length + 4}ch, 20em)`;
  $<HTMLInputElement>("assumedSurface").placeholder = program.surface === null ? "" : mm(program.surface);
  if (!program.dialects) return;
  const dialect = $<HTMLSelectElement>("assumedDialect");
  const chosen = dialect.value;
  dialect.replaceChildren(new Option(`${say("asFound", lang)}: ${program.dialect}`, ""), ...program.dialects.map((name) => new Option(name, name)));
  dialect.value = chosen;
  $<HTMLAnchorElement>("settings").href = `#${fragmentOf(settings())}`;
}

/** Reads the settings entered for a program. */
function settings(): ProgramSettings {
  const values = Object.entries(FIELDS).map(([name, id]) => [name, $<HTMLInputElement>(id).value]);
  return Object.fromEntries(values) as unknown as ProgramSettings;
}

/** Enters the settings from an address. */
export function assume(settings: ProgramSettings): void {
  for (const [name, id] of Object.entries(FIELDS)) {
    const field = $<HTMLInputElement | HTMLSelectElement>(id);
    const value = settings[name as keyof ProgramSettings];
    // The list of dialects arrives with the first answer.
    if (field instanceof HTMLSelectElement && value !== "" && ![...field.options].some((option) => option.value === value)) field.append(new Option(value, value));
    field.value = value;
  }
}

/** Registers a callback for changed settings of a program. */
export function onAssume(hear: (settings: ProgramSettings) => void): void {
  for (const id of Object.values(FIELDS)) $(id).addEventListener("change", () => scene.program && hear(settings()));
}

export function hide(): void {
  isOpen = false;
  if (frame) play();
}

/** The path and the element of a step, and the number of earlier steps on that element. After an edit, these values identify the step again. */
interface Mark {
  path: string;
  element: Element;
  turn: number;
}

function marked(at: number | null): Mark | null {
  const own = at === null ? null : owner(made.steps[at]);
  if (own === null || at === null) return null;
  const turn = made.steps.slice(0, at).filter((step) => owner(step)?.element === own.element).length;
  return { ...own, turn };
}

function owner({ path, move }: Step): { path: string; element: Element } | null {
  const element = move.element === undefined ? undefined : path.elements[move.element];
  return element ? { path: nameOf(path, element), element } : null;
}

function nameOf(path: Path, element: Element): string {
  return path.embedded[element.path]?.name ?? path.name;
}

/** Returns the step of a mark in the present version. Elements are paired as `diff` pairs them: by their place, then by their handle. */
function found({ path: name, element: old, turn }: Mark): number | null {
  const likeness = (element: Element) => 4 * Number(isSamePlace(old, element)) + 2 * Number(isSameHandle(old, element)) + Number(old.kind === element.kind);
  let [best, most] = [null as Element | null, 1];
  for (const path of scene.paths) {
    for (const element of path.elements.filter((it) => nameOf(path, it) === name)) {
      const like = likeness(element);
      if (like > most) [best, most] = [element, like];
    }
  }
  const steps = made.steps.flatMap((step, index) => (best && owner(step)?.element === best ? [index] : []));
  return steps[turn] ?? null;
}

/** The moves that were shown of the last version with moves. */
let shownBefore: { count: number; atEnd: boolean; current: Mark | null; chosen: Mark | null } | null = null;

/** Starts or restarts the picture, whose buffers contain the colours. */
function start(keepsView: boolean): void {
  made = model(scene);
  share = 0;
  const view = keepsView ? stage?.view() : undefined;
  try {
    if (stage && stage.isThick !== isThick(made)) {
      stage.dispose();
      stage = null;
    }
    stage ??= new Stage(picture, $("labels"), $("legend"), isThick(made), sayScale, redraw);
    stage.load(made, scene);
  } catch {
    stage = null;
    $("still").hidden = false;
    $("nowebgl").hidden = false;
    drawStill();
  }
  for (const what of ["rapids", "arrows", "other"] as const) stage?.toggle(what, shown[what]);
  placeStock();
  if (view) stage?.restore(view);
  else stage?.fit(space);
}

/** Loads the picture again, with the same view. */
function redraw(): void {
  if (!isOpen) return;
  start(true);
  spots();
  go(count);
  describe(chosen);
}

/** Returns the thickness in mm that a program states, with its upper face at this height. */
function statedThickness(surface: number | null): number | null {
  const { program } = scene;
  return program?.is_on_zero && surface === program.surface && surface !== null && surface > 0 ? surface : null;
}

/** Returns the values to assume: those that the user entered, and those of the program where none were entered. */
function assumed(): Assumed {
  const typed = (id: string) => $<HTMLInputElement>(id).valueAsNumber;
  const [tool, thickness] = [typed("assumedTool"), typed("assumedThickness")];
  const typedSurface = typed("assumedSurface");
  const surface = Number.isFinite(typedSurface) ? typedSurface : (scene.program?.surface ?? null);
  return { tool: tool > 0 ? tool : null, thickness: thickness > 0 ? thickness : statedThickness(surface), surface };
}

/** Shows the stock under the moves, or hides it. */
function placeStock(): void {
  const cuts = scene.paths.filter(({ moves }) => moves.some((move) => isCut(move.kind)));
  const hasTool = assumed().tool !== null;
  const hasMoves = made.steps.length > 0;
  $("run").hidden = $("where").hidden = $("rapids").hidden = $("arrows").hidden = !hasMoves;
  $("order").hidden = !scene.paths.some(({ elements }) => elements.some(({ order }) => order !== null));
  $("texts").hidden = !scene.paths.some(({ texts, embedded }) => texts.length > 0 || embedded.length > 1);
  $("other").hidden = scene.other_layers.length === 0;
  $("typeTool").hidden = !scene.program?.dialects && !cuts.some(({ tool, tools }) => tool === null && !tools);
  $("typeThickness").hidden = !scene.program && $("typeTool").hidden;
  $("typeRapid").hidden = scene.paths.every(({ rapid, moves }) => moves.length === 0 || rapid);
  $("assumed").hidden = ["typeTool", "typeThickness", "typeRapid"].every((id) => $(id).hidden);
  $("stock").hidden = !cuts.some(({ tool, tools }) => tool !== null || tools || hasTool);
  if (shown.stock && stock === undefined) stock = Stock.of(scene, assumed(), stockColors());
  stage?.showStock(shown.stock ? stock! : null);
  $("flat").hidden = stage !== null || !shown.stock || !stock;
  document.body.classList.toggle("still", stage === null);
  picture.classList.toggle("halved", !$("flat").hidden);
  cutStock();
  legend();
}

function legend(): void {
  const hasStock = shown.stock && !!stock;
  const parts = scene.paths.flatMap(({ parts }) => parts ?? []);
  sayLegend(made, { rapids: shown.rapids && made.steps.length > 0, stock: hasStock, texel: stock?.map.texel ?? 0, rapidCuts: !!stock?.map.hasRapidCut, hasUnknownTip: !!stock?.map.cutting.hasUnknownTip, parts, hasCorners: parts.some((part) => cornersOf(scene, part).length > 0), clamps: scene.keep_outs.length > 0, hasUncutOutlines: (scene.uncut ?? []).length > 0 }, lang);
  showLegend(shown.explain);
  stage?.placeLabels();
}

/** Computes the times of the moves and the table of operations. */
function placeWork(): void {
  const typed = $<HTMLInputElement>("assumedRapid").valueAsNumber;
  timeline = new Timeline(made, typed > 0 ? typed : null);
  work = operations(made, timeline);
  working = null;
  $("work").hidden = work.length === 0 || work.length > MOST_OPERATIONS;
  $("workCount").textContent = String(work.length);
  $("workHead").replaceChildren(tableRow("th", [say("number", lang), say("what", lang), "Z", "mm", ...(timeline.isKnown ? [say("time", lang)] : [])]));
  if ($("work").hidden) return $("operations").replaceChildren();
  const rows = work.map((it, index) => {
    const what = [sayKind(it.kind, lang), it.name, scene.paths.length > 1 ? made.steps[it.moves[0]].path.name : ""].filter((part) => part !== "");
    const row = tableRow("td", [String(index + 1), what.join(" · "), it.depth === null ? "" : mm(it.depth), wholeMm(it.length), ...(timeline.isKnown ? [clock(it.seconds)] : [])]);
    row.tabIndex = 0;
    row.addEventListener("click", () => choose(index));
    row.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      choose(index);
    });
    return row;
  });
  $("operations").replaceChildren(...rows);
}

/** Goes to an operation and highlights its moves. */
function choose(index: number): void {
  const it = work[Math.min(Math.max(index, 0), work.length - 1)];
  if (!it) return;
  chosen = null;
  go(it.moves[0]);
  mark(work.indexOf(it));
  showFacts(factsOfScene(scene, timeline, lang));
  stage?.point(it.moves);
}

/** Goes to the operation before or after the current one. */
function chooseNext(step: 1 | -1): void {
  const next = work.findIndex(({ moves }) => moves[0] > count);
  choose(step > 0 ? (next < 0 ? work.length - 1 : next) : (next < 0 ? work.length : next) - (working === null ? 1 : 2));
}

/** Highlights the row of an operation. */
function mark(index: number | null): void {
  if (working === index) return;
  const rows = $("operations").children;
  if (working !== null) rows[working]?.removeAttribute("aria-current");
  working = index;
  const row = index === null ? undefined : (rows[index] as HTMLElement | undefined);
  row?.setAttribute("aria-current", "true");
  if (row && $<HTMLDetailsElement>("work").open) row.scrollIntoView({ block: "nearest" });
}

/** Returns the index of the operation that a move belongs to; `null` if the move is between operations. */
function operationAt(step: number): number | null {
  let [low, high] = [0, work.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (work[middle].moves[0] <= step) low = middle + 1;
    else high = middle;
  }
  return low > 0 && step < work[low - 1].moves[1] ? low - 1 : null;
}

/** Cuts the stock up to the current move. */
function cutStock(): void {
  if (!shown.stock || !stock) return;
  const { hasRapidCut } = stock.map;
  const changed = stock.seek(Math.min(count, made.steps.length), share);
  if (hasRapidCut !== stock.map.hasRapidCut) legend();
  if (!stage) stock.paint($("flat"));
  else if (changed) stage.cut(changed);
}

/** Sets all colours outside of the WebGL picture. Paper is light, except under this picture, which is printed as it is. */
function paint(isPaper = false): void {
  document.documentElement.dataset.theme = dark && !isPaper ? "dark" : "light";
  picture.dataset.theme = dark ? "dark" : "light";
}

/** Creates the labels of the picture: numbers, texts and findings. */
function spots(): void {
  const all: Spot[] = [];
  const add = (at: [number, number], z: number, node: HTMLElement) => all.push({ at: [at[0], at[1], z], node });
  for (const path of scene.paths) {
    const place = ([x, y]: [number, number]): [number, number] => [x + path.zero[0], y + path.zero[1]];
    // Z of the upper face of the material under an embedded path, where its cuts begin.
    const top = (inner: number) => path.embedded[inner]?.thickness ?? 0;
    if (shown.order) {
      for (const { order, shape, path: inner } of path.elements) {
        if (order === null) continue;
        const at: [number, number] =
          shape.type === "line"
            ? [(shape.from[0] + shape.to[0]) / 2, (shape.from[1] + shape.to[1]) / 2]
            : shape.type === "circle"
              ? shape.centre
              : middleOfArc(shape);
        // A number on the disc of a drilled hole would make it look like a ring.
        const reach = (path.tool ?? 0) / 2;
        const isHole = shape.type === "circle" && shape.radius <= 1.05 * reach;
        add(place(isHole ? [at[0] + reach, at[1]] : at), top(inner), node("span", String(order), isHole ? "order beside" : "order"));
      }
    }
    if (shown.texts) {
      for (const label of path.texts) if (label.path === 0) add(place(label.at), top(0), node("span", label.text, "text"));
      for (const inner of path.embedded.slice(1)) add(place(inner.ends[0]), inner.thickness, node("span", inner.name, "name"));
    }
    for (const probe of path.probes) {
      add(place(probe.at), probe.height, node("span", `#${probe.number} ${probe.label ?? ""}`, "probe"));
    }
    const zero = path.elements.find((element) => element.path === 0 && element.kind === "start");
    if (zero || path.moves.length > 0) add(place([0, 0]), 0, node("span", "X0 Y0", "zero"));
  }
  for (const { outline, height } of scene.keep_outs) {
    const corners = outline.flatMap((shape) => pointsOfShape(shape).slice(1));
    const mean = (axis: 0 | 1) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length;
    add([mean(0), mean(1)], height, node("span", `Z${mm(height)}`, "clamp"));
  }
  for (const finding of scene.findings) {
    if (!finding.at) continue;
    const circle = node("button", String(finding.number), finding.is_error ? "finding" : "finding warning");
    circle.title = visible(`${finding.code}: ${finding.message[lang]}`);
    circle.setAttribute("aria-label", `${say("finding", lang)} ${finding.number}: ${circle.title}`);
    // The list of findings has the same buttons.
    circle.tabIndex = -1;
    circle.addEventListener("click", () => goTo(finding));
    add(finding.at, 0, circle);
  }
  for (const at of measured ?? []) add(at, 0, node("span", "+", "cross"));
  const isNumber = ({ node }: Spot) => node.classList.contains("order");
  const others = all.filter((spot) => !isNumber(spot)).slice(-MOST_SPOTS);
  stage?.setSpots([...everyNth(all.filter(isNumber), MOST_SPOTS - others.length), ...others]);
}

/** Returns at most `most` of the elements, evenly distributed. */
function everyNth<T>(all: T[], most: number): T[] {
  const step = Math.ceil(all.length / most);
  return all.filter((_, index) => most > 0 && index % step === 0);
}

/** Moves the tool to the end of this many moves, and along a share of the next one. */
function go(to: number, part = 0): void {
  count = Math.min(Math.max(to, 0), made.steps.length);
  share = count < made.steps.length ? part : 0;
  // Update the listing first: it reads the layout, which would have to be recomputed after a change of the page.
  list(true);
  slider.value = String(count);
  stage?.show(count, share);
  cutStock();
  mark(operationAt(share > 0 ? count : count - 1) ?? operationAt(count));
  readout();
}

/** Shows the G-code around the current line, and scrolls to it if asked. */
function list(follows: boolean): void {
  const step = share > 0 ? count : count - 1;
  listing.show(step, follows, lang);
}

/** Shows position, feed and time of the tool. */
function readout(): void {
  $("where").textContent = `${say("step", lang)} ${count} ${say("of", lang)} ${made.steps.length}`;
  const step = made.steps[share > 0 ? count : Math.max(count - 1, 0)];
  if (!step) {
    for (const id of ["place", "pace", "clock"]) $(id).textContent = "";
    return;
  }
  const { path, move } = step;
  const [x, y] = path.zero;
  const at = count === 0 ? move.from : move.to;
  const end = share > 0 ? wayUpTo(step, share, made.unknownZ).at(-1) : undefined;
  const isHeightKnown = move.from[2] !== null && move.to[2] !== null;
  const place = end ? [end[0] - x, end[1] - y, isHeightKnown ? end[2] : null] : at;
  $("place").textContent = coordinates(place, hundredths);
  $("pace").textContent = isRapid(move.kind) ? say("sweep", lang) : move.feed ? `F${mm(move.feed)} mm/min` : "";
  const seconds = timeline.seconds(count, share);
  $("clock").textContent = timeline.isKnown ? `${clock(seconds)} ${say("elapsed", lang)} · ${clock(timeline.total - seconds)} ${say("remaining", lang)}` : "";
}

/** Shows the facts about a move and its element, or about the whole scene. */
function describe(at: number | null): void {
  stage?.point(at === null ? null : [at, at + 1]);
  showFacts(at === null ? factsOfScene(scene, timeline, lang) : factsOfStep(at, made.steps[at], listing.lineOf(at), lang));
}

/** Lists the findings; a click on one with a place goes there. */
function findings(): void {
  const list = scene.findings.map((it) => {
    const item = node("li", "", it.is_error ? "error" : "");
    const place = scene.program && it.line ? `${say("lineShort", lang)} ${it.line} · ` : "";
    const words = `${it.number} · ${place}${it.code}: ${it.message[lang]}`;
    const line = node(it.at && stage ? "button" : "span", words);
    if (it.at && stage) line.addEventListener("click", () => goTo(it));
    item.append(line);
    for (const note of it.notes ?? []) item.append(node("small", note[lang]));
    if (it.help[lang]) item.append(node("small", it.help[lang]));
    item.dataset.number = String(it.number);
    return item;
  });
  $("findings").replaceChildren(...list);
  $("found").hidden = list.length === 0;
}

/** Shows the place of a finding and highlights its line. */
function goTo(finding: Finding): void {
  if (finding.at) stage?.look(finding.at);
  const step = scene.program ? listing.stepOfLine(finding.line ?? 0) : -1;
  if (step >= 0) {
    go(step + 1);
    describe((chosen = step));
  }
  for (const item of $("findings").children as Iterable<HTMLElement>) {
    const isIt = item.dataset.number === String(finding.number);
    item.classList.toggle("now", isIt);
    if (isIt) item.scrollIntoView({ block: "nearest" });
  }
}

/** Renders all texts in the current language. */
export function speak(): void {
  document.documentElement.lang = lang;
  document.querySelectorAll<HTMLElement>("[data-word]").forEach((node) => {
    node.textContent = say(node.dataset.word as Word, lang);
  });
  $("keys").setAttribute("aria-label", say("keys", lang));
  picture.setAttribute("aria-label", say("picture", lang));
  sayKeys(lang);
  $("speed").setAttribute("aria-label", say("speed", lang));
  $<HTMLSelectElement>("speed").options[0].textContent = `1× (${say("realSpeed", lang)})`;
  slider.setAttribute("aria-label", say("step", lang));
  hearers.forEach((hear) => hear());
  if (!isOpen) return;
  listing.reset();
  placeProgram();
  findings();
  placeWork();
  legend();
  describe(chosen);
  spots();
  go(count, share);
}

/** Registers a callback for a change of the language. */
export function onSpeak(hear: () => void): void {
  hearers.push(hear);
}

/** Formats a place of the picture in the coordinates of the program; of several programs, in those of the drawing, and says so. */
function shownPlace([x, y]: [number, number], format: (value: number) => string): string {
  const [path, ...others] = scene.paths;
  if (others.length > 0) return `${say("inDrawing", lang)} X${format(x)} Y${format(y)}`;
  const [left, lower] = path?.zero ?? [0, 0];
  return `X${format(x - left)} Y${format(y - lower)}`;
}

function measure(at: [number, number]): void {
  measured = measured && measured.length < 2 ? [...measured, at] : [at];
  const [a, b] = measured;
  $("measured").textContent = b
    ? `${mm(Math.hypot(b[0] - a[0], b[1] - a[1]))} mm · ΔX ${mm(b[0] - a[0])} · ΔY ${mm(b[1] - a[1])}`
    : shownPlace(a, mm);
  spots();
}

/** Starts or stops the animation. */
function play(): void {
  if (frame) {
    cancelAnimationFrame(frame);
    frame = 0;
  } else {
    if (count >= made.steps.length) go(0);
    describe((chosen = null));
    let before = performance.now();
    const next = (now: number) => {
      const seconds = timeline.seconds(count, share) + (Math.max(now - before, 0) / 1000) * Number(speed.value);
      before = now;
      go(...timeline.at(seconds));
      if (count >= made.steps.length) return play();
      frame = requestAnimationFrame(next);
    };
    frame = requestAnimationFrame(next);
  }
  $("play").dataset.word = frame ? "stop" : "play";
  $("play").textContent = say(frame ? "stop" : "play", lang);
}

/** Speeds the animation up or slows it down. */
function changeSpeed(step: 1 | -1): void {
  speed.selectedIndex = Math.min(Math.max(speed.selectedIndex + step, 0), speed.options.length - 1);
}

$("native").addEventListener("click", () => {
  listing.switchText();
  describe(chosen);
  list(true);
});

const acts = {
  view2: () => stage?.fit((space = false)),
  view3: () => stage?.fit((space = true)),
  fit: () => stage?.fit(space),
  measure: () => {
    measured = measured || !stage ? null : [];
    $("measured").textContent = measured ? say("pick", lang) : "";
    $("measure").setAttribute("aria-pressed", String(measured !== null));
    spots();
  },
  theme: () => {
    dark = !dark;
    remember("theme", dark ? "dark" : "light");
    paint();
    stock = undefined;
    redraw();
  },
  lang: () => {
    lang = lang === "en" ? "de" : "en";
    remember("lang", lang);
    speak();
  },
  play,
  stock: () => switchLayer("stock"),
  rapids: () => switchLayer("rapids"),
  arrows: () => switchLayer("arrows"),
  order: () => switchLayer("order"),
  texts: () => switchLayer("texts"),
  other: () => switchLayer("other"),
  explain: () => switchLayer("explain"),
  keys: toggleHelp,
};

/** Actions of the buttons for colours and language, which are on several pages. */
export const { theme, lang: otherLang } = acts;

function switchLayer(what: keyof typeof shown): void {
  shown[what] = !shown[what];
  $(what).setAttribute("aria-pressed", String(shown[what]));
  if (what === "order" || what === "texts") spots();
  else if (what === "stock") placeStock();
  else if (what !== "explain") stage?.toggle(what, shown[what]);
  legend();
}
for (const [id, act] of Object.entries(acts)) $(id).addEventListener("click", act);

const keys: Record<string, () => void> = {
  ArrowRight: () => go(count + 1),
  ArrowLeft: () => go(count - 1),
  PageDown: () => go(count + 10),
  PageUp: () => go(count - 10),
  Home: () => go(0),
  End: () => go(made.steps.length),
  " ": play,
  "+": () => changeSpeed(1),
  "-": () => changeSpeed(-1),
  "<": () => chooseNext(-1),
  ">": () => chooseNext(1),
  g: acts.explain,
  "?": acts.keys,
  "2": acts.view2,
  "3": acts.view3,
  f: acts.fit,
  s: acts.stock,
  r: acts.rapids,
  a: acts.arrows,
  n: acts.order,
  t: acts.texts,
  o: acts.other,
  m: acts.measure,
  Escape: acts.measure,
  l: acts.lang,
  d: acts.theme,
};
addEventListener("keydown", (event) => {
  const act = event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented ? undefined : keys[event.key];
  const { target } = event;
  const isHelping = $<HTMLDialogElement>("help").open && event.key !== "?";
  const isButton = target instanceof HTMLButtonElement && event.key === " ";
  const isTyping = target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target !== slider);
  // Without a measurement to end, Escape leads back to the library on the live page.
  const isOther = event.key === "Escape" && !measured;
  if (!act || isOther || isButton || isTyping || isHelping || !(isOpen || "ld?".includes(event.key))) return;
  event.preventDefault();
  act();
  if (event.key.startsWith("Arrow")) describe((chosen = count > 0 ? count - 1 : null));
});

slider.addEventListener("input", () => go(Number(slider.value)));
$("assumedRapid").addEventListener("input", () => {
  placeWork();
  describe(chosen);
  go(count, share);
});
for (const id of ["assumedTool", "assumedThickness", "assumedSurface"]) {
  $(id).addEventListener("input", () => {
    stock = undefined;
    placeStock();
  });
}
$("code").addEventListener("scroll", () => list(false));
$("rows").addEventListener("click", (event) => {
  // The row may have been rendered anew since the button was pressed: the target is then all rows.
  const step = listing.stepAt(document.elementFromPoint(event.clientX, event.clientY));
  if (step === undefined) return;
  go(step + 1);
  describe((chosen = step));
});
let down: [number, number] = [0, 0];
picture.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
picture.addEventListener("click", (event) => {
  if (!stage || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
  const box = picture.getBoundingClientRect();
  const [x, y] = [event.clientX - box.left, event.clientY - box.top];
  if (measured) return measure(stage.plane(x, y, count));
  chosen = stage.pick(x, y, count);
  if (chosen !== null) go(chosen + 1);
  describe(chosen);
});
picture.addEventListener("pointerleave", () => {
  $("at").textContent = "";
  describe(chosen);
});
/** The last pointer event; `null` once it has been handled. */
let hovered: PointerEvent | null = null;
picture.addEventListener("pointermove", (event) => {
  if (!stage || event.buttons > 0) return;
  const isDue = hovered !== null;
  hovered = event;
  if (isDue) return;
  requestAnimationFrame(() => {
    const [left, top] = [hovered!.clientX, hovered!.clientY];
    hovered = null;
    const box = picture.getBoundingClientRect();
    const [x, y] = [left - box.left, top - box.top];
    const at = stage!.plane(x, y, 0);
    const height = shown.stock && !space && stock ? stock.map.at(...at) : NOTHING;
    $("at").textContent = `${shownPlace(at, hundredths)}${height === NOTHING ? "" : ` Z${hundredths(height)}`}`;
    const step = stage!.pick(x, y, count);
    if (step !== null || chosen === null) describe(step);
  });
});

addEventListener("beforeprint", () => {
  paint(true);
  stage?.render();
});
addEventListener("afterprint", () => paint());

$("texts").setAttribute("aria-pressed", String(shown.texts));
paint();
