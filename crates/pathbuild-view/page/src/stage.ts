// The picture: one WebGL2 renderer with an orthographic camera, also for the view from above. Buffers are uploaded once; a step changes only
// how many of their pieces are drawn, and if there are very many, draws only the new ones (kept.ts).

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

import { Kept } from "./kept.js";
import { Labels, Spot } from "./labels.js";
import { Model, Pieces } from "./model.js";
import { color, hex } from "./palette.js";
import { KeepOut, Path, Point, Scene, Shape, isCut, isRapid, pointsOfShape } from "./scene.js";
import { Texels } from "./stock/heights.js";
import { StockPicture } from "./stock/picture.js";
import { Stock } from "./stock/stock.js";
import { wayUpTo } from "./timeline.js";

/** Lines of the picture. Only the first ones are drawn, up to a given number. */
interface Strokes {
  object: THREE.Object3D;
  draw(count: number): void;
  /** Draws everything that must be ready before the next picture. */
  prepare?(renderer: THREE.WebGLRenderer, camera: THREE.Camera): void;
  dispose?(): void;
}

/** Number of pieces above which lines are thin: thick ones are too slow without a graphics card. */
const MOST_THICK = 20_000;

export function isThick(model: Model): boolean {
  return model.cuts.step.length + model.rapids.step.length <= MOST_THICK;
}

/** Position of the camera. */
export interface View {
  position: THREE.Vector3;
  target: THREE.Vector3;
  zoom: number;
  isFitted: boolean;
}

/** Width of cuts in px. */
const CUT_WIDTH = 2.2;

/** Largest angle in radians between the line of sight and the vertical. */
const MOST_TILT = 1.5;

/** Search radius in px for clicks and hovers. */
const REACH = 9;

export class Stage {
  private renderer: THREE.WebGLRenderer;
  private scene = new THREE.Scene();
  private model!: Model;
  private camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
  private controls: OrbitControls;
  private materials: LineMaterial[] = [];
  private holes!: Strokes;
  private ahead!: Strokes;
  private cuts!: Strokes;
  private rapids!: Strokes;
  private arrows!: Strokes;
  private rapidArrows!: Strokes;
  private all: Strokes[] = [];
  private other!: THREE.LineSegments;
  private tool!: THREE.Mesh;
  private mark!: LineSegments2;
  /** The completed part of the current move. */
  private progress!: LineSegments2;
  private bars!: LineSegments2;
  private stock: StockPicture | null = null;
  private labels: Labels;
  /** Whether the view is that of `fit`: then it is fitted again when the picture changes its size. */
  private isFitted = false;
  /** Camera and picture size for which the labels were placed; `null` if none were placed. */
  private labelled: [THREE.Matrix4, number, number] | null = null;
  private isDue = false;
  /** Width and height of the picture in px. */
  private size: Point = [0, 0];
  private layer = 0;
  private unit = 1;
  private watcher: ResizeObserver;

