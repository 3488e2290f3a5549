// The page without a server: the page of a library of dropped files, compiled in the browser.

import { zipSync } from "fflate";
import { Compiler, Files, IndexRow, Options, Place } from "./compiler.js";
import { $, node } from "./dom.js";
import { Given, MOST_BYTES, MOST_FILES, TooMuch, dropped, joined, picked } from "./files.js";
import { live } from "./live.js";
import { EXAMPLE, EXAMPLE_NAME } from "./example.js";
import { DroppedProgram, ProgramSettings, isProgram } from "./programs.js";
import { Finding, Scene } from "./scene.js";
import { LibraryNews, LibraryRow, Refused, Source, Statistics } from "./source.js";
import { lang, onSpeak, speak } from "./viewer.js";
import { Word, say } from "./words.js";

/** Interval in ms at which checked paths are shown. */
const PAUSE = 100;

/** The source of data for the files that the user has given. */
class Local implements Source {
  files: Files = new Map();
  compiler: Compiler | null = null;
  private drawings = new Map<string, IndexRow[] | null>();
  private changed = new Set<string>();
  private isNew = true;
  private revision = 0;
  private isComplete = true;
  private halted: string | null = null;
  private problems: Finding[] = [];
  private statistics: Statistics | null = null;
  private hear: () => void = () => {};
  private told = 0;
  /** Resolves when all paths are listed; only then is it known what can be shown. */
  private listed: Promise<void> = Promise.resolve();
  /** Resolves when all paths are checked. */
  private settled: Promise<void> = Promise.resolve();

  constructor(
    private wasm: ArrayBuffer,
    private script: string,
    private opened: (posts: { name: string; for: string }[]) => void,
  ) {}

  /** Opens files and closes those that were open. */
  open(files: Files, options: Options): void {
    document.body.dataset.files = "true";
    this.compiler?.end();
    const compiler = new Compiler(this.wasm, this.script, files, options);
    Object.assign(this, { files, compiler, statistics: null, problems: [], halted: null, isComplete: false, isNew: true });
    this.drawings.clear();
    this.changed.clear();
    const fail = (error: unknown) => {
      if (compiler === this.compiler) this.halted = `${say("broken", lang)} ${error instanceof Error ? error.message : error}`;
    };
    this.listed = this.list(compiler).catch(fail);
    this.settled = this.listed.then(() => this.check(compiler)).catch(fail).then(() => this.finish(compiler));
  }

  /** Returns the paths that are written when all programs are emitted, once all paths are checked. */
  async emitted(): Promise<Place[]> {
    for (let settled = null; settled !== this.settled; ) await (settled = this.settled);
    const rows = [...this.drawings].flatMap(([file, rows]) => (rows ?? []).map((row) => ({ ...row, file })));
    return rows.filter((row) => row.path !== null && row.emitted && row.state !== "errors").map(({ file, path }) => ({ file, path }));
  }

  /** Returns the paths of a drawing, or one of them. */
  places({ file, path }: Place): Place[] {
    return path !== null ? [{ file, path }] : (this.drawings.get(file) ?? []).filter((row) => row.path !== null).map((row) => ({ file, path: row.path }));
  }

  async library(): Promise<LibraryNews> {
    const { halted, problems, statistics } = this;
    const drawings = [...this.changed].map((file) => ({ file, rows: this.drawings.get(file) ?? null }));
    const news = { revision: this.revision, all: this.isNew, complete: this.isComplete, halted, problems, statistics, drawings, more: false };
    this.changed.clear();
    this.isNew = false;
    return news;
  }

  async scene(file: string, path: string | null): Promise<Scene> {
    return JSON.parse(new TextDecoder().decode(await this.see("scene", { file, path })));
  }

  async picture(file: string, path: string | null): Promise<Blob> {
    return new Blob([await this.see("picture", { file, path })], { type: "image/svg+xml" });
  }

  async program({ name, bytes }: DroppedProgram, settings: ProgramSettings): Promise<Scene> {
    await this.listed;
    this.compiler ??= new Compiler(this.wasm, this.script, this.files, options());
    return JSON.parse(new TextDecoder().decode(await this.compiler.program(name, bytes, settings)));
  }

  events(hear: () => void): Promise<void> {
    this.hear = hear;
    hear();
    return new Promise(() => {});
  }

  private async see(what: "scene" | "picture", place: Place): Promise<Uint8Array<ArrayBuffer>> {
    await this.listed;
    const seen = this.drawings.has(place.file) ? await this.compiler!.see(what, place) : null;
    if (!seen) throw new Refused(404);
    return seen;
  }

