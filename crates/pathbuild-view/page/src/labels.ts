// Labels in the picture. They overlap neither each other nor the legend, and are not cut off at the edge.

import { Point } from "./scene.js";

/** A label, and the point to which it belongs. */
export interface Spot {
  at: [number, number, number];
  node: HTMLElement;
}

/** Left, top, right and bottom side of a rectangle, in px. */
type Box = [number, number, number, number];

/** Classes of labels in order of priority. Labels of the first `ALWAYS` classes are shown even if there is no space. */
const RANKS = ["finding", "cross", "zero", "probe", "clamp", "text", "order", "name"];
const ALWAYS = 5;

/** Side length in px of the cells in which neighbours are searched. */
const CELL = 64;

interface Label extends Spot {
  rank: number;
  /** The space that the label takes, relative to its anchor. */
  box: Box;
}

export class Labels {
  private labels: Label[] = [];
  private isMeasured = false;

  /** `legend` is the element that covers a part of the picture, so labels avoid it. */
  constructor(
    private host: HTMLElement,
    private legend: HTMLElement,
  ) {}

  set(spots: Spot[]): void {
    const rank = ({ node }: Spot) => RANKS.findIndex((name) => node.classList.contains(name));
    this.labels = spots.map((spot): Label => ({ ...spot, rank: rank(spot), box: [0, 0, 0, 0] })).sort((a, b) => a.rank - b.rank);
    this.isMeasured = false;
    this.host.replaceChildren(...spots.map(({ node }) => node));
  }

  place(project: (at: [number, number, number]) => Point, width: number, height: number): void {
    if (!this.isMeasured) this.measure();
    const taken = new Map<number, Box[]>();
    const take = (place: Box) => cells(place).forEach((cell) => taken.set(cell, [...(taken.get(cell) ?? []), place]));
    if (!this.legend.hidden) take(this.boxOf(this.legend));
    for (const { at, node, rank, box } of this.labels) {
      const [x, y] = project(at);
      const isSeen = x >= 0 && x <= width && y >= 0 && y <= height;
      const places = isSeen ? ways(box).map(([dx, dy]) => inside([box[0] + x + dx, box[1] + y + dy, box[2] + x + dx, box[3] + y + dy], width, height)) : [];
      const free = places.find((place) => cells(place).every((cell) => !taken.get(cell)?.some((other) => meets(place, other))));
      const place = free ?? (rank < ALWAYS ? places[0] : undefined);
      node.style.visibility = place ? "" : "hidden";
      const [left, top] = place ? [place[0] - box[0], place[1] - box[1]] : [x, y];
      node.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
      if (place) take(place);
    }
  }

  private measure(): void {
    for (const label of this.labels) label.box = this.boxOf(label.node);
    this.isMeasured = this.host.clientWidth > 0;
  }

  private boxOf(node: HTMLElement): Box {
    const [host, own] = [this.host.getBoundingClientRect(), node.getBoundingClientRect()];
    return [own.left - host.left, own.top - host.top, own.right - host.left, own.bottom - host.top];
  }
}

/** Returns the offsets from its anchor to try for a label, the nearest first. */
function ways([left, top, right, bottom]: Box): Point[] {
  const [across, down] = [(right - left) / 2 + 4, bottom - top + 1];
  return [[0, 0], [0, down], [0, -down], [across, 0], [-across, 0], [across, down], [across, -down], [-across, down], [-across, -down], [0, 2 * down], [0, -2 * down]];
}

/** Returns the box, moved into the picture. */
function inside([left, top, right, bottom]: Box, width: number, height: number): Box {
  const dx = Math.max(0, -left) - Math.max(0, right - width);
  const dy = Math.max(0, -top) - Math.max(0, bottom - height);
  return [left + dx, top + dy, right + dx, bottom + dy];
}

function meets(a: Box, b: Box): boolean {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

/** Returns the numbers of the cells that a box overlaps. */
function cells([left, top, right, bottom]: Box): number[] {
  const all: number[] = [];
  for (let row = Math.floor(top / CELL); row * CELL < bottom; row++) {
    for (let column = Math.floor(left / CELL); column * CELL < right; column++) all.push(row * 4096 + column);
  }
  return all;
}
