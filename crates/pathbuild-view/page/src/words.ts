// What the page says, in both languages.

export type Lang = "en" | "de";

const words = {
  view2: ["Top", "Oben"],
  view3: ["3D", "3D"],
  fit: ["Fit", "Einpassen"],
  stock: ["Stock", "Rohteil"],
  rapids: ["Rapids", "Eilgänge"],
  arrows: ["Arrows", "Pfeile"],
  order: ["Order", "Reihenfolge"],
  texts: ["Texts", "Texte"],
  other: ["Other layers", "Andere Layer"],
  measure: ["Measure", "Messen"],
  theme: ["Light/dark", "Hell/dunkel"],
  play: ["Run", "Ablauf"],
  stop: ["Stop", "Anhalten"],
  step: ["Move", "Bewegung"],
  of: ["of", "von"],
  tool: ["cutter O", "Fräser O"],
  thickness: ["thickness T", "Dicke T"],
  material: ["material M", "Material M"],
  milling: ["milling", "Fräsen"],
  drilling: ["plunging", "Eintauchen"],
  sweeps: ["rapid", "Eilgang"],
  time: ["time", "Zeit"],
  findings: ["Findings", "Befunde"],
  element: ["Element", "Element"],
  layer: ["layer", "Layer"],
  line: ["line in the file", "Zeile in der Datei"],
  text: ["its text", "eigener Text"],
  pathText: ["text of path", "Text des Pfads"],
  none: ["none", "keiner"],
  fromOwn: ["own text", "eigener Text"],
  fromChain: ["first segment of the chain", "erstes Segment der Kette"],
  fromPath: ["text of the path", "Text des Pfads"],
  fromLender: ["@, text of path", "@, Text des Pfads"],
  fromOption: ["option --", "Option --"],
  fromLine: ["in pathbuild.toml, line", "in pathbuild.toml, Zeile"],
  fromDefault: ["default", "Vorgabe"],
  feed: ["feed", "Vorschub"],
  pick: ["Click two points to measure.", "Zum Messen zwei Punkte anklicken."],
  keys: [
    "← → one move · PgUp PgDn ten · Home End · space runs · 2 3 view · F fit · S stock · R rapids · A arrows · N order · T texts · O other layers · M measure, Esc ends it · L language · D dark",
    "← → eine Bewegung · Bild↑ Bild↓ zehn · Pos1 Ende · Leertaste läuft · 2 3 Ansicht · F einpassen · S Rohteil · R Eilgänge · A Pfeile · N Reihenfolge · T Texte · O andere Layer · M messen, Esc beendet es · L Sprache · D dunkel",
  ],
  nowebgl: [
    "This browser has no WebGL2: the picture stands still.",
    "Dieser Browser hat kein WebGL2: Das Bild steht still.",
  ],
  library: ["Library", "Bibliothek"],
  search: ["Search  ( / )", "Suche  ( / )"],
  statistics: ["Statistics", "Statistik"],
  onePath: ["path", "Pfad"],
  paths: ["paths", "Pfade"],
  path: ["path", "Pfad"],
  drawing: ["drawing", "Zeichnung"],
  drawings: ["drawings", "Zeichnungen"],
  size: ["size", "Größe"],
  length: ["length", "Länge"],
  minutes: ["minutes", "Minuten"],
  min: ["min", "min"],
  state: ["state", "Zustand"],
  all: ["all", "alle"],
  stateErrors: ["errors", "Fehler"],
  stateStale: ["program not current", "Programm nicht aktuell"],
  stateCurrent: ["program current", "Programm aktuell"],
  stateOk: ["ok", "in Ordnung"],
  withWarnings: ["with warnings", "mit Warnungen"],
  oneError: ["error", "Fehler"],
  manyErrors: ["errors", "Fehler"],
  oneWarning: ["warning", "Warnung"],
  manyWarnings: ["warnings", "Warnungen"],
  unchecked: ["being checked", "wird geprüft"],
  wholeDrawing: ["(drawing)", "(Zeichnung)"],
  materialM: ["material M", "Material M"],
  cutterO: ["cutter O", "Fräser O"],
  noneOfIt: ["none", "keins"],
  nothing: ["Nothing is listed.", "Nichts ist aufgeführt."],
  nothingFound: ["Nothing like that is listed.", "Nichts dergleichen ist aufgeführt."],
  offline: [
    "No connection to pathbuild: it has ended, or is being started again.",
    "Keine Verbindung zu pathbuild: Es wurde beendet oder startet neu.",
  ],
  halted: [
    "Nothing is checked until this is put right:",
    "Nichts wird geprüft, bis das berichtigt ist:",
  ],
  unknown: [
    "This page needs the whole address that pathbuild printed, with what stands behind the #.",
    "Diese Seite braucht die ganze Adresse, die pathbuild ausgegeben hat, mit dem, was hinter dem # steht.",
  ],
  gone: ["is no longer there; this is what was drawn last.", "ist nicht mehr da; zu sehen ist der letzte Stand."],
  drop: [
    "Drop drawings or a folder here. Nothing leaves this machine: pathbuild runs in this page.",
    "Zeichnungen oder einen Ordner hier ablegen. Nichts verlässt diesen Rechner: pathbuild läuft in dieser Seite.",
  ],
  pickDrawings: ["Drawings…", "Zeichnungen…"],
  pickFolder: ["Folder…", "Ordner…"],
  post: ["post", "Postprozessor"],
  asConfigured: ["(pathbuild.toml)", "(pathbuild.toml)"],
  feedF: ["feed F", "Vorschub F"],
  sweepHeight: ["sweep height S", "Leerfahrthöhe S"],
  rapidSpeed: ["rapid", "Eilgang"],
  probeFeed: ["probe feed", "Vorschub Probe"],
  downloadAll: ["Download all", "Alle herunterladen"],
  download: ["Download program", "Programm herunterladen"],
  downloaded: ["downloaded:", "heruntergeladen:"],
  noProgram: ["There is no program to download.", "Es gibt kein Programm zum Herunterladen."],
  tooMuch: [
    "That is more than this page can hold. Drop the folder of your drawings only, or use pathbuild itself.",
    "Das ist mehr, als diese Seite fassen kann. Nur den Ordner der Zeichnungen ablegen oder pathbuild selbst verwenden.",
  ],
  files: ["files", "Dateien"],
  most: ["at most", "höchstens"],
  unreadable: ["cannot be read:", "ist nicht lesbar:"],
  broken: [
    "The compiler cannot open these files, or has run out of memory:",
    "Der Compiler kann diese Dateien nicht öffnen oder hat keinen Speicher mehr:",
  ],
  noWasm: [
    "This browser cannot run pathbuild; a current Firefox, Chrome, Edge or Safari can.",
    "Dieser Browser kann pathbuild nicht ausführen; aktuelle Firefox, Chrome, Edge und Safari können es.",
  ],
  preview: ["preview; emit writes no file of this", "Vorschau; emit schreibt davon keine Datei"],
  nativeText: ["native program; the machine gets", "eigenes Programm; die Maschine bekommt"],
  showNative: ["Show native", "Eigenes zeigen"],
  showWritten: ["Show file", "Datei zeigen"],
  examples: ["example values", "Beispielwerte"],
  notGiven: ["not given", "nicht angegeben"],
  start: ["start", "Start"],
  mill: ["milling", "Fräsen"],
  mark: ["marking", "Markieren"],
  support: ["with support bars", "mit Stützstegen"],
  sweep: ["rapid", "Eilgang"],
  lift: ["rapid up or down", "Eilgang auf oder ab"],
  plunge: ["plunge", "Eintauchen"],
  probe: ["Z-probe", "Z-Probe"],
  subpath: ["embedded path", "eingebetteter Pfad"],
  "skipped-subpath": ["skipped path", "übergangener Pfad"],
  end: ["end", "Ende"],
  turn: ["turn marker", "Wendemarke"],
} satisfies Record<string, [string, string]>;

export type Word = keyof typeof words;

export function say(word: Word, lang: Lang): string {
  return words[word][lang === "en" ? 0 : 1];
}

export function sayKind(kind: string, lang: Lang): string {
  return kind in words ? say(kind as Word, lang) : kind;
}

/** The name of an option that nothing gives. */
export function sayOption(name: string, lang: Lang): string {
  return name === "feed" ? say("feedF", lang) : name === "rapid" ? say("rapidSpeed", lang) : name;
}

export function mm(value: number): string {
  return String(Math.round(value * 1000) / 1000 + 0);
}
