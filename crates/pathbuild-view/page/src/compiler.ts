// The compiler: a worker that answers questions. It is terminated when it exceeds its time, and restarted after that or after a bug.

import type { Finding, Opened } from "../../../../packaging/npm/index.js";
import { ProgramSettings } from "./programs.js";
import { LibraryRow } from "./source.js";
import type { CompilerResponse } from "./worker.js";

/** Files by their paths relative to the given folder. */
export type Files = Map<string, ArrayBuffer>;

export type { Opened };

/** Options that the page sets in addition to the configuration. */
export interface Options {
  feed?: string;
  "sweep-height"?: string;
  rapid?: string;
  "probe-feed"?: string;
  post?: string;
  lang: string;
}

/** A path of a drawing, or all of its paths. */
export interface Place {
  file: string;
  path: string | null;
}

/** A listed path, and whether it is written when all programs are emitted. */
export type IndexRow = LibraryRow & { emitted?: boolean };

interface Answer {
  // JSON as defined by crates/pathbuild-wasm.
  head: any;
  bytes: Uint8Array<ArrayBuffer>;
}

/** Error of a compiler that was terminated during a question. */
class Ended extends Error {
  constructor(readonly why: { why: "time" } | { why: "bug"; reason: string }) {
    super(why.why === "bug" ? why.reason : why.why);
  }
}

/** Time limit in seconds for opening files: the same as the default for one path. */
const OPENING = 60;

export class Compiler {
  private worker: Worker | null = null;
  /** The last question: questions are asked one at a time. */
  private last: Promise<unknown> = Promise.resolve();
  /** Paths that terminated the compiler, with the reasons. */
  private lost: (Place & Ended["why"])[] = [];
  private seconds = OPENING;
  private isOver = false;
  /** Number of times that the compiler was started. A restarted compiler has lost all earlier results. */
  generation = 0;

  constructor(
    private wasm: ArrayBuffer,
    private script: string,
    private files: Files,
    private options: Options,
  ) {}

  async open(): Promise<Opened> {
    return this.next(() => this.begin());
  }

  async index(file: string): Promise<IndexRow[]> {
    return (await this.ask("index", { file, path: null })).head.rows;
  }

  /** Checks a path and returns its row. */
  async check(place: Place): Promise<LibraryRow | null> {
    return (await this.ask("check", place)).head.row;
  }

  /** Returns a scene as data or as SVG; `null` if there is nothing to show. */
  async see(what: "scene" | "picture", place: Place): Promise<Uint8Array<ArrayBuffer> | null> {
    const { head, bytes } = await this.ask(what, place);
    return head.seen ? bytes : null;
  }

  /** Returns the scene of a program, read with these settings. */
  async program(name: string, text: ArrayBuffer, { dialect, cutter, surface }: ProgramSettings): Promise<Uint8Array<ArrayBuffer>> {
    const given = Object.fromEntries(Object.entries({ dialect, cutter, surface }).filter(([, value]) => value !== ""));
    const { bytes } = await this.next(() => this.put({ ask: "program", name, ...given }, text.slice(0)));
    return bytes;
  }

  /** Returns the statistics of all paths checked since the compiler was started. */
  async statistics(): Promise<any> {
    return (await this.next(() => this.put({ ask: "statistics" }))).head.statistics;
  }

  async emit(places: Place[]): Promise<{ refused: string | null; problems: Finding[]; files: [string, Uint8Array<ArrayBuffer>][] }> {
    const { head, bytes } = await this.next(() => this.put({ ask: "emit", places }, undefined, this.seconds * Math.max(1, places.length)));
    let from = 0;
    const file = ({ name, size }: { name: string; size: number }): [string, Uint8Array<ArrayBuffer>] => [name, bytes.slice(from, (from += size))];
    return { ...head, files: head.files.map(file) };
  }

  end(): void {
    this.isOver = true;
    this.stop();
  }

  /** Asks a question about a path. For a path that has terminated the compiler, the answer is a finding with the reason. */
  private ask(what: string, place: Place): Promise<Answer> {
    return this.next(async () => {
      try {
        return await this.put({ ask: what, ...place });
      } catch (error) {
        if (!(error instanceof Ended) || this.isOver) throw error;
        this.lost.push({ ...place, ...error.why });
        return this.put({ ask: what, ...place });
      }
    });
  }

  private next<T>(work: () => Promise<T>): Promise<T> {
    const result = this.last.then(work);
    this.last = result.catch(() => {});
    return result;
  }

  /** Asks a question once the compiler has opened the files. */
  private async put(question: object, bytes?: ArrayBuffer, seconds = this.seconds): Promise<Answer> {
    if (!this.worker) await this.begin();
    return this.send(question, bytes, seconds);
  }

  /** Restarts the worker with all files, without the paths that terminated it. */
  private async begin(): Promise<Opened> {
    this.stop();
    if (this.isOver) throw new Ended({ why: "bug", reason: "" });
    const address = URL.createObjectURL(new Blob([this.script], { type: "text/javascript" }));
    this.worker = new Worker(address);
    URL.revokeObjectURL(address);
    this.generation++;
    this.worker.postMessage(this.wasm);
    for (const [file, bytes] of this.files) await this.send({ ask: "put", file }, bytes, OPENING);
    const { options, lost } = this;
    const opened: Opened = (await this.send({ ask: "open", options, lost }, undefined, OPENING)).head;
    this.seconds = opened.seconds || OPENING;
    return opened;
  }

  private stop(): void {
    this.worker?.terminate();
    this.worker = null;
  }

  private send(question: object, bytes: ArrayBuffer | undefined, seconds: number): Promise<Answer> {
    const { worker } = this;
    return new Promise((answer, fail) => {
      if (!worker || this.isOver) return fail(new Ended({ why: "bug", reason: "" }));
      const ended = (why: Ended["why"]) => {
        clearTimeout(timer);
        this.stop();
        fail(new Ended(why));
      };
      const timer = setTimeout(() => ended({ why: "time" }), seconds * 1000);
      worker.onerror = (event) => ended({ why: "bug", reason: event.message });
      worker.onmessage = ({ data }: MessageEvent<CompilerResponse>) => {
        if ("trap" in data) return ended({ why: "bug", reason: data.trap });
        clearTimeout(timer);
        const head = JSON.parse(data.head) ?? {};
        if (head.wrong !== undefined) return ended({ why: "bug", reason: head.wrong });
        answer({ head, bytes: data.bytes });
      };
      worker.postMessage({ head: JSON.stringify(question), bytes });
    });
  }
}
