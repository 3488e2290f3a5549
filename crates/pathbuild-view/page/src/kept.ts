// Strokes in large numbers. Without a graphics card each of them costs half a microsecond, however short it is: what is drawn is kept as a
// picture, and a step draws only what comes on top. For steps backwards there are pictures of the first parts.

import * as THREE from "three";

import { Pieces } from "./model.js";

/** There are at most so many pictures, of at most so many pixels together. */
const [MOST_PICTURES, MOST_PIXELS] = [16, 24_000_000];

interface Picture {
  target: THREE.WebGLRenderTarget;
  /** How many strokes are done in it. */
  count: number;
}

export class Kept {
  /** Shows the picture. */
  readonly object: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private total: number;
  private wanted = 0;
  private shown: Picture | null = null;
  /** Pictures without strokes that are done, of the first part, of the first two, and so on. */
  private parts: Picture[] = [];
  private view = new THREE.Matrix4();
  private size = new THREE.Vector2();

  /** With a colour for strokes that are not done yet, these are to be seen beneath the others. */
  constructor(
    pieces: Pieces,
    private ahead?: number,
  ) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(pieces.points, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(pieces.colors, 3));
    this.lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, depthWrite: false }));
    this.lines.frustumCulled = false;
    this.total = pieces.step.length;
    this.object = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), sheet());
    this.object.frustumCulled = false;
  }

  /** The first so many are done. */
  draw(count: number): void {
    this.wanted = count;
  }

  /** Makes the picture, before it is shown. */
  prepare(renderer: THREE.WebGLRenderer, camera: THREE.Camera): void {
    const shown = this.begun(renderer, camera);
    const most = Math.min(MOST_PICTURES, Math.floor(MOST_PIXELS / (this.size.x * this.size.y)));
    const part = Math.ceil(this.total / Math.max(most, 1));
    this.resume(renderer, shown);
    while (shown.count < this.wanted) {
      const last = Math.floor(shown.count / part) + 1;
      const until = Math.min(this.wanted, last * part);
      this.lines.geometry.setDrawRange(shown.count * 2, (until - shown.count) * 2);
      paint(renderer, shown.target, this.lines, camera, false);
      shown.count = until;
      if (until === last * part && this.parts.length === last && last < most) this.parts.push(this.copy(renderer, shown));
    }
    this.object.material.uniforms.picture.value = shown.target.texture;
  }

  /** Gives back what the graphics card keeps. */
  dispose(): void {
    this.forget();
    this.lines.geometry.dispose();
    this.lines.material.dispose();
  }

  /** The picture that is shown, begun anew if the former one was seen from elsewhere. */
  private begun(renderer: THREE.WebGLRenderer, camera: THREE.Camera): Picture {
    const view = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const size = renderer.getDrawingBufferSize(new THREE.Vector2());
    if (!this.view.equals(view) || !this.size.equals(size)) this.forget();
    [this.view, this.size] = [view, size];
    if (this.shown) return this.shown;
    const target = new THREE.WebGLRenderTarget(size.x, size.y, { depthBuffer: false, magFilter: THREE.NearestFilter, minFilter: THREE.NearestFilter });
    paint(renderer, target, new THREE.Object3D(), camera, true);
    if (this.ahead !== undefined) this.paintAhead(renderer, target, camera, this.ahead);
    this.parts = [{ target, count: 0 }];
    return (this.shown = this.copy(renderer, this.parts[0]));
  }

  private paintAhead(renderer: THREE.WebGLRenderer, target: THREE.WebGLRenderTarget, camera: THREE.Camera, color: number): void {
    const { material, geometry } = this.lines;
    this.lines.material = new THREE.LineBasicMaterial({ color, depthTest: false, depthWrite: false });
    geometry.setDrawRange(0, Infinity);
    paint(renderer, target, this.lines, camera, false);
    this.lines.material.dispose();
    this.lines.material = material;
  }

  /** Goes back to where what is wanted can be drawn on top, or goes on from where that is nearer. */
  private resume(renderer: THREE.WebGLRenderer, shown: Picture): void {
    const before = this.parts.filter((part) => part.count <= this.wanted).at(-1)!;
    if (shown.count >= before.count && shown.count <= this.wanted) return;
    this.put(renderer, before, shown.target);
    shown.count = before.count;
  }

  private copy(renderer: THREE.WebGLRenderer, picture: Picture): Picture {
    const target = picture.target.clone();
    this.put(renderer, picture, target);
    return { target, count: picture.count };
  }

  /** Puts a picture into a target. */
  private put(renderer: THREE.WebGLRenderer, picture: Picture, target: THREE.WebGLRenderTarget): void {
    this.object.material.uniforms.picture.value = picture.target.texture;
    paint(renderer, target, this.object, new THREE.Camera(), true);
  }

  private forget(): void {
    for (const { target } of [...this.parts, ...(this.shown ? [this.shown] : [])]) target.dispose();
    [this.parts, this.shown] = [[], null];
  }
}

/** Draws an object alone into a target, on what is there or on nothing. */
function paint(renderer: THREE.WebGLRenderer, target: THREE.WebGLRenderTarget, object: THREE.Object3D, camera: THREE.Camera, clears: boolean): void {
  const [color, alpha] = [renderer.getClearColor(new THREE.Color()), renderer.getClearAlpha()];
  renderer.autoClear = clears;
  renderer.setClearColor(0, 0);
  renderer.setRenderTarget(target);
  renderer.render(object, camera);
  renderer.setRenderTarget(null);
  renderer.setClearColor(color, alpha);
  renderer.autoClear = true;
}

/** Covers all of a window with a picture; what is empty in it stays as it is. */
function sheet(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    uniforms: { picture: { value: null } },
    vertexShader: "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",
    fragmentShader: "uniform sampler2D picture; varying vec2 at; void main() { gl_FragColor = texture2D(picture, at); if (gl_FragColor.a < 0.5) discard; }",
    depthTest: false,
    depthWrite: false,
  });
}
