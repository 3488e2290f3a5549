// Programs dropped on the page, and the values assumed for them. An address contains the settings, never a program.

/** Values entered by the user; empty values are taken from the program. */
export interface ProgramSettings {
  dialect: string;
  cutter: string;
  surface: string;
  thickness: string;
  rapid: string;
}

/** Ids of the page's fields by setting. */
export const FIELDS: Record<keyof ProgramSettings, string> = {
  dialect: "assumedDialect",
  cutter: "assumedTool",
  surface: "assumedSurface",
  thickness: "assumedThickness",
  rapid: "assumedRapid",
};

const NAMES = Object.keys(FIELDS) as (keyof ProgramSettings)[];

/** A dropped program: its name and bytes. */
export interface DroppedProgram {
  name: string;
  bytes: ArrayBuffer;
}

/** A check of a program: made, made with values from its comments only, or not made. */
export interface Check {
  check: string;
  outcome: "made" | "assumed" | "not-made";
  text: { en: string; de: string };
}

/** The data about a program besides its moves. */
export interface ProgramRecord {
  dialect: string;
  /** Dialects in which the program can be read again; none on a page that cannot read it again. */
  dialects?: string[];
  /** The dialect in which the program was read, with the reason for this choice. */
  read_as: { en: string; de: string };
  checks: Check[];
  /** Cutter diameters in mm that the program itself states. */
  cutters: { line: number; diameter: number }[];
  surface: number | null;
  /** Whether the material lies on Z 0. Otherwise its thickness is unknown. */
  is_on_zero: boolean;
  /** Description of dwells, stops and tool changes, which the times do not include. */
  waits?: { en: string; de: string };
}

/** Parses the settings in an address; `null` if the address is not that of a program. */
export function settingsIn(fragment: string): ProgramSettings | null {
  const from = new URLSearchParams(fragment);
  if (!from.has("program")) return null;
  return Object.fromEntries(NAMES.map((name) => [name, from.get(name) ?? ""])) as unknown as ProgramSettings;
}

/** Formats settings as the fragment of an address. */
export function fragmentOf(settings: ProgramSettings): string {
  const given = NAMES.filter((name) => settings[name] !== "").map((name) => `&${name}=${encodeURIComponent(settings[name])}`);
  return `program${given.join("")}`;
}

/** Names of drawings and related files; any other file dropped on its own is treated as a program. */
const LIBRARY = /\.(dxf|toml|cbpp|zip)$|(^|\/)\.(git)?ignore$/i;

export function isProgram(name: string): boolean {
  return !LIBRARY.test(name);
}