  constructor(
    private host: HTMLElement,
    labels: HTMLElement,
    private legend: HTMLElement,
    readonly isThick: boolean,
    /** Called with the scale in px per mm of the plane; `null` if it depends on the direction. */
    private hearScale: (perMm: number | null) => void,
    /** Called when the browser has restored a picture that it had lost: everything must be loaded again. */
    hearRestored: () => void,
  ) {
    this.labels = new Labels(labels, legend);
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("webgl2", { antialias: isThick, alpha: false });
    if (!context) throw new Error("no WebGL2");
    this.renderer = new THREE.WebGLRenderer({ canvas, context, antialias: isThick });
    canvas.addEventListener("webglcontextrestored", hearRestored);
    host.append(canvas);
    THREE.ColorManagement.enabled = false;
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    // Set before the controls are created, because they orbit around the up axis that the camera has at that time.
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => {
      this.isFitted = false;
      this.draw();
    });
    this.controls.zoomToCursor = true;
    // The stock is a map of heights, which has no underside.
    this.controls.maxPolarAngle = MOST_TILT;
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(host);
  }

  load(model: Model, scene: Scene): void {
    this.empty();
    this.model = model;
    this.renderer.setClearColor(hex("paper"));
    const { low, high } = model;
    this.unit = Math.max(high[0] - low[0], high[1] - low[1], 1);
    this.other = this.thin(otherShapes(scene), hex("faint"));
    this.scene.add(this.thin(elementShapes(scene), hex("element")));
    for (const height of [false, true]) this.scene.add(this.thin(keepOuts(scene, height), hex("clamp")));
    for (const it of scene.keep_outs) this.scene.add(clamp(it));
    this.scene.add(this.fat(outlines(scene), 1.6));
    this.bars = this.fat(bars(scene), 6);
    this.scene.add(this.bars);
    this.ahead = this.strokesAhead(model.cuts);
    this.holes = this.discs(model.holes);
    this.rapids = this.strokes(model.rapids, 1.1);
    this.rapidArrows = this.strokes(model.rapidArrows, 1.2);
    const { renderOrder } = this.ahead.object;
    this.cuts = model.cuts.step.length > MOST_THICK ? this.kept(new Kept(model.cuts, hex("ahead")), renderOrder) : this.strokes(model.cuts, CUT_WIDTH);
    this.arrows = this.strokes(model.arrows, 1.4);
    this.progress = this.fat(colored([0, 0, 0, 0, 0, 0], "error"), CUT_WIDTH);
    this.mark = this.fat(colored([0, 0, 0, 0, 0, 0], "error"), 5);
    this.mark.visible = this.progress.visible = false;
    const diameter = scene.paths.find((path) => path.tool)?.tool ?? this.unit / 60;
    const height = Math.max(diameter * 3, this.unit / 20);
    const body = new THREE.CylinderGeometry(diameter / 2, diameter / 2, height, 24).rotateX(Math.PI / 2).translate(0, 0, height / 2);
    this.tool = new THREE.Mesh(body, new THREE.MeshBasicMaterial({ color: hex("error"), transparent: true, opacity: 0.5, depthTest: false }));
    this.scene.add(this.other, this.progress, this.mark, this.tool);
    this.all = [this.ahead, this.holes, this.cuts, this.rapids, this.arrows, this.rapidArrows];
    for (const { object } of this.all) this.scene.add(object);
    this.resize();
  }

  dispose(): void {
    this.empty();
    this.watcher.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
  }

  /** Shows or hides the stock under the moves. */
  showStock(stock: Stock | null): void {
    if (this.stock) this.scene.remove(this.stock.object);
    this.stock?.dispose();
    this.stock = stock && new StockPicture(stock);
    if (this.stock) this.scene.add(this.stock.object);
    // The stock shows bars and grooves at their true width, so lines of the usual width would cover them.
    this.bars.visible = this.holes.object.visible = !stock;
    if (this.cuts.object instanceof LineSegments2) this.cuts.object.material.linewidth = stock ? 0.8 : CUT_WIDTH;
    else this.cuts.object.visible = !stock;
    this.draw();
  }

  /** Updates texels of the stock that were cut. */
  cut(texels: Texels): void {
    this.stock?.change(texels);
    this.draw();
  }

  private empty(): void {
    this.stock?.dispose();
    this.stock = null;
    this.scene.traverse((object) => {
      if (!(object instanceof THREE.Mesh || object instanceof THREE.LineSegments)) return;
      object.geometry.dispose();
      object.material.dispose();
    });
    this.scene.clear();
    this.all.forEach((strokes) => strokes.dispose?.());
    this.all = [];
    this.materials = [];
    this.layer = 0;
  }

  view(): View {
    const { position, zoom } = this.camera;
    return { position: position.clone(), target: this.controls.target.clone(), zoom, isFitted: this.isFitted };
  }

  restore({ position, target, zoom, isFitted }: View): void {
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.camera.zoom = zoom;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.isFitted = isFitted;
    this.draw();
  }

  /** Centres a place of the drawing and zooms in. */
  look([x, y]: Point): void {
    const away = this.camera.position.clone().sub(this.controls.target);
    this.controls.target.set(x, y, 0);
    this.camera.position.copy(this.controls.target).add(away);
    this.camera.zoom = Math.max(this.camera.zoom, 2.5 * this.whole());
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** Fits the whole drawing and the stock, from above beside the legend, or from the front left. */
  fit(space: boolean): void {
    const { min: low, max: high } = this.box();
    const middle = low.clone().add(high).divideScalar(2);
    this.controls.target.copy(middle);
    const away = space ? new THREE.Vector3(-0.5, -1, 0.9) : new THREE.Vector3(0, 0, 1);
    this.camera.position.copy(middle).addScaledVector(away.normalize(), this.unit * 2);
    this.controls.enableRotate = space;
    this.controls.mouseButtons.LEFT = space ? THREE.MOUSE.ROTATE : THREE.MOUSE.PAN;
    this.controls.touches.ONE = space ? THREE.TOUCH.ROTATE : THREE.TOUCH.PAN;
    this.controls.update();
    this.camera.updateMatrixWorld();
    const seen = new THREE.Box3(low, high).applyMatrix4(this.camera.matrixWorldInverse).getSize(new THREE.Vector3());
    const { zoom, aside } = space ? this.fitted(seen, [0, 0]) : this.fittedBesideLegend(seen);
    this.camera.zoom = zoom;
    for (const at of [this.camera.position, this.controls.target]) at.add(new THREE.Vector3(-aside[0] / zoom, -aside[1] / zoom, 0));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.isFitted = true;
    // The legend still has the scale with which its size was found, and the labels are not placed again if the view is the same.
    if (!space) this.hearScale(zoom);
    this.draw();
  }

  /** Returns the zoom at which the drawing and the stock are visible from above. */
  private whole(): number {
    return this.fitted(this.box().getSize(new THREE.Vector3()), [0, 0]).zoom;
  }

  /** Returns the zoom at which a rectangle in mm fits the picture without a strip at its left and lower side, and the middle of what remains. */
  private fitted({ x, y }: { x: number; y: number }, [left, lower]: Point): { zoom: number; aside: Point } {
    const [width, height] = this.size;
    const least = this.unit / 20;
    const zoom = 0.86 * Math.min((width - left) / Math.max(x, least), (height - lower) / Math.max(y, least));
    return { zoom, aside: [left / 2, lower / 2] };
  }

  /** Like `fitted`, but right of the legend or above it if the legend would cover a corner of the rectangle. */
  private fittedBesideLegend(seen: THREE.Vector3): { zoom: number; aside: Point } {
    const whole = this.fitted(seen, [0, 0]);
    // From above the legend has a scale.
    this.hearScale(whole.zoom);
    const { offsetLeft, offsetWidth, offsetTop } = this.legend;
    const [right, top] = [offsetLeft + offsetWidth, this.size[1] - offsetTop];
    const isCovered = (this.size[0] - seen.x * whole.zoom) / 2 < right && (this.size[1] - seen.y * whole.zoom) / 2 < top;
    if (this.legend.hidden || !isCovered) return whole;
    const [beside, above] = [this.fitted(seen, [right, 0]), this.fitted(seen, [0, top])];
    const larger = beside.zoom > above.zoom ? beside : above;
    // On a small picture, the legend covers the corner after all.
    return larger.zoom > whole.zoom / 2 ? larger : whole;
  }

  /** Returns the box round the drawing, its cuts, and the stock if it is shown: rapid moves may widen it. */
  private box(): THREE.Box3 {
    const { low, high } = this.model;
    const box = new THREE.Box3(new THREE.Vector3(low[0], low[1], low[2]), new THREE.Vector3(high[0], high[1], high[2]));
    return this.stock ? box.union(this.stock.box) : box;
  }

  /** Draws the first `count` moves and a share of the next one, with the tool at their end. */
  show(count: number, share = 0): void {
    const of = (pieces: Pieces) => (count === 0 ? 0 : pieces.until[count - 1]);
    const all = [
      [this.ahead, this.model.cuts],
      [this.holes, this.model.holes],
      [this.cuts, this.model.cuts],
      [this.rapids, this.model.rapids],
      [this.arrows, this.model.arrows],
      [this.rapidArrows, this.model.rapidArrows],
    ] as const;
    for (const [strokes, pieces] of all) strokes.draw(of(pieces));
    const { steps, unknownZ } = this.model;
    const way = share > 0 ? wayUpTo(steps[count], share, unknownZ) : [];
    this.progress.visible = way.length > 1 && (isCut(steps[count].move.kind) || this.rapids.object.visible);
    if (this.progress.visible) replace(this.progress, way.slice(1).flatMap((to, index) => [...way[index], ...to]));
    const step = steps[Math.max(count - 1, 0)];
    const at = step && (count === 0 ? step.move.from : step.move.to);
    const place = way.at(-1) ?? (at && at[0] !== null && at[1] !== null ? [at[0] + step.path.zero[0], at[1] + step.path.zero[1], at[2] ?? (isRapid(step.move.kind) ? unknownZ : 0)] : null);
    this.tool.visible = place !== null && place !== undefined;
    if (place) this.tool.position.set(place[0], place[1], place[2]);
    this.draw();
  }

  toggle(what: "rapids" | "arrows" | "other", on: boolean): void {
    (what === "other" ? this.other : this[what].object).visible = on;
    this.rapidArrows.object.visible = this.rapids.object.visible && this.arrows.object.visible;
    this.draw();
  }

  /** Highlights a range of moves, excluding its end; `null` removes the highlight. */
  point(moves: [number, number] | null): void {
    const points: number[] = [];
    if (moves !== null) {
      const [first, last] = moves;
      const all = last - first > 1 ? [this.model.cuts] : [this.model.cuts, this.model.rapids];
      for (const pieces of all) {
        const from = first === 0 ? 0 : pieces.until[first - 1];
        for (const part of pieces.points.slice(from * 6, Math.min(pieces.until[last - 1], from + MOST_THICK) * 6)) points.push(part);
      }
    }
    this.mark.visible = points.length > 0;
    if (points.length > 0) replace(this.mark, points);
    this.draw();
  }

  setSpots(spots: Spot[]): void {
    this.labels.set(spots);
    this.placeLabels();
  }

  /** Places the labels again after another element has covered the picture. */
  placeLabels(): void {
    this.labelled = null;
    this.draw();
  }

  /** Returns the index of the visible move nearest to a point of the picture. */
  pick(x: number, y: number, count: number): number | null {
    let [best, found] = [REACH, null as number | null];
    const a = new THREE.Vector3();
    const matrix = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    const [width, height] = this.size;
    const place = (points: number[], index: number): Point => {
      a.set(points[index], points[index + 1], points[index + 2]).applyMatrix4(matrix);
      return [((a.x + 1) / 2) * width, ((1 - a.y) / 2) * height];
    };
    const all = this.rapids.object.visible ? [this.model.cuts, this.model.rapids] : [this.model.cuts];
    for (const pieces of all) {
      const until = count === 0 ? 0 : pieces.until[count - 1];
      for (let piece = until - 1; piece >= 0; piece--) {
        const away = distance([x, y], place(pieces.points, piece * 6), place(pieces.points, piece * 6 + 3));
        if (away < best) [best, found] = [away, pieces.step[piece]];
      }
    }
    return found;
  }

  /** Returns the point of the plane Z = 0 under a point of the picture, snapped to the end of a move nearby. */
  plane(x: number, y: number, count: number): Point {
    const [width, height] = this.size;
    const step = this.pick(x, y, count);
    if (step !== null) {
      const { path, move } = this.model.steps[step];
      for (const end of [move.from, move.to]) {
        if (end[0] === null || end[1] === null) continue;
        const at: Point = [end[0] + path.zero[0], end[1] + path.zero[1]];
        const seen = this.project([at[0], at[1], end[2] ?? 0]);
        if (Math.hypot(seen[0] - x, seen[1] - y) < REACH) return at;
      }
    }
    const near = new THREE.Vector3((x / width) * 2 - 1, 1 - (y / height) * 2, -1).unproject(this.camera);
    const way = this.camera.getWorldDirection(new THREE.Vector3());
    const share = way.z === 0 ? 0 : -near.z / way.z;
    return [near.x + way.x * share, near.y + way.y * share];
  }

  project(at: [number, number, number]): Point {
    const seen = new THREE.Vector3(...at).project(this.camera);
    return [((seen.x + 1) / 2) * this.size[0], ((1 - seen.y) / 2) * this.size[1]];
  }

  draw(): void {
    if (this.isDue || !this.model) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.render();
    });
  }

  /** Draws the picture at once. Needed before printing, because Firefox keeps the picture only until it is on the screen. */
  render(): void {
    this.camera.updateMatrixWorld();
    this.stock?.prepare(this.renderer, this.camera);
    for (const strokes of this.all) if (strokes.object.visible) strokes.prepare?.(this.renderer, this.camera);
    this.renderer.render(this.scene, this.camera);
    this.label();
  }

  /** Places the labels, unless they are up to date. */
  private label(): void {
    const view = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    const [width, height] = this.size;
    const [before, ...size] = this.labelled ?? [];
    if (width === 0 || (before?.equals(view) && size[0] === width && size[1] === height)) return;
    this.hearScale(this.controls.enableRotate ? null : this.camera.zoom);
    this.labelled = [view, width, height];
    this.labels.place((at) => this.project(at), width, height);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    this.size = [width, height];
    // Labels are placed for this size; on paper the window has another size.
    this.host.style.setProperty("--width", `${width}px`);
    this.host.style.setProperty("--height", `${height}px`);
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    Object.assign(this.camera, { left: -width / 2, right: width / 2, top: height / 2, bottom: -height / 2 });
    this.camera.updateProjectionMatrix();
    this.materials.forEach((material) => material.resolution.set(width, height));
    if (this.isFitted) this.fit(this.controls.enableRotate);
    this.draw();
  }

  private strokes(pieces: Pieces, width: number): Strokes {
    if (pieces.step.length > MOST_THICK) return this.kept(new Kept(pieces), ++this.layer);
    const lines = this.fat(pieces, width);
    return { object: lines, draw: (count) => (lines.geometry.instanceCount = count) };
  }

  private kept(kept: Kept, order: number): Kept {
    kept.object.renderOrder = order;
    return kept;
  }

  /** Creates the lines of pending cuts: faint, and behind all completed ones. Very many lines become part of the picture of the cuts instead. */
  private strokesAhead(pieces: Pieces): Strokes {
    const lines = this.thin(pieces.step.length > MOST_THICK ? [] : pieces.points, hex("ahead"));
    lines.material.depthTest = lines.material.depthWrite = false;
    lines.frustumCulled = false;
    lines.renderOrder = ++this.layer;
    return { object: lines, draw: (count) => lines.geometry.setDrawRange(count * 2, Infinity) };
  }

  private discs({ points, colors }: Pieces): Strokes {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
    const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, depthTest: false, depthWrite: false }));
    mesh.frustumCulled = false;
    mesh.renderOrder = ++this.layer;
    return { object: mesh, draw: (count) => geometry.setDrawRange(0, count * 3) };
  }

  private fat(pieces: Pieces, width: number): LineSegments2 {
    const material = new LineMaterial({ linewidth: width, vertexColors: true, depthTest: false, depthWrite: false });
    this.materials.push(material);
    const points = pieces.points.length > 0 ? pieces.points : [0, 0, 0, 0, 0, 0];
    const geometry = new LineSegmentsGeometry().setPositions(points);
    geometry.setColors(pieces.colors.length > 0 ? pieces.colors : [0, 0, 0, 0, 0, 0]);
    geometry.instanceCount = pieces.points.length / 6;
    const lines = new LineSegments2(geometry, material);
    lines.frustumCulled = false;
    // Later strokes are on top: deeper passes come after those above them.
    lines.renderOrder = ++this.layer;
    return lines;
  }

  private thin(points: number[], color: number): THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial> {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color }));
  }
}

