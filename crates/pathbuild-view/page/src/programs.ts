// Programs that a visitor drops on the page, and what is assumed for them. An address holds the settings, never a program.

/** Values that are typed in; empty: as the program says. */
export interface ProgramSettings {
  dialect: string;
  cutter: string;
  surface: string;
  thickness: string;
  rapid: string;
}

/** Fields of the page by setting. */
export const FIELDS: Record<keyof ProgramSettings, string> = {
  dialect: "assumedDialect",
  cutter: "assumedTool",
  surface: "assumedSurface",
  thickness: "assumedThickness",
  rapid: "assumedRapid",
};

const NAMES = Object.keys(FIELDS) as (keyof ProgramSettings)[];

/** What is asked: the text of a program, with settings. */
export interface DroppedProgram {
  name: string;
  bytes: ArrayBuffer;
}

/** A check of a program: made, made with values that only its comments give, or not made. */
export interface Check {
  check: string;
  outcome: "made" | "assumed" | "not-made";
  text: { en: string; de: string };
}

/** What is known of a program besides its moves. */
export interface ProgramRecord {
  dialect: string;
  dialects: string[];
  /** How it was read, and why. */
  read_as: { en: string; de: string };
  checks: Check[];
  /** Cutters in mm that the program says by itself, and the upper face of the material. */
  cutters: { line: number; diameter: number }[];
  surface: number | null;
}

/** The settings in an address; `null`: it is not one of a program. */
export function settingsIn(fragment: string): ProgramSettings | null {
  const from = new URLSearchParams(fragment);
  if (!from.has("program")) return null;
  return Object.fromEntries(NAMES.map((name) => [name, from.get(name) ?? ""])) as unknown as ProgramSettings;
}

/** The fragment of an address with settings. */
export function fragmentOf(settings: ProgramSettings): string {
  const given = NAMES.filter((name) => settings[name] !== "").map((name) => `&${name}=${encodeURIComponent(settings[name])}`);
  return `program${given.join("")}`;
}

/** Drawings and what belongs to them; everything else that is dropped by itself is taken for a program. */
const LIBRARY = /\.(dxf|toml|cbpp|zip)$|(^|\/)\.(git)?ignore$/i;

export function isProgram(name: string): boolean {
  return !LIBRARY.test(name);
}
