// What the page says, in both languages.

export type Lang = "en" | "de";

const words = {
  view2: ["Top", "Oben"],
  view3: ["3D", "3D"],
  fit: ["Fit", "Einpassen"],
  rapids: ["Rapids", "Eilgänge"],
  arrows: ["Arrows", "Pfeile"],
  order: ["Order", "Reihenfolge"],
  texts: ["Texts", "Texte"],
  other: ["Other layers", "Andere Layer"],
  measure: ["Measure", "Messen"],
  theme: ["Light/dark", "Hell/dunkel"],
  play: ["Run", "Ablauf"],
  step: ["Move", "Bewegung"],
  of: ["of", "von"],
  tool: ["cutter O", "Fräser O"],
  thickness: ["thickness T", "Dicke T"],
  material: ["material M", "Material M"],
  milling: ["milling", "Fräsen"],
  drilling: ["drilling", "Bohren"],
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
  fromDefault: ["default", "Vorgabe"],
  feed: ["feed", "Vorschub"],
  pick: ["Click two points to measure.", "Zum Messen zwei Punkte anklicken."],
  keys: [
    "← → one move · PgUp PgDn ten · Home End · space runs · 2 3 view · F fit · R rapids · A arrows · N order · T texts · O other layers · M measure · L language · D dark",
    "← → eine Bewegung · Bild↑ Bild↓ zehn · Pos1 Ende · Leertaste läuft · 2 3 Ansicht · F einpassen · R Eilgänge · A Pfeile · N Reihenfolge · T Texte · O andere Layer · M messen · L Sprache · D dunkel",
  ],
  nowebgl: [
    "This browser has no WebGL2: the picture stands still.",
    "Dieser Browser hat kein WebGL2: Das Bild steht still.",
  ],
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

export function mm(value: number): string {
  return String(Math.round(value * 1000) / 1000 + 0);
}
