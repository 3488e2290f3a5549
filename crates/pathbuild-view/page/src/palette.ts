// The colours of the picture, defined in style.css, where a test measures their contrast.

import type { StockColors } from "./stock/shading.js";

/** Red, green and blue from 0 to 1. */
export type Color = [number, number, number];

/** Returns the value of a CSS variable of the form `#rrggbb`. */
export function color(name: string): Color {
  const value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return [1, 3, 5].map((at) => parseInt(value.slice(at, at + 2), 16) / 255) as Color;
}

/** Returns the value of a CSS variable of the form `#rrggbb` as a number. */
export function hex(name: string): number {
  return color(name).reduce((sum, part) => sum * 256 + Math.round(part * 255), 0);
}

export function stockColors(): StockColors {
  const names = ["uncut", "shallow", "deep", "plate", "wrong", "leftover", "loose"] as const;
  return Object.fromEntries(names.map((name) => [name, color(name).map((part) => Math.round(part * 255))])) as StockColors;
}

/** Returns the colours of depths, from the upper face to the deepest cut. */
export function depths(): Color[] {
  return [1, 2, 3, 4, 5].map((stop) => color(`depth${stop}`));
}

/** Returns the colour of a share (0 to 1) of the depth. */
export function depthColor(stops: Color[], share: number): Color {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const stop = Math.min(Math.floor(place), stops.length - 2);
  return [0, 1, 2].map((part) => stops[stop][part] + (stops[stop + 1][part] - stops[stop][part]) * (place - stop)) as Color;
}
