// What a page of a library shows, and whom it asks for it.

import { DroppedProgram, ProgramSettings } from "./programs.js";
import { Finding, Scene } from "./scene.js";
import { Lang } from "./words.js";

/** A row of `list`; of what is not checked yet only its name is known. */
export interface LibraryRow {
  path: string | null;
  file: string;
  material?: string | null;
  thickness?: number | null;
  tool?: number | null;
  size?: [number, number] | null;
  length?: number | null;
  minutes?: number | null;
  state?: "errors" | "stale" | "current" | "ok";
  errors?: number;
  warnings?: number;
}

interface Total {
  paths: number;
  length: number;
  minutes: number;
}

/** What `stats` says. */
export interface Statistics extends Total {
  drawings: number;
  states: { errors: number; stale: number; current: number; ok: number };
  with_warnings: number;
  materials: (Total & { material: string | null })[];
  cutters: (Total & { tool: number | null })[];
}

/** What is new. */
export interface LibraryNews {
  revision: number;
  /** Whether it is everything. */
  all: boolean;
  /** Whether everything has been checked. */
  complete: boolean;
  /** Why nothing is checked. */
  halted: string | null;
  problems: Finding[];
  statistics: Statistics | null;
  /** Without rows: it is gone. */
  drawings: { file: string; rows: LibraryRow[] | null }[];
  /** Whether there are more drawings than were asked for. */
  more: boolean;
}

/** An answer that is none. */
export class Refused extends Error {
  constructor(readonly status: number) {
    super(`status ${status}`);
  }
}

/** Whom the page asks: a server, or the compiler in the page itself. */
export interface Source {
  /** What came after a change; of drawings so many at most, the first ones. */
  library(since: number, most?: number): Promise<LibraryNews>;
  scene(file: string, path: string | null): Promise<Scene>;
  /** SVG. */
  picture(file: string, path: string | null): Promise<Blob>;
  /** A program with these settings: its moves, and what `verify` finds. */
  program(program: DroppedProgram, settings: ProgramSettings, lang: Lang): Promise<Scene>;
  /** Calls for each change, until there can be no more. */
  events(hear: () => void): Promise<void>;
}
