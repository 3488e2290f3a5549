// Access to elements of the page.

import { visible } from "./visible.js";

/** Returns the element with this id, which must exist. */
export const $ = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Creates an element with a text, which may be untrusted. */
export function node(tag: string, content: string, className = ""): HTMLElement {
  const made = document.createElement(tag);
  made.textContent = visible(content);
  made.className = className;
  return made;
}

export function tableRow(tag: "td" | "th", cells: string[]): HTMLElement {
  const row = document.createElement("tr");
  row.append(...cells.map((cell) => node(tag, cell)));
  return row;
}
