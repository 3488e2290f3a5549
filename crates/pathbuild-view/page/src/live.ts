// The page of a library: its list, and the path that is shown.

import { $, node, tableRow } from "./dom.js";
import { List } from "./list.js";
import { DroppedProgram, ProgramSettings, fragmentOf, settingsIn } from "./programs.js";
import { Finding } from "./scene.js";
import { LibraryNews, LibraryRow, Refused, Source, Statistics } from "./source.js";
import { assume, hide, lang, onAssume, onSpeak, otherLang, show, speak, theme } from "./viewer.js";
import { Word, say } from "./words.js";

/** The path to show, or a whole drawing if `path` is `null`. */
interface Wanted {
  file: string;
  path: string | null;
}

type Filter = "all" | "errors" | "stale" | "unknown" | "current" | "ok" | "warnings";

const FILTERS: [Filter, Word][] = [
  ["all", "all"],
  ["errors", "manyErrors"],
  ["stale", "stateStale"],
  ["unknown", "stateUnknown"],
  ["current", "stateCurrent"],
  ["ok", "stateOk"],
  ["warnings", "withWarnings"],
];

/** Number of drawings fetched first: more than fit into a window, and rendered before all drawings of a large library have arrived. */
const FIRST = 200;

/** Starts the page with this source. Returns a function that opens a dropped program. */
export function live(source: Source): (program: DroppedProgram) => void {
  const page = new Page(source);
  page.begin();
  return (program) => page.take(program);
}

class Page {
  private drawings = new Map<string, LibraryRow[]>();
  /** Files sorted by path. */
  private files: string[] = [];
  private revision = 0;
  /** Whether the last answer contained all drawings that had changed. */
  private isWhole = true;
  private isPulling = false;
  private isBehind = false;
  private isOnline = true;
  private isComplete = false;
  private halted: string | null = null;
  private problems: Finding[] = [];
  private statistics: Statistics | null = null;
  private filter: Filter = "all";
  private open: Wanted | null = null;
  /** The program dropped last. */
  private program: DroppedProgram | null = null;
  private settings: ProgramSettings | null = null;
  /** Whether the drawing that is open no longer exists. */
  private isGone = false;
  /** The path that the address named although it is not there. */
  private missing: Wanted | null = null;
  /** Reason why a program cannot be shown. */
  private failure = "";
  /** Number of the current request; answers to earlier ones are ignored. */
  private look = 0;
  private list = new List($("list"), $("items"), (row) => this.choose({ file: row.file, path: row.path }));
  private note = node("div", "");

  constructor(private source: Source) {}

