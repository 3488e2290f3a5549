// Rows of a library. Only the visible ones are rendered.

import { node } from "./dom.js";
import { LibraryRow } from "./source.js";
import { lang } from "./viewer.js";
import { Word, say } from "./words.js";

/** Heights of a row in px, on wide and narrow pages. */
const [WIDE, NARROW] = [26, 44];

/** Width in px below which a row has two lines. */
const LEAST = 900;

const STATES = { errors: "manyErrors", stale: "stateStale", unknown: "stateUnknown", current: "stateCurrent", ok: "stateOk" } as const satisfies Record<string, Word>;

export class List {
  private rows: LibraryRow[] = [];
  /** Index of the selected row; -1 if no row is selected. */
  private at = -1;
  private isCompact = false;
  /** Elements of the rendered rows. */
  private elements = new Map<string, HTMLElement>();

  constructor(
    private host: HTMLElement,
    private items: HTMLElement,
    private open: (row: LibraryRow) => void,
  ) {
    host.addEventListener("scroll", () => this.draw());
    host.addEventListener("click", (event) => {
      const item = (event.target as HTMLElement).closest<HTMLElement>(".item");
      if (item) this.choose(Number(item.dataset.index), true);
    });
    host.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.fold()).observe(host);
  }

  /** Sets the rows; `null` keeps them. Selects the row of the open path or, if a whole drawing is open, the drawing's first row. */
  set(rows: LibraryRow[] | null, open: { file: string; path: string | null } | null): void {
    const chosen = open ?? this.rows[this.at];
    this.rows = rows ?? this.rows;
    const before = this.at;
    this.at = chosen ? this.rows.findIndex((row) => row.file === chosen.file && (row.path === chosen.path || chosen.path === null)) : -1;
    this.draw();
    if (before !== this.at) this.reveal();
  }

  /** Moves the focus to the list, and selects its first row unless another one is selected. */
  enter(): void {
    this.host.focus();
    if (this.at < 0) this.choose(0, false);
  }

  openFirst(): void {
    if (this.rows.length > 0) this.choose(0, true);
  }

  draw(): void {
    const height = this.height();
    this.items.style.height = `${this.rows.length * height}px`;
    const first = Math.max(0, Math.floor(this.host.scrollTop / height) - 4);
    const last = Math.min(this.rows.length, first + Math.ceil(this.host.clientHeight / height) + 9);
    const shown = this.rows.slice(first, last);
    // A press on a row that is replaced before the release opens nothing, so rows that remain keep their elements.
    const elements = new Map(shown.map((row) => [key(row), this.elements.get(key(row)) ?? document.createElement("div")]));
    for (const [row, element] of this.elements) if (!elements.has(row)) element.remove();
    this.elements = elements;
    let next = this.items.firstElementChild;
    shown.forEach((row, offset) => {
      const item = elements.get(key(row))!;
      this.fill(item, first + offset);
      if (item === next) next = item.nextElementSibling;
      else this.items.insertBefore(item, next);
    });
    if (this.at >= 0) this.host.setAttribute("aria-activedescendant", `item-${this.at}`);
    else this.host.removeAttribute("aria-activedescendant");
  }

  private fill(item: HTMLElement, index: number): void {
    item.replaceChildren(...(this.isCompact ? compact(this.rows[index]) : wide(this.rows[index])));
    item.className = "item";
    item.id = `item-${index}`;
    item.setAttribute("role", "option");
    item.setAttribute("aria-posinset", String(index + 1));
    item.setAttribute("aria-setsize", String(this.rows.length));
    item.setAttribute("aria-selected", String(index === this.at));
    item.dataset.index = String(index);
    item.style.top = `${index * this.height()}px`;
  }

  private height(): number {
    return this.isCompact ? NARROW : WIDE;
  }

  private fold(): void {
    const isCompact = this.host.clientWidth < LEAST;
    if (this.host.clientWidth > 0 && isCompact !== this.isCompact) {
      const first = this.host.scrollTop / this.height();
      this.isCompact = isCompact;
      this.host.parentElement!.classList.toggle("compact", isCompact);
      this.draw();
      this.host.scrollTop = first * this.height();
      this.reveal();
    }
    this.draw();
  }

  private choose(at: number, opens: boolean): void {
    this.at = Math.min(Math.max(at, 0), this.rows.length - 1);
    this.reveal();
    this.draw();
    if (opens && this.rows[this.at]) this.open(this.rows[this.at]);
  }

  /** Scrolls to the selected row. */
  private reveal(): void {
    if (this.at < 0) return;
    const height = this.height();
    const [top, bottom] = [this.at * height, (this.at + 1) * height];
    if (top < this.host.scrollTop) this.host.scrollTop = top;
    else if (bottom > this.host.scrollTop + this.host.clientHeight) this.host.scrollTop = bottom - this.host.clientHeight;
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const page = Math.max(1, Math.floor(this.host.clientHeight / this.height()) - 1);
    const ways: Record<string, number> = {
      ArrowDown: this.at + 1,
      ArrowUp: this.at - 1,
      PageDown: this.at + page,
      PageUp: this.at - page,
      Home: 0,
      End: this.rows.length - 1,
    };
    if (event.key === "Enter" && this.at >= 0) this.choose(this.at, true);
    else if (event.key in ways) this.choose(ways[event.key], false);
    else return;
    event.preventDefault();
  }
}

function part(content: string, className = ""): HTMLElement {
  return node("span", content, className);
}

function number(value: number | null | undefined, digits: number): string {
  if (value === null || value === undefined) return "-";
  return formats(digits).format(value);
}

const made = new Map<string, Intl.NumberFormat>();

function formats(digits: number): Intl.NumberFormat {
  const key = `${lang} ${digits}`;
  const known = made.get(key) ?? new Intl.NumberFormat(lang, { maximumFractionDigits: digits, useGrouping: false });
  made.set(key, known);
  return known;
}

function size(row: LibraryRow): string {
  return row.size ? `${number(row.size[0], 1)} x ${number(row.size[1], 1)}` : "-";
}

function key(row: LibraryRow): string {
  return JSON.stringify([row.file, row.path]);
}

function name(row: LibraryRow): string {
  return row.path ?? say("wholeDrawing", lang);
}

/** Creates the cell for the state of a path, in the words of `list`. */
function state(row: LibraryRow): HTMLElement {
  if (!row.state) return part(say("unchecked", lang), "state");
  const counted = (count: number, one: Word, many: Word) => `${count} ${say(count === 1 ? one : many, lang)}`;
  const own = row.state === "errors" ? counted(row.errors ?? 0, "oneError", "manyErrors") : say(STATES[row.state], lang);
  const warnings = row.warnings ? `, ${counted(row.warnings, "oneWarning", "manyWarnings")}` : "";
  return part(own + warnings, `state ${row.state}`);
}

function wide(row: LibraryRow): HTMLElement[] {
  const figures = [number(row.thickness, 3), number(row.tool, 3), size(row), number(row.length, 0), number(row.minutes, 0)];
  return [part(name(row), "name"), part(row.file, "file"), part(row.material ?? "-"), ...figures.map((figure) => part(figure)), state(row)];
}

function compact(row: LibraryRow): HTMLElement[] {
  const top = document.createElement("div");
  top.className = "top";
  top.append(part(name(row), "name"), state(row));
  const known = [row.file, row.material, row.size && size(row), row.minutes === null || row.minutes === undefined ? null : `${number(row.minutes, 0)} min`];
  return [top, part(known.filter((it) => it).join(" · "), "file")];
}
