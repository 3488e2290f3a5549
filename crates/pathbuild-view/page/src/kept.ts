// Strokes in large numbers. Without a graphics card each of them costs half a microsecond, however short it is. Finished strokes are therefore
// kept as a picture, and a step draws only the new ones. For steps backwards, pictures of the first part of the strokes, the first two parts and
// so on are kept.

import * as THREE from "three";

import { Pieces } from "./model.js";

/** Maximum number of pictures, and maximum total number of their pixels. */
const [MOST_PICTURES, MOST_PIXELS] = [16, 24_000_000];

interface Picture {
  target: THREE.WebGLRenderTarget;
  /** Number of strokes drawn in the picture. */
  count: number;
}

export class Kept {
  /** Mesh that displays the picture. */
  readonly object: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private total: number;
  private wanted = 0;
  private shown: Picture | null = null;
  /** Pictures of the first part of the strokes, of the first two parts, and so on. */
  private parts: Picture[] = [];
  private view = new THREE.Matrix4();
  private size = new THREE.Vector2();

  /** If a colour for pending strokes is given, pending strokes are visible beneath the others. */
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

  /** Sets the number of strokes that are drawn as completed. */
  draw(count: number): void {
    this.wanted = count;
  }

  /** Draws the picture before it is shown. */
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

  dispose(): void {
    this.forget();
    this.lines.geometry.dispose();
    this.lines.material.dispose();
  }

  /** Returns the picture to show; restarts it if the camera has moved. */
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

  /** Returns to a picture to which the remaining strokes can be added, or advances to a later one that is nearer. */
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

  private put(renderer: THREE.WebGLRenderer, picture: Picture, target: THREE.WebGLRenderTarget): void {
    this.object.material.uniforms.picture.value = picture.target.texture;
    paint(renderer, target, this.object, new THREE.Camera(), true);
  }

  private forget(): void {
    for (const { target } of [...this.parts, ...(this.shown ? [this.shown] : [])]) target.dispose();
    [this.parts, this.shown] = [[], null];
  }
}

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

/** Material that covers the window with a picture; empty pixels are left unchanged. */
function sheet(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    uniforms: { picture: { value: null } },
    vertexShader: "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",
    fragmentShader: "uniform sampler2D picture; varying vec2 at; void main() { gl_FragColor = texture2D(picture, at); if (gl_FragColor.a < 0.5) discard; }",
    depthTest: false,
    depthWrite: false,
  });
}
