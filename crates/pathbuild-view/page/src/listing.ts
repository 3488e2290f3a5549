// The G-code of the scene beside the picture. Only visible rows are rendered.

import { $, node } from "./dom.js";
import { Path } from "./scene.js";
import { visible } from "./visible.js";
import { Lang, say } from "./words.js";

const code = $("code");
const rows = $("rows");

/** Height in px of a row of G-code, larger on narrow pages. */
const ROW = innerWidth > 700 ? 18 : 44;

export class Listing {
  private paths: Path[] = [];
  /** Whether the native program is listed although a post writes another one. */
  private isNative = false;
  private lines: string[] = [];
  /** Index of the path whose text is listed. */
  private listed: number | null = null;
  /** Range of rows that are rendered, excluding the end. */
  private rendered: [number, number] = [0, 0];
  /** Index of the step by line of G-code, for each path. */
  private byLine: Map<number, number>[] = [];
  private pathOf: number[] = [];
  /** Line of each step in the listed text. */
  private lineByStep: (number | null)[] = [];

  /** Determines the line of each step of these paths. */
  load(paths: Path[]): void {
    this.paths = paths;
    this.byLine = paths.map(() => new Map<number, number>());
    [this.pathOf, this.lineByStep] = [[], []];
    paths.forEach((path, index) => {
      const own = this.isNative ? path.native : undefined;
      path.moves.forEach((move, step) => {
        const line = own ? own.lines[step] : (move.line ?? null);
        if (line !== null && !this.byLine[index].has(line)) this.byLine[index].set(line, this.pathOf.length);
        this.pathOf.push(index);
        this.lineByStep.push(line);
      });
    });
    this.reset();
  }

  /** Switches between the written and the native text. */
  switchText(): void {
    this.isNative = !this.isNative;
    this.load(this.paths);
  }

  /** Renders everything anew when it is shown next. */
  reset(): void {
    this.listed = null;
  }

  /** Returns the number and the text of a step's line; `null` if the step has no line. */
  lineOf(step: number): [number, string] | null {
    const line = this.lineByStep[step];
    return line === null ? null : [line, this.text(this.paths[this.pathOf[step]]).split("\n", line)[line - 1] ?? ""];
  }

  /** Returns the index of the first step of a line; -1 if there is none. */
  stepOfLine(line: number): number {
    return this.lineByStep.indexOf(line);
  }

  /** Returns the step of the row that contains a node. */
  stepAt(target: Element | null): number | undefined {
    const line = target?.closest<HTMLElement>(".row")?.dataset.line;
    return line === undefined ? undefined : this.byLine[this.listed ?? 0].get(Number(line));
  }

  /** Shows the rows around the line of a step, which is -1 if nothing is done yet, and scrolls to the line if asked. */
  show(step: number, follows: boolean, lang: Lang): void {
    this.list(this.pathOf[Math.max(step, 0)] ?? 0, lang);
    const line = this.lineByStep[step] ?? null;
    if (follows && line !== null) {
      const top = (line - 1) * ROW;
      if (top < code.scrollTop || top > code.scrollTop + code.clientHeight - 2 * ROW) {
        code.scrollTop = top - code.clientHeight / 2;
      }
    }
    const first = Math.max(0, Math.floor(code.scrollTop / ROW) - 5);
    const last = Math.min(this.lines.length, first + Math.ceil(code.clientHeight / ROW) + 10);
    if (this.rendered[0] !== first || this.rendered[1] !== last) {
      this.rendered = [first, last];
      rows.replaceChildren(...this.lines.slice(first, last).map((content, index) => codeRow(first + index, content)));
    }
    rows.querySelector(".now")?.classList.remove("now");
    if (line !== null) rows.children[line - 1 - first]?.classList.add("now");
  }

  private list(index: number, lang: Lang): void {
    if (this.listed === index) return;
    const path: Path | undefined = this.paths[index];
    this.listed = index;
    this.rendered = [0, 0];
    rows.replaceChildren();
    this.lines = this.text(path).split("\n");
    this.showName(path, lang);
    code.hidden = !this.paths.some(({ gcode }) => gcode);
    rows.style.height = `${this.lines.length * ROW}px`;
  }

  private text(path: Path | undefined): string {
    return (this.isNative ? path?.native?.gcode : undefined) ?? path?.gcode ?? "";
  }

  /** Shows the name of the listed file, and offers to switch between the written and the native text. */
  private showName(path: Path | undefined, lang: Lang): void {
    const isDrawn = path !== undefined && path.embedded.length > 0;
    $("program").hidden = !isDrawn || !path.gcode;
    $("native").hidden = !path?.native;
    $("native").textContent = say(this.isNative ? "showWritten" : "showNative", lang);
    const reason = path?.refusal ? `: ${path.refusal[lang]}` : "";
    const file = path?.written ?? `${say("preview", lang)}${reason}`;
    $("whose").textContent = visible(this.isNative && path?.native ? `${say("nativeText", lang)} ${file}` : file);
  }
}

function codeRow(index: number, content: string): HTMLElement {
  const row = node("div", "", "row");
  row.append(node("i", String(index + 1)), node("span", content));
  row.style.top = `${index * ROW}px`;
  row.dataset.line = String(index + 1);
  return row;
}
