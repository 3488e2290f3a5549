// The texts of the page in both languages.

export type Lang = "en" | "de";

const words = {
  program: ["program", "Programm"],
  picture: ["Picture", "Bild"],
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
  thickness: ["thickness T", "Dicke T"],
  drilling: ["plunging", "Eintauchen"],
  time: ["time", "Zeit"],
  withoutRapids: ["without rapid moves", "ohne Eilgänge"],
  findings: ["Findings", "Befunde"],
  finding: ["finding", "Befund"],
  element: ["Element", "Element"],
  layer: ["layer", "Layer"],
  line: ["line in the file", "Zeile in der Datei"],
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
  keys: ["Keys", "Tasten"],
  close: ["Close", "Schließen"],
  keyMove: ["one move back or forward", "eine Bewegung zurück oder vor"],
  keyTen: ["ten moves back or forward", "zehn Bewegungen zurück oder vor"],
  keyEnds: ["first or last move", "erste oder letzte Bewegung"],
  keyRun: ["run or stop", "ablaufen lassen oder anhalten"],
  keySpeed: ["run faster or slower", "schneller oder langsamer"],
  keyOperation: ["previous or next operation", "voriger oder nächster Arbeitsgang"],
  keyView: ["from above or in 3D", "von oben oder in 3D"],
  keyFit: ["show everything", "alles zeigen"],
  keyMeasure: ["measure; Esc ends it", "messen; Esc beendet es"],
  keyLanguage: ["English or German", "Deutsch oder Englisch"],
  keyHelp: ["this list", "diese Liste"],
  speed: ["Speed of the run", "Geschwindigkeit des Ablaufs"],
  realSpeed: ["real speed", "Echtzeit"],
  elapsed: ["elapsed", "vergangen"],
  remaining: ["remaining", "verbleibend"],
  rapidAssumed: ["rapid mm/min", "Eilgang mm/min"],
  legend: ["Legend", "Legende"],
  legendAhead: ["cuts ahead", "noch zu fräsen"],
  legendUncut: ["uncut stock", "ungefrästes Rohteil"],
  legendSquares: ["in squares of", "in Quadraten von"],
  legendUnknownTip: ["cutter of unknown shape: flat bottom drawn", "Fräser unbekannter Form: mit flachem Grund"],
  legendThrough: ["cut through", "durchgefräst"],
  legendRapid: ["rapid in material", "Eilgang im Material"],
  legendGouge: ["cut into a part or bar", "Schnitt in Teil oder Steg"],
  legendOutline: ["outline of a part", "Umriss eines Teils"],
  legendUncutOutline: ["outline that is not cut", "nicht gefräster Umriss"],
  legendCorner: ["corner out of the cutter's reach", "Ecke, die der Fräser nicht erreicht"],
  legendLeft: ["material left", "stehen gebliebenes Material"],
  legendLoose: ["loose part", "loses Teil"],
  legendClamp: ["clamp", "Spannmittel"],
  dialect: ["dialect", "Dialekt"],
  surface: ["surface Z", "Oberfläche Z"],
  asFound: ["as in the program", "wie im Programm"],
  settingsLink: ["Link with these settings", "Link mit diesen Werten"],
  settingsFor: [
    "This address holds settings, but no program. Drop the program that they belong to here.",
    "Diese Adresse enthält Werte, aber kein Programm. Das zugehörige Programm hier ablegen.",
  ],
  checks: ["Checked", "Geprüft"],
  lineShort: ["line", "Zeile"],
  readAs: ["read as", "gelesen als"],
  extent: ["extent", "Ausdehnung"],
  extentOfCuts: ["of which cuts", "davon Schnitte"],
  waits: ["waits (not in the time)", "Halte (nicht in der Zeit)"],
  tools: ["tools", "Werkzeuge"],
  pickProgram: ["Open a program…", "Programm öffnen…"],
  pickExample: ["Example with a mistake", "Beispiel mit einem Fehler"],
  book: ["The book", "Das Buch"],
  operations: ["Operations", "Arbeitsgänge"],
  number: ["No.", "Nr."],
  what: ["what", "was"],
  depth: ["depth", "Tiefe"],
  nowebgl: [
    "This browser has no WebGL2: the picture can neither be zoomed nor turned.",
    "Dieser Browser hat kein WebGL2: Das Bild lässt sich weder vergrößern noch drehen.",
  ],
  library: ["Library", "Bibliothek"],
  search: ["Search  ( / )", "Suche  ( / )"],
  statistics: ["Statistics", "Statistik"],
  paths: ["paths", "Pfade"],
  ofPaths: ["paths", "Pfaden"],
  path: ["path", "Pfad"],
  drawing: ["drawing", "Zeichnung"],
  drawings: ["drawings", "Zeichnungen"],
  size: ["size", "Größe"],
  length: ["length", "Länge"],
  minutes: ["minutes", "Minuten"],
  min: ["min", "min"],
  state: ["state", "Zustand"],
  all: ["all", "alle"],
  stateStale: ["program not current", "Programm nicht aktuell"],
  stateUnknown: ["program not compared", "Programm nicht verglichen"],
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
  nothing: ["The list is empty.", "Die Liste ist leer."],
  nothingFound: ["No entry matches.", "Kein Eintrag passt."],
  offline: [
    "No connection to pathbuild: it has stopped or is restarting.",
    "Keine Verbindung zu pathbuild: Es wurde beendet oder startet neu.",
  ],
  halted: [
    "Nothing is checked until this is fixed:",
    "Nichts wird geprüft, bis das behoben ist:",
  ],
  unknown: [
    "This page needs the complete address that pathbuild printed, including the part after the #.",
    "Diese Seite braucht die vollständige Adresse, die pathbuild ausgegeben hat, mit dem Teil hinter dem #.",
  ],
  missing: ["is not there, or cannot be read.", "ist nicht da oder nicht lesbar."],
  gone: ["is no longer there, or cannot be read; this is its last state.", "ist nicht mehr da oder nicht lesbar; zu sehen ist der letzte Stand."],
  inDrawing: ["drawing:", "Zeichnung:"],
  drop: [
    "Drop drawings, a folder or any G-code program here. Nothing leaves this machine: pathbuild runs in this page.",
    "Zeichnungen, einen Ordner oder ein beliebiges G-Code-Programm hier ablegen. Nichts verlässt diesen Rechner: pathbuild läuft in dieser Seite.",
  ],
  pickDrawings: ["Files…", "Dateien…"],
  pickFolder: ["Folder…", "Ordner…"],
  post: ["post", "Postprozessor"],
  asConfigured: ["(pathbuild.toml)", "(pathbuild.toml)"],
  feedF: ["feed F", "Vorschub F"],
  sweepHeight: ["sweep height S", "Leerfahrthöhe S"],
  probeFeed: ["probe feed", "Vorschub beim Antasten"],
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
    "Dieser Browser kann pathbuild nicht ausführen; aktuelle Versionen von Firefox, Chrome, Edge und Safari können es.",
  ],
  preview: ["preview; emit does not write this file", "Vorschau; emit schreibt diese Datei nicht"],
  nativeText: ["native program; the machine gets", "natives Programm; die Maschine bekommt"],
  showNative: ["Show native", "Natives zeigen"],
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
  unclear: ["line type without a meaning", "Linientyp ohne Bedeutung"],
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

/** Returns the name, as shown to users, of an option or parameter that has no value. */
export function sayOption(name: string, lang: Lang): string {
  return name === "feed" ? say("feedF", lang) : name === "rapid" ? say("sweep", lang) : name;
}

/** Formats a length in whole mm. As in the statistics of programs, a half is rounded to the even number. */
export function wholeMm(value: number): string {
  const down = Math.floor(value);
  return String(value - down === 0.5 && down % 2 === 0 ? down : Math.round(value));
}

export function mm(value: number): string {
  return String(Math.round(value * 1000) / 1000 + 0);
}

/** Formats a coordinate with two decimals; never as -0.00. */
export function hundredths(value: number): string {
  return value.toFixed(2).replace(/^-0\.00$/, "0.00");
}