  private async list(compiler: Compiler): Promise<void> {
    const { halted, problems, drawings, posts } = await compiler.open();
    if (compiler !== this.compiler) return;
    [this.halted, this.problems] = [halted, problems];
    this.opened(posts);
    for (const file of drawings) {
      const rows = await compiler.index(file);
      if (compiler !== this.compiler) return;
      this.set(file, rows);
    }
    this.tell(true);
  }

  private async check(compiler: Compiler): Promise<void> {
    if (compiler !== this.compiler || this.halted !== null) return;
    // A restarted compiler has lost the figures of the paths checked before.
    const known = new Map<IndexRow, number>();
    for (let isSettled = false; !isSettled; ) {
      isSettled = true;
      for (const file of this.drawings.keys()) {
        for (const row of this.drawings.get(file) ?? []) {
          if (row.path === null || known.get(row) === compiler.generation) continue;
          isSettled = false;
          const checked: LibraryRow | null = await compiler.check({ file, path: row.path });
          if (compiler !== this.compiler) return;
          Object.assign(row, checked);
          known.set(row, compiler.generation);
          this.set(file, this.drawings.get(file)!);
        }
      }
    }
    this.statistics = await compiler.statistics();
  }

  private finish(compiler: Compiler): void {
    if (compiler !== this.compiler) return;
    this.isComplete = true;
    this.tell(true);
  }

  private set(file: string, rows: IndexRow[]): void {
    this.drawings.set(file, rows);
    this.changed.add(file);
    this.tell(false);
  }

  private tell(isUrgent: boolean): void {
    const now = performance.now();
    if (!isUrgent && now - this.told < PAUSE) return;
    this.told = now;
    this.revision++;
    this.hear();
  }
}

/** File name of the configuration, at the root of the given files. */
const CONFIGURATION = "pathbuild.toml";

const FIELDS = ["feed", "sweep-height", "rapid", "probe-feed"] as const;

/** Returns the options that the user has set on the page in addition to the configuration. */
function options(): Options {
  const said: Options = { lang };
  for (const name of FIELDS) {
    const value = $<HTMLInputElement>(name).value.trim();
    if (value !== "") said[name] = value;
  }
  const post = $<HTMLSelectElement>("post").value;
  if (post !== "") said.post = post;
  return said;
}

