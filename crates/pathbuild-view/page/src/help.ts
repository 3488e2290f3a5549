// The list of keys, opened with "?".

import { $, node } from "./dom.js";
import { Lang, Word, say } from "./words.js";

/** Keys and their effects, in English and German. */
const KEYS: [string, string, Word][] = [
  ["← →", "← →", "keyMove"],
  ["PgUp PgDn", "Bild↑ Bild↓", "keyTen"],
  ["Home End", "Pos1 Ende", "keyEnds"],
  ["Space", "Leertaste", "keyRun"],
  ["+ −", "+ −", "keySpeed"],
  ["< >", "< >", "keyOperation"],
  ["2 3", "2 3", "keyView"],
  ["F", "F", "keyFit"],
  ["S", "S", "stock"],
  ["R", "R", "rapids"],
  ["A", "A", "arrows"],
  ["N", "N", "order"],
  ["T", "T", "texts"],
  ["O", "O", "other"],
  ["G", "G", "legend"],
  ["M", "M", "keyMeasure"],
  ["L", "L", "keyLanguage"],
  ["D", "D", "theme"],
  ["?", "?", "keyHelp"],
];

const dialog = $<HTMLDialogElement>("help");

export function sayKeys(lang: Lang): void {
  const rows = KEYS.map(([english, german, word]) => {
    const row = document.createElement("tr");
    row.append(node("th", lang === "de" ? german : english), node("td", say(word, lang)));
    return row;
  });
  $("key-list").replaceChildren(...rows);
}

export function toggleHelp(): void {
  if (dialog.open) dialog.close();
  else dialog.showModal();
}