function colored(points: number[], name: string): Pieces {
  const parts = color(name);
  return { points, colors: points.map((_, index) => parts[index % 3]), until: [], step: [] };
}

/** Replaces the pieces of lines by others in the colour of errors. */
function replace(lines: LineSegments2, points: number[]): void {
  lines.geometry.dispose();
  const { colors } = colored(points, "error");
  lines.geometry = new LineSegmentsGeometry().setPositions(points);
  lines.geometry.setColors(colors);
}

function distance([x, y]: Point, [ax, ay]: Point, [bx, by]: Point): number {
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const share = square === 0 ? 0 : Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square));
  return Math.hypot(x - ax - dx * share, y - ay - dy * share);
}

function strokes(shape: Shape, [x, y]: Point, z: number): number[] {
  const points = pointsOfShape(shape);
  return points.slice(1).flatMap((to, index) => [points[index][0] + x, points[index][1] + y, z, to[0] + x, to[1] + y, z]);
}

function otherShapes(scene: Scene): number[] {
  return scene.other_layers.flatMap((it) => (it.type === "shape" ? strokes(it.shape, [0, 0], 0) : []));
}

/** Returns the outlines of clamps, on the plate or at their heights. */
function keepOuts(scene: Scene, high: boolean): number[] {
  return scene.keep_outs.flatMap((it) => it.outline.flatMap((shape) => strokes(shape, [0, 0], high ? it.height : 0)));
}

