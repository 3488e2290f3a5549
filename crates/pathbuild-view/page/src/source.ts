// The data that the page of a library shows, and their source.

import { DroppedProgram, ProgramSettings } from "./programs.js";
import { Finding, Scene } from "./scene.js";
import { Lang } from "./words.js";

/** A row of `list`; a path that has not been checked yet has only its name. */
export interface LibraryRow {
  path: string | null;
  file: string;
  material?: string | null;
  thickness?: number | null;
  tool?: number | null;
  size?: [number, number] | null;
  length?: number | null;
  minutes?: number | null;
  state?: "errors" | "stale" | "unknown" | "current" | "ok";
  errors?: number;
  warnings?: number;
}

interface Total {
  paths: number;
  length: number;
  /** `null` if the time of a program is unknown. */
  minutes: number | null;
}

/** The results of `stats`. */
export interface Statistics extends Total {
  drawings: number;
  states: { errors: number; stale: number; unknown: number; current: number; ok: number };
  with_warnings: number;
  materials: (Total & { material: string | null })[];
  cutters: (Total & { tool: number | null })[];
}

/** Changes of a library since a revision. */
export interface LibraryNews {
  revision: number;
  /** Whether the answer contains all drawings and not only changed ones. */
  all: boolean;
  /** Whether everything has been checked. */
  complete: boolean;
  /** The reason why nothing is checked; `null` if drawings are checked. */
  halted: string | null;
  problems: Finding[];
  statistics: Statistics | null;
  /** Changed drawings. If `rows` is `null`, the drawing was removed. */
  drawings: { file: string; rows: LibraryRow[] | null }[];
  /** Whether there are more drawings than requested. */
  more: boolean;
}

/** Error for a refused request. */
export class Refused extends Error {
  constructor(readonly status: number) {
    super(`status ${status}`);
  }
}

/** Source of the page's data: a server, or the compiler in the page itself. */
export interface Source {
  /** Returns the changes since a revision, with at most `most` drawings. */
  library(since: number, most?: number): Promise<LibraryNews>;
  scene(file: string, path: string | null): Promise<Scene>;
  /** Returns a picture as SVG. */
  picture(file: string, path: string | null): Promise<Blob>;
  /** Returns the moves of a program read with these settings, and the findings of `verify`. */
  program(program: DroppedProgram, settings: ProgramSettings, lang: Lang): Promise<Scene>;
  /** Calls `hear` for each change, until there can be no more. */
  events(hear: () => void): Promise<void>;
}