/** Decodes bytes that are embedded in the page, compressed and in base64. */
async function unpacked(id: string): Promise<ArrayBuffer> {
  const packed = Uint8Array.from(atob($(id).textContent!.trim()), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/** Shows lines of text below the bar; an empty list hides them. */
function tell(lines: string[]): void {
  $("said").replaceChildren(...lines.map((line) => node("p", line)));
  $("said").hidden = lines.length === 0;
}

function message({ code, file, message, help }: Finding): string {
  return `${file ? `${file}: ` : ""}${code}: ${message[lang]}${help[lang] ? ` (${help[lang]})` : ""}`;
}

function save(name: string, bytes: BlobPart): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Downloads programs: a single file as it is, several as an archive. */
async function download(source: Local, wanted: Place[] | Promise<Place[]>): Promise<void> {
  tell([]);
  const places = await wanted;
  const { compiler } = source;
  if (!compiler || places.length === 0) return tell([say("noProgram", lang)]);
  try {
    const { refused, problems, files } = await compiler.emit(places);
    const lines = [...(refused?.split("\n") ?? []), ...problems.map(message)];
    const base = (name: string) => name.slice(name.lastIndexOf("/") + 1);
    if (files.length === 1) save(base(files[0][0]), files[0][1]);
    else if (files.length > 1) save("pathbuild.zip", zipSync(Object.fromEntries(files)));
    const done = files.length === 0 ? (lines.length === 0 ? [say("noProgram", lang)] : []) : [`${say("downloaded", lang)} ${files.map(([name]) => base(name)).join(", ")}`];
    tell([...done, ...lines]);
  } catch (error) {
    tell([`${say("broken", lang)} ${error instanceof Error ? error.message : error}`]);
  }
}

async function begin(): Promise<void> {
  let openProgram: (program: DroppedProgram) => void = () => {};
  const toml = $<HTMLTextAreaElement>("toml");
  const source = new Local(await unpacked("wasm"), $("worker").textContent!, offer);
  const take = async (given: Promise<Given>) => {
    tell([]);
    try {
      const all = await given;
      if (!all.isFolder) {
        const programs = [...all.files].filter(([name]) => isProgram(name));
        for (const [name, bytes] of programs) {
          all.files.delete(name);
          openProgram({ name, bytes });
        }
        if (programs.length > 0 && all.files.size === 0) return;
      }
      const files = joined(source.files, all);
      toml.value = new TextDecoder().decode(files.get(CONFIGURATION));
      if (files.size > 0) source.open(files, options());
    } catch (error) {
      if (!(error instanceof TooMuch)) return tell([`${say("unreadable", lang)} ${error instanceof Error ? error.message : error}`]);
      const [megabytes, most] = [error.bytes, MOST_BYTES].map((bytes) => `${Math.ceil(bytes / (1 << 20))} MB`);
      tell([`${say("tooMuch", lang)} (${error.files} ${say("files", lang)}, ${megabytes}; ${say("most", lang)} ${MOST_FILES} ${say("files", lang)}, ${most})`]);
    }
  };
  for (const [button, input] of [["pick-drawings", "drawings"], ["pick-folder", "folder"]]) {
    const chosen = $<HTMLInputElement>(input);
    $(button).addEventListener("click", () => chosen.click());
    chosen.addEventListener("change", () => {
      if (chosen.files) void take(picked(chosen.files)).then(() => (chosen.value = ""));
    });
  }
  $("drop").addEventListener("click", (event) => event.target instanceof HTMLParagraphElement && $<HTMLInputElement>("drawings").click());
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer) void take(dropped(event.dataTransfer));
  });
  const again = () => {
    if (source.files.size > 0) source.open(source.files, options());
  };
  for (const name of [...FIELDS, "post"]) $(name).addEventListener("change", again);
  // Beside a path, the field for the missing speed of rapid moves is that of the settings; beside a program, it belongs to the program.
  $("assumedRapid").addEventListener("change", (event) => {
    if (!new URLSearchParams(location.hash.slice(1)).has("file")) return;
    $<HTMLInputElement>("rapid").value = (event.target as HTMLInputElement).value;
    again();
  });
  $("download-all").addEventListener("click", () => void download(source, source.emitted()));
  $("configure").addEventListener("click", () => {
    toml.hidden = !toml.hidden;
    $("configure").setAttribute("aria-expanded", String(!toml.hidden));
  });
  toml.addEventListener("change", () => {
    source.files.set(CONFIGURATION, new TextEncoder().encode(toml.value).buffer);
    again();
  });
  const single = document.createElement("button");
  single.id = "download";
  single.dataset.word = "download";
  single.addEventListener("click", () => {
    const from = new URLSearchParams(location.hash.slice(1));
    void download(source, source.places({ file: from.get("file") ?? "", path: from.get("path") }));
  });
  $("viewer").querySelector("nav")!.prepend(single);
  openProgram = live(source);
  for (const button of document.querySelectorAll(".example")) button.addEventListener("click", () => openProgram({ name: EXAMPLE_NAME, bytes: new TextEncoder().encode(EXAMPLE).buffer }));
  onSpeak(label);
  onSpeak(turnBook);
  speak();
}

/** Fills the selection of posts, unless it is already filled. */
function offer(posts: { name: string; for: string }[]): void {
  const select = $<HTMLSelectElement>("post");
  if (select.options.length > 1) return;
  for (const { name, for: whom } of posts) select.append(new Option(name, name));
  [...select.options].slice(1).forEach((option, index) => (option.title = posts[index].for));
}

/** Links the book in the current language. */
function turnBook(): void {
  for (const link of document.querySelectorAll<HTMLAnchorElement>("a.book")) link.href = link.href.replace(/\/docs\/(en|de)\//, `/docs/${lang}/`);
}

/** Labels the fields, also for screen readers. */
function label(): void {
  const names: [string, Word, string][] = [
    ["post", "post", ""],
    ["feed", "feedF", "mm/min"],
    ["sweep-height", "sweepHeight", "mm"],
    ["rapid", "sweep", "mm/min"],
    ["probe-feed", "probeFeed", "mm/min"],
  ];
  for (const [id, word, unit] of names) $(id).title = unit;
  for (const [id, word] of names) $(id).setAttribute("aria-label", say(word, lang));
}

if (typeof WebAssembly === "undefined" || typeof DecompressionStream === "undefined") {
  speak();
  tell([say("noWasm", lang)]);
} else {
  await begin();
}
document.documentElement.dataset.ready = "true";