/** Creates a translucent clamp. */
function clamp(it: KeepOut): THREE.Mesh {
  const corners = it.outline.flatMap((shape) => pointsOfShape(shape).slice(1)).map(([x, y]) => new THREE.Vector2(x, y));
  const body = new THREE.ExtrudeGeometry(new THREE.Shape(corners), { depth: it.height, bevelEnabled: false });
  const material = new THREE.MeshBasicMaterial({ color: hex("clamp"), transparent: true, opacity: 0.16, depthWrite: false });
  return new THREE.Mesh(body, material);
}

/** Returns the lines of elements to draw beside moves: all elements of a path without a program, otherwise those that no move shows. */
function elementShapes(scene: Scene): number[] {
  const always = ["subpath", "skipped-subpath", "turn", "probe", "start", "end"];
  return scene.paths.flatMap((path) =>
    path.elements
      .filter((element) => path.moves.length === 0 || always.includes(element.kind))
      .flatMap((element) => strokes(element.shape, path.zero, 0)),
  );
}

/** Returns the outlines of finished parts on their upper faces. */
function outlines(scene: Scene): Pieces {
  const ofPart = (path: Path) => (path.parts ?? []).flatMap(({ rings, top }) => rings.flat().flatMap((shape) => strokes(shape, path.zero, top)));
  const points = scene.paths.flatMap(ofPart);
  return colored(points, "outline");
}

function bars(scene: Scene): Pieces {
  const points = scene.paths.flatMap((path) => path.bars.flatMap((bar) => strokes(bar.shape, path.zero, bar.top)));
  return colored(points, "bar");
}
