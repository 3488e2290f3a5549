// Colours of the stock as seen from above, for the GPU's texture and for a 2D canvas alike.

import { Heights, NOTHING, Texels } from "./heights.js";
import { BESIDE, CORNER, FORBIDDEN, LOOSE } from "./parts.js";

/** Red, green and blue from 0 to 255. */
export type Color = [number, number, number];

/** The colours of the stock: uncut, cut a little, cut deep, cut through, and the colours of its errors. */
export type StockColors = Record<"uncut" | "shallow" | "deep" | "plate" | "wrong" | "leftover" | "loose", Color>;

const LIGHT = normal(-0.42, 0.55, 0.72);
/** Steps steeper than this, in texels, and higher than this, in mm, are walls: they get a dark edge and no slope. */
const [WALL_STEEP, WALL_HIGH] = [1.8, 0.02];
/** Distance in texels up to which neighbours affect a texel's colour. */
const REACH = 1;

function normal(x: number, y: number, z: number): Color {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** Returns the height beside a texel. Beyond the edge of the stock there is no wall to draw. */
function beside(neighbour: number, height: number): number {
  return neighbour === NOTHING ? height : neighbour;
}

/** Paints these texels and their neighbours. Returns the texels that were painted. */
export function shade(map: Heights, marked: Uint8Array, paint: StockColors, [x0, y0, x1, y1]: Texels, into: Uint8ClampedArray): Texels {
  const { heights, tops, through, rapid, columns, rows, texel, cutting } = map;
  const painted: Texels = [Math.max(0, x0 - REACH), Math.max(0, y0 - REACH), Math.min(columns, x1 + REACH), Math.min(rows, y1 + REACH)];
  const colors = new Uint32Array(into.buffer);
  const depth = Math.max(cutting.top - cutting.low, 1e-6);
  for (let row = painted[1]; row < painted[3]; row++) {
    const [down, up] = [row > 0 ? columns : 0, row < rows - 1 ? columns : 0];
    let wasLevel = false;
    for (let column = painted[0]; column < painted[2]; column++) {
      const at = row * columns + column;
      const height = heights[at];
      if (height === NOTHING) {
        colors[at] = 0;
        wasLevel = false;
        continue;
      }
      const l = beside(heights[column > 0 ? at - 1 : at], height);
      const r = beside(heights[column < columns - 1 ? at + 1 : at], height);
      const d = beside(heights[at - down], height);
      const u = beside(heights[at + up], height);
      const steep = Math.max(Math.abs(l - height), Math.abs(r - height), Math.abs(d - height), Math.abs(u - height));
      // Most of a stock is level: there, a texel has the colour of the one before it.
      const isLevel = steep === 0;
      const isAsBefore = isLevel && wasLevel && marked[at] === marked[at - 1] && rapid[at] === rapid[at - 1] && through[at] === through[at - 1] && tops[at] === tops[at - 1];
      wasLevel = isLevel;
      if (isAsBefore) {
        colors[at] = colors[at - 1];
        continue;
      }
      const isWall = steep > WALL_STEEP * texel && steep > WALL_HIGH;
      let light = LIGHT[2];
      if (!isWall && !isLevel) {
        const [nx, ny, nz] = [l - r, d - u, 2 * texel];
        light = Math.max(0, (nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]) / Math.sqrt(nx * nx + ny * ny + nz * nz));
      }
      light = light * 0.75 + 0.46;
      if (isWall && height - Math.min(l, r, d, u) > WALL_HIGH) light *= 0.45;
      const share = Math.min(Math.max((cutting.top - height) / depth, 0), 1);
      const isThrough = height <= through[at];
      const isUntouched = height >= tops[at] - 1e-4;
      const isWrong = rapid[at] > 0 || (isThrough && (marked[at] & FORBIDDEN) > 0);
      const isLeft = (marked[at] & BESIDE) > 0 || ((marked[at] & CORNER) > 0 && isUntouched);
      const overlay = isWrong ? paint.wrong : isThrough ? null : isLeft ? paint.leftover : marked[at] & LOOSE ? paint.loose : null;
      const strength = overlay === paint.loose ? 0.45 : 0.75;
      for (let part = 0; part < 3; part++) {
        const base = isThrough ? paint.plate[part] : isUntouched ? paint.uncut[part] : paint.shallow[part] + (paint.deep[part] - paint.shallow[part]) * share;
        const lit = base * light;
        into[at * 4 + part] = overlay ? lit * (1 - strength) + overlay[part] * strength : lit;
      }
      into[at * 4 + 3] = 255;
    }
  }
  return painted;
}