  begin(): void {
    const back = node("button", "");
    back.id = "back";
    back.dataset.word = "library";
    back.addEventListener("click", () => this.choose(null));
    $("viewer").querySelector("header")!.prepend(back);
    this.note.id = "note";
    this.note.hidden = true;
    $("viewer").querySelector("header")!.after(this.note);
    $("paper").addEventListener("click", theme);
    $("tongue").addEventListener("click", otherLang);
    $("totals").addEventListener("click", () => this.toggleStatistics());
    const search = $<HTMLInputElement>("search");
    search.addEventListener("input", () => this.relist());
    search.addEventListener("keydown", (event) => {
      if (event.key === "ArrowDown") this.list.enter();
      else if (event.key === "Enter") {
        this.list.openFirst();
        // The keys of the picture take effect where nothing is typed.
        search.blur();
      }
      else if (event.key === "Escape") {
        search.value = "";
        this.relist();
      } else return;
      event.preventDefault();
    });
    addEventListener("keydown", (event) => {
      if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === "/" && event.target !== search) search.focus();
      else if (event.key === "Escape" && (this.open || this.settings)) this.choose(null);
      else return;
      event.preventDefault();
    });
    addEventListener("hashchange", () => this.follow());
    onSpeak(() => this.say());
    onAssume((settings) => {
      history.replaceState(null, "", `#${fragmentOf(settings)}`);
      this.settings = settings;
      void this.view(true);
    });
    speak();
    this.follow();
    void this.pull();
    void this.listen();
  }

  private async listen(): Promise<void> {
    for (;;) {
      try {
        await this.source.events(() => {
          this.setOnline(true);
          void this.pull();
        });
      } catch (error) {
        if (error instanceof Refused && error.status === 401) return this.complain(say("unknown", lang));
      }
      this.setOnline(false);
      await new Promise((done) => setTimeout(done, 1000));
    }
  }

  /** Fetches changes, and fetches again if there were more in the meantime. */
  private async pull(): Promise<void> {
    this.isBehind = true;
    if (this.isPulling) return;
    this.isPulling = true;
    try {
      while (this.isBehind) {
        this.isBehind = false;
        this.hear(await this.source.library(this.revision, this.isWhole && this.drawings.size === 0 ? FIRST : undefined));
        this.isBehind ||= !this.isWhole;
      }
    } catch {
      // Ignore the error: the next event causes another request.
    }
    this.isPulling = false;
  }

  /** Opens a program, with the settings from the address if there are any. Those entered for another program do not apply to it. */
  take(program: DroppedProgram): void {
    const isOther = this.program !== null && this.program.name !== program.name;
    this.program = program;
    if (!this.settings || isOther) history.pushState(null, "", "#program");
    this.follow();
  }

  private hear(news: LibraryNews): void {
    const isFirst = this.revision === 0;
    if (news.all) this.drawings.clear();
    const known = new Set(this.files);
    for (const { file, rows } of news.drawings) {
      if (rows) this.drawings.set(file, rows.map((row) => ({ ...row, file })));
      else this.drawings.delete(file);
    }
    if (news.all || news.drawings.some(({ file, rows }) => !rows || !known.has(file))) this.files = inOrder(this.drawings.keys());
    const wasComplete = this.isComplete;
    this.isWhole = !news.more;
    // After a partial answer there is no revision to continue from.
    [this.revision, this.isComplete, this.halted] = [this.isWhole ? news.revision : 0, this.isWhole && news.complete, news.halted];
    [this.problems, this.statistics] = [news.problems, news.statistics];
    this.say();
    const { open } = this;
    if (open) {
      this.isGone = !this.drawings.has(open.file) && this.isComplete;
      const isTouched = news.all || news.drawings.some(({ file, rows }) => file === open.file && rows);
      if (isTouched && !isFirst) void this.view(true);
      this.remark();
    }
    const only = this.isComplete && !wasComplete && !open && !this.settings ? this.rows() : [];
    if (only.length === 1) this.choose(only[0]);
  }

  private rows(): LibraryRow[] {
    return this.files.flatMap((file) => this.drawings.get(file)!);
  }

  /** Lists the rows that match the search and the filter. */
  private relist(): void {
    const words = $<HTMLInputElement>("search").value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    const isMeant = (row: LibraryRow) => {
      if (!isListed(row, this.filter)) return false;
      const text = `${row.path ?? ""} ${row.file} ${row.material ?? ""}`.toLowerCase();
      return words.every((word) => text.includes(word));
    };
    const all = this.rows();
    const rows = words.length === 0 && this.filter === "all" ? all : all.filter(isMeant);
    const count = new Intl.NumberFormat(lang);
    const shown = rows.length === all.length ? "" : `${count.format(rows.length)} ${say("of", lang)} `;
    const pending = all.filter((row) => row.state === undefined).length;
    const open = pending > 0 ? ` · ${count.format(pending)} ${say("unchecked", lang)}` : "";
    const nothing = rows.length > 0 || !this.isComplete ? "" : say(all.length === 0 ? "nothing" : "nothingFound", lang);
    $("count").textContent = nothing || `${shown}${count.format(all.length)} ${say(all.length === 1 ? "path" : shown === "" ? "paths" : "ofPaths", lang)}${open}${this.isWhole ? "" : " …"}`;
    // Set the rows last: the count may take a line from the height of the list, which then scrolls to its selected row.
    this.list.set(rows, this.open);
  }

  private say(): void {
    $<HTMLInputElement>("search").placeholder = say("search", lang);
    $("search").setAttribute("aria-label", say("search", lang));
    $("list").setAttribute("aria-label", say("paths", lang));
    $("columns").replaceChildren(...(["path", "drawing", "M", "T", "O", "size", "length", "min", "state"] as const).map((word) => node("span", word.length === 1 ? word : say(word as Word, lang))));
    this.sayStates();
    this.sayTrouble();
    if (!$("statistics").hidden) this.sayStatistics();
    this.remark();
    this.relist();
  }

  private sayStates(): void {
    const { statistics } = this;
    if (!statistics) return $("states").replaceChildren();
    const numbers = { ...statistics.states, all: statistics.paths, warnings: statistics.with_warnings };
    // The list has a row for each drawing without readable paths, too; the statistics count only paths.
    const whole = this.rows().filter(({ path }) => path === null);
    for (const [filter] of FILTERS) numbers[filter] += whole.filter((row) => isListed(row, filter)).length;
    const shown = FILTERS.filter(([filter]) => filter === "all" || filter === this.filter || numbers[filter] > 0);
    const focused = document.activeElement?.id;
    const buttons = shown.map(([filter, word]) => {
      const button = node("button", `${say(word, lang)} ${new Intl.NumberFormat(lang).format(numbers[filter])}`);
      button.id = `filter-${filter}`;
      button.setAttribute("aria-pressed", String(filter === this.filter));
      button.addEventListener("click", () => {
        this.filter = filter;
        this.sayStates();
        this.relist();
      });
      return button;
    });
    $("states").replaceChildren(...buttons);
    if (focused?.startsWith("filter-")) document.getElementById(focused)?.focus();
  }

  private sayTrouble(): void {
    const lines: HTMLElement[] = [];
    if (!this.isOnline) lines.push(node("p", say("offline", lang)));
    if (this.settings && !this.program) lines.push(node("p", say("settingsFor", lang)));
    if (this.missing) lines.push(node("p", `${this.missing.path ?? ""} ${this.missing.file} ${say("missing", lang)}`.trim()));
    if (this.halted !== null) lines.push(node("p", `${say("halted", lang)} ${this.halted}`));
    for (const { code, file, message, help } of this.problems) {
      const line = node("p", `${file ? `${file}: ` : ""}${code}: ${message[lang]}`);
      if (help[lang]) line.append(node("small", help[lang]));
      lines.push(line);
    }
    $("trouble").replaceChildren(...lines);
    $("trouble").hidden = lines.length === 0;
  }

  private complain(text: string): void {
    $("trouble").replaceChildren(node("p", text));
    $("trouble").hidden = false;
  }

  private setOnline(isOnline: boolean): void {
    if (isOnline === this.isOnline) return;
    this.isOnline = isOnline;
    this.sayTrouble();
    this.remark();
  }

  /** Shows why the picture is missing or out of date, if it is. */
  private remark(): void {
    const text = this.failure !== "" ? this.failure : !this.isOnline ? say("offline", lang) : this.isGone ? `${this.open?.file} ${say("gone", lang)}` : "";
    this.note.textContent = text;
    this.note.hidden = text === "";
  }

  private toggleStatistics(): void {
    const shown = $("statistics");
    shown.hidden = !shown.hidden;
    $("totals").setAttribute("aria-expanded", String(!shown.hidden));
    if (!shown.hidden) this.sayStatistics();
  }

  private sayStatistics(): void {
    const { statistics } = this;
    if (!statistics) return;
    const number = (value: number | null, digits = 0) => (value === null ? say("noneOfIt", lang) : new Intl.NumberFormat(lang, { maximumFractionDigits: digits }).format(value));
    const minutes = (total: { minutes: number | null }) => (total.minutes === null ? "–" : number(total.minutes));
    const all = table([
      [say("drawings", lang), number(statistics.drawings)],
      [say("paths", lang), number(statistics.paths)],
      [say("length", lang), `${number(statistics.length)} mm`],
      [say("minutes", lang), minutes(statistics)],
      ...FILTERS.slice(1).map(([filter, word]) => [say(word, lang), number(filter === "warnings" ? statistics.with_warnings : statistics.states[filter as "ok"])]),
    ]);
    const heads = [say("paths", lang), `${say("length", lang)} mm`, say("min", lang)];
    const by = (word: Word, rows: [string, { paths: number; length: number; minutes: number | null }][]) =>
      table(rows.map(([name, total]) => [name, number(total.paths), number(total.length), minutes(total)]), [say(word, lang), ...heads]);
    $("statistics").replaceChildren(
      all,
      by("materialM", statistics.materials.map((it) => [it.material ?? say("noneOfIt", lang), it])),
      by("cutterO", statistics.cutters.map((it) => [number(it.tool, 3), it])),
    );
  }

  /** Shows another path, or only the list. */
  private choose(wanted: Wanted | null): void {
    const to = new URLSearchParams();
    if (wanted) to.set("file", wanted.file);
    if (wanted?.path) to.set("path", wanted.path);
    const hash = to.toString();
    if (location.hash.slice(1) === hash) return;
    history.pushState(null, "", hash ? `#${hash}` : location.pathname);
    this.follow();
  }

  /** Shows the path or program that the page's address names, or only the list. */
  private follow(): void {
    const from = new URLSearchParams(location.hash.slice(1));
    const file = from.get("file");
    const wasOpen = this.open !== null || (this.settings !== null && this.program !== null);
    this.settings = settingsIn(location.hash.slice(1));
    if (this.settings) assume(this.settings);
    this.open = file === null ? null : { file, path: from.get("path") };
    this.isGone = false;
    this.missing = null;
    this.sayTrouble();
    if (this.open || (this.settings && this.program)) {
      document.body.dataset.open = "true";
      void this.view(false);
    } else {
      delete document.body.dataset.open;
      this.look++;
      $("viewer").hidden = true;
      document.title = "pathbuild";
      hide();
    }
    this.list.set(null, this.open);
    this.remark();
    if (wasOpen && !this.open && !this.settings) $("list").focus();
  }

  /** Fetches and shows the open path or program. */
  private async view(isSame: boolean): Promise<void> {
    const [{ open, program, settings }, look] = [this, ++this.look];
    try {
      const scene = settings && program ? await this.source.program(program, settings, lang) : open && (await this.source.scene(open.file, open.path));
      if (!scene) return;
      if (look !== this.look) return;
      this.failure = "";
      const isShown = isSame && !$("viewer").hidden;
      $("viewer").hidden = false;
      show(scene, isShown, () => open && void this.still(open));
      this.isGone = false;
    } catch (error) {
      if (look !== this.look) return;
      if (settings) {
        this.failure = error instanceof Error ? error.message : String(error);
        $("viewer").hidden = false;
        return this.remark();
      }
      this.isGone = error instanceof Refused && error.status === 404;
      // There is no last state to show, or only that of another path.
      if (this.isGone && (!isSame || $("viewer").hidden)) return this.leave(open);
    }
    this.remark();
  }

  /** Shows the list instead of a path that is missing. */
  private leave(missing: Wanted | null): void {
    history.replaceState(null, "", location.pathname);
    this.follow();
    this.missing = missing;
    this.sayTrouble();
  }

  /** Shows the still picture as an image, so that no content of a drawing becomes part of this page. */
  private async still({ file, path }: Wanted): Promise<void> {
    const image = document.createElement("img");
    image.alt = path ?? file;
    image.src = URL.createObjectURL(await this.source.picture(file, path));
    image.addEventListener("load", () => URL.revokeObjectURL(image.src));
    $("still").replaceChildren(image);
  }
}

function isListed(row: LibraryRow, filter: Filter): boolean {
  return filter === "all" || (filter === "warnings" ? (row.warnings ?? 0) > 0 : row.state === filter);
}

/** Sorts files by path, so that the files of a directory are together. */
function inOrder(files: Iterable<string>): string[] {
  const keyed = [...files].map((file): [string, string] => [file.replaceAll("/", "\u0001"), file]);
  return keyed.sort(([a], [b]) => (a < b ? -1 : 1)).map(([, file]) => file);
}

function table(rows: string[][], heads: string[] = []): HTMLElement {
  const made = document.createElement("table");
  if (heads.length > 0) made.append(tableRow("th", heads));
  made.append(...rows.map((cells) => tableRow("td", cells)));
  return made;
}
