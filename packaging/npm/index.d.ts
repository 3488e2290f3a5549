/**
 * Compiles drawings of milling paths to G-code, with files in memory. Lengths are in mm, feeds in mm/min, angles in degrees, times in minutes.
 * Calls are synchronous and may take as long as a drawing demands: use a worker where a page must stay responsive.
 */

/** Compiles the WebAssembly module (`pathbuild/pathbuild.wasm`), and begins with no files. */
export function load(wasm: BufferSource | WebAssembly.Module): Promise<Compiler>;

/** Files in memory, and what is asked about them. Every method throws `Trap` if a bug ends the compiler, which then answers no more. */
export class Compiler {
  private constructor();
  /** Adds or replaces a file: a drawing, a `pathbuild.toml`, a post definition. Its name is relative to the directory in which pathbuild runs. Call it before `open`. */
  put(file: string, content: Uint8Array | string): void;
  /** Applies the configuration among the files. The other methods need it; call it again for other options. */
  open(options?: Options): Opened;
  /** The paths of a drawing. An entry without a path says that the drawing itself has errors. */
  paths(file: string): PathEntry[];
  /** A path with its state, as `pathbuild list` shows it; null if there is no such path. `scene` has its findings. */
  check(file: string, path: string): CheckedPath | null;
  /** Totals over all paths that were checked. */
  statistics(): Statistics;
  /** Moves, elements and findings of a path, or of all paths of the drawing; null if there is none. */
  scene(file: string, path?: string | null): Scene | null;
  /** The same as an SVG picture. */
  picture(file: string, path?: string | null): string | null;
  /** The programs of paths, byte for byte as `pathbuild emit` writes them. */
  emit(places: Place[]): Emitted;
}

/** Options that take precedence over the configuration. Numbers are texts, as on the command line. */
export interface Options {
  feed?: string;
  "sweep-height"?: string;
  rapid?: string;
  "probe-feed"?: string;
  /** Name of a built-in post-processor, or of a definition among the files. */
  post?: string;
  lang?: "en" | "de";
}

export interface Opened {
  /** Not null if the configuration or the post is wrong: `problems` says how, and nothing can be asked. */
  halted: string | null;
  problems: Finding[];
  /** The drawings of the library. */
  drawings: string[];
  /** The built-in post-processors. */
  posts: { name: string; for: string }[];
  /** The limit `seconds-per-path`. */
  seconds: number;
}

export interface PathEntry {
  path: string | null;
  /** Whether `pathbuild emit` without arguments writes it. */
  emitted?: boolean;
  state?: "errors";
  errors?: number;
  warnings?: number;
}

export interface CheckedPath {
  path: string;
  file: string;
  material: string | null;
  thickness: number | null;
  /** Diameter of the cutter. */
  tool: number | null;
  size: [number, number] | null;
  cutting_box: Record<"x" | "y" | "z", [number, number] | null>;
  length: number | null;
  minutes: number | null;
  state: "errors" | "stale" | "current" | "ok";
  /** Whether the program among the files is that of the drawing; null if there is none. */
  program: "current" | "stale" | null;
  errors: number;
  warnings: number;
}

export interface Total {
  paths: number;
  length: number;
  minutes: number;
}

export interface Statistics extends Total {
  drawings: number;
  states: Record<"errors" | "stale" | "current" | "ok", number>;
  with_warnings: number;
  materials: (Total & { material: string | null })[];
  cutters: (Total & { tool: number | null })[];
}

export interface Finding {
  number: number;
  /** For example `PB107`. */
  code: string;
  is_error: boolean;
  message: { en: string; de: string };
  help: { en: string; de: string };
  /** Facts that explain it, if there are any. */
  notes?: { en: string; de: string }[];
  file: string | null;
  path: string | null;
  /** Line of the file, counted from 1. */
  line: number | null;
  at: [number, number] | null;
}

/** A coordinate is null where it is not known yet. */
export type Point = [number | null, number | null, number | null];

export interface Move {
  kind: "sweep" | "lift" | "plunge" | "mill" | "mark" | "probe";
  from: Point;
  to: Point;
  length: number | null;
  /** Line of the program, counted from 1. */
  line: number | null;
  feed?: number;
  arc?: { axes: [number, number]; centre: [number, number]; clockwise: boolean; degrees: number };
  /** Index in `elements` of the path. */
  element?: number;
}

/** The book describes it under "The scene as data". */
export interface Scene {
  schema: string;
  version: number;
  title: string;
  paths: { name: string; moves: Move[]; [part: string]: unknown }[];
  findings: Finding[];
  [part: string]: unknown;
}

export interface Place {
  /** The drawing. */
  file: string;
  path: string;
}

export interface Emitted {
  /** Why nothing was written. */
  refused: string | null;
  problems: Finding[];
  files: { name: string; bytes: Uint8Array<ArrayBuffer> }[];
}

/** A bug or a lack of memory ended the compiler. Load it anew. */
export class Trap extends Error {}

/** One WebAssembly instance, for those who write the messages of crates/pathbuild-wasm themselves. */
export class Instance {
  private constructor();
  /** Answers a question: a line of JSON, and bytes. */
  ask(head: string, bytes?: Uint8Array): { head: string; bytes: Uint8Array<ArrayBuffer> };
}

export function instantiate(wasm: BufferSource | WebAssembly.Module): Promise<Instance>;
