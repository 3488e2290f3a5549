// The stock of a scene under the slider: heights after the current move, and their colours.

import { Scene } from "../scene.js";
import { Heights, Texels } from "./heights.js";
import { marks } from "./parts.js";
import { Assumed, cutting } from "./pieces.js";
import { StockColors, shade } from "./shading.js";

export class Stock {
  readonly colors: Uint8ClampedArray<ArrayBuffer>;

  private constructor(
    readonly map: Heights,
    private marked: Uint8Array,
    readonly paints: StockColors,
  ) {
    this.colors = new Uint8ClampedArray(map.columns * map.rows * 4);
    shade(map, marked, paints, map.whole(), this.colors);
  }

  /** Creates the uncut stock; `null` if no cutter is known or nothing is cut. */
  static of(scene: Scene, assumed: Assumed, paints: StockColors): Stock | null {
    const cuts = cutting(scene, assumed);
    if (!cuts) return null;
    const map = new Heights(cuts);
    return new Stock(map, marks(map, scene), paints);
  }

  /** Cuts the first `moves` moves, and a share of the next one. Returns the texels that were painted again. */
  seek(moves: number, share = 0): Texels | null {
    const changed = this.map.seek(moves, share);
    return changed && shade(this.map, this.marked, this.paints, changed, this.colors);
  }

  /** Paints the stock on a 2D canvas, for browsers without WebGL2. */
  paint(canvas: HTMLCanvasElement): void {
    const { columns, rows } = this.map;
    if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows });
    canvas.getContext("2d")?.putImageData(new ImageData(this.colors, columns, rows), 0, 0);
  }
}
