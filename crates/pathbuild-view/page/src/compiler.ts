// The compiler: a worker that is asked, is ended when it takes too long, and begun anew after that and after a bug.

import type { Finding, Opened } from "../../../../packaging/npm/index.js";
import { ProgramSettings } from "./programs.js";
import { LibraryRow } from "./source.js";
import type { Answered } from "./worker.js";

/** Files by their places below the folder that was given. */
export type Files = Map<string, ArrayBuffer>;

export type { Opened };

/** What the page says beside the configuration. */
export interface Options {
  feed?: string;
  "sweep-height"?: string;
  rapid?: string;
  "probe-feed"?: string;
  post?: string;
  lang: string;
}

/** A path of a drawing, or all of them. */
export interface Place {
  file: string;
  path: string | null;
}

/** A path that is listed; whether it is written when all are. */
export type IndexRow = LibraryRow & { emitted?: boolean };

interface Answer {
  // The JSON is that of crates/pathbuild-wasm.
  head: any;
  bytes: Uint8Array<ArrayBuffer>;
}

/** Why the compiler ended in the middle of a question. */
class Ended extends Error {
  constructor(readonly why: { why: "time" } | { why: "bug"; reason: string }) {
    super(why.why === "bug" ? why.reason : why.why);
  }
}

/** So long, in seconds, opening may take: as long as the default for one path. */
const OPENING = 60;

export class Compiler {
  private worker: Worker | null = null;
  /** Questions are asked one after the other. */
  private last: Promise<unknown> = Promise.resolve();
  /** What ended it. */
  private lost: (Place & Ended["why"])[] = [];
  private seconds = OPENING;
  private isOver = false;
  /** Grows when it begins anew: it has forgotten what it was asked then. */
  generation = 0;

  constructor(
    private wasm: ArrayBuffer,
    private script: string,
    private files: Files,
    private options: Options,
  ) {}

  /** What the files are. */
  async open(): Promise<Opened> {
    return this.next(() => this.begin());
  }

  /** The paths of a drawing. */
  async index(file: string): Promise<IndexRow[]> {
    return (await this.ask("index", { file, path: null })).head.rows;
  }

  /** A path with its state. */
  async check(place: Place): Promise<LibraryRow | null> {
    return (await this.ask("check", place)).head.row;
  }

  /** What there is to see, as data or as SVG; `null`: nothing. */
  async see(what: "scene" | "picture", place: Place): Promise<Uint8Array<ArrayBuffer> | null> {
    const { head, bytes } = await this.ask(what, place);
    return head.seen ? bytes : null;
  }

  /** A program with settings, as a scene. */
  async program(name: string, text: ArrayBuffer, { dialect, cutter, surface }: ProgramSettings): Promise<Uint8Array<ArrayBuffer>> {
    const given = Object.fromEntries(Object.entries({ dialect, cutter, surface }).filter(([, value]) => value !== ""));
    const { bytes } = await this.next(() => this.put({ ask: "program", name, ...given }, text.slice(0)));
    return bytes;
  }

  /** What all paths add up to that it was asked for. */
  async statistics(): Promise<any> {
    return (await this.next(() => this.put({ ask: "statistics" }))).head.statistics;
  }

  /** Programs. */
  async emit(places: Place[]): Promise<{ refused: string | null; problems: Finding[]; files: [string, Uint8Array<ArrayBuffer>][] }> {
    const { head, bytes } = await this.next(() => this.put({ ask: "emit", places }, undefined, this.seconds * Math.max(1, places.length)));
    let from = 0;
    const file = ({ name, size }: { name: string; size: number }): [string, Uint8Array<ArrayBuffer>] => [name, bytes.slice(from, (from += size))];
    return { ...head, files: head.files.map(file) };
  }

  /** Ends it. */
  end(): void {
    this.isOver = true;
    this.stop();
  }

  /** Asks for a path. One that ends the compiler is lost: asked again, it has a finding that says why. */
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

  /** Asks, of a compiler that has opened the files. */
  private async put(question: object, bytes?: ArrayBuffer, seconds = this.seconds): Promise<Answer> {
    if (!this.worker) await this.begin();
    return this.send(question, bytes, seconds);
  }

  /** Begins anew: with all files, and without what was lost. */
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
      worker.onmessage = ({ data }: MessageEvent<Answered>) => {
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
