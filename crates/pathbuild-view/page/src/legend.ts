// The legend of the picture: a scale of lengths, one of depths, and the meaning of the colours.

import { $ } from "./dom.js";
import { Model } from "./model.js";
import { FinishedPart } from "./scene.js";
import { Lang, Word, mm, say } from "./words.js";

/** Maximum length of the scale in px. */
const LONGEST = 130;

const host = $("legend");
const scale = $("scale");
const depths = $("depths");
const items = $("meanings");

/** Side in mm of the squares of the stock from which the legend states it: grooves then have visible steps, and each square has one height. */
const COARSE = 0.1;

/** The kinds of things that the picture shows in addition to cuts. */
export interface Shown {
  rapids: boolean;
  stock: boolean;
  /** Side in mm of the squares in which the stock is known. */
  texel: number;
  /** Whether the stock shows rapid moves through material. */
  rapidCuts: boolean;
  /** Whether the stock shows cuts of a cutter whose shape is unknown with a flat bottom. */
  hasUnknownTip: boolean;
  clamps: boolean;
  /** Whether there are outlines of parts that no path cuts. */
  hasUncutOutlines: boolean;
  /** Whether there are corners of parts that the cutter does not reach. */
  hasCorners: boolean;
  parts: FinishedPart[];
}

export function sayLegend(model: Model, shown: Shown, lang: Lang): void {
  const hasCuts = Number.isFinite(model.deepest);
  depths.hidden = !hasCuts;
  $("shallowest").textContent = hasCuts ? `Z${mm(model.shallowest)}` : "";
  $("deepest").textContent = hasCuts ? `Z${mm(model.deepest)}` : "";
  depths.classList.toggle("single", model.shallowest === model.deepest);
  const all: [boolean | undefined, string | null, Word][] = [
    [hasCuts, "ahead", "legendAhead"],
    [shown.rapids, "rapid", "rapids"],
    [shown.stock, "uncut", "legendUncut"],
    [shown.stock, "plate", "legendThrough"],
    [shown.stock && shown.hasUnknownTip, null, "legendUnknownTip"],
    [shown.stock && shown.rapidCuts, "wrong", "legendRapid"],
    [shown.stock && shown.parts.some(({ gouges, lost_bars }) => gouges?.length || lost_bars?.length), "wrong", "legendGouge"],
    [shown.parts.length > 0, "outline", "legendOutline"],
    [shown.stock && shown.parts.some(({ left }) => left.length > 0), "leftover", "legendLeft"],
    [shown.stock && shown.hasCorners, "leftover", "legendCorner"],
    [shown.stock && shown.hasUncutOutlines, "leftover", "legendUncutOutline"],
    [shown.stock && shown.parts.some((part) => part.is_loose), "loose", "legendLoose"],
    [shown.clamps, "clamp", "legendClamp"],
  ];
  items.replaceChildren(
    ...all.filter(([isShown]) => isShown).map(([, name, word]) => {
      const item = document.createElement("li");
      const isCoarse = word === "legendUncut" && shown.texel >= COARSE;
      if (name) {
        const patch = document.createElement("i");
        patch.style.background = `var(--${name})`;
        item.append(patch);
      }
      item.append(say(word, lang) + (isCoarse ? `, ${say("legendSquares", lang)} ${mm(Number(shown.texel.toFixed(2)))} mm` : ""));
      return item;
    }),
  );
}

/** Sets the scale in px per mm; `null` if lengths are foreshortened. */
export function sayScale(perMm: number | null): void {
  scale.hidden = perMm === null;
  if (perMm === null) return;
  const power = 10 ** Math.floor(Math.log10(LONGEST / perMm));
  const length = [5, 2, 1].map((step) => step * power).find((length) => length * perMm <= LONGEST) ?? power;
  scale.style.width = `${length * perMm}px`;
  scale.textContent = `${mm(length)} mm`;
}

export function showLegend(isShown: boolean): void {
  host.hidden = !isShown;
}
