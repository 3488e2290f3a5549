// Elements of the page.

import { visible } from "./visible.js";

/** The element of that id, which the page has. */
export const $ = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** A new element with a text, which may come from strangers. */
export function node(tag: string, content: string, className = ""): HTMLElement {
  const made = document.createElement(tag);
  made.textContent = visible(content);
  made.className = className;
  return made;
}

/** A row of a table, of cells of one kind. */
export function tableRow(tag: "td" | "th", cells: string[]): HTMLElement {
  const row = document.createElement("tr");
  row.append(...cells.map((cell) => node(tag, cell)));
  return row;
}
