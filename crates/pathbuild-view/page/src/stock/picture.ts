// The stock in the WebGL picture. The script computes heights and colours. From above the GPU shows the colours; in space it follows a ray
// through the texels for each pixel.

import * as THREE from "three";

import { Heights, Texels } from "./heights.js";
import { Color } from "./shading.js";
import { Stock } from "./stock.js";

/** Share of a texel by which a ray may deviate over the whole depth and still count as vertical. */
const VERTICAL = 0.01;

/** Picture of the stock: each pixel of the stock's box shows the first surface that a ray through the pixel meets. */
export class StockPicture {
  readonly object: THREE.Mesh<THREE.BoxGeometry, THREE.ShaderMaterial>;
  private above: THREE.ShaderMaterial;
  private space: THREE.ShaderMaterial;
  private textures: THREE.DataTexture[];
  /** Textures that share the memory of the map. Parts of them are uploaded into the textures on the graphics card. */
  private sources: THREE.DataTexture[];
  private changed: Texels[] = [];

  private map: Heights;

  constructor({ map, colors, paints }: Stock) {
    this.map = map;
    const { columns, rows, texel, cutting } = map;
    const make = () => [
      new THREE.DataTexture(map.heights, columns, rows, THREE.RedFormat, THREE.FloatType),
      new THREE.DataTexture(map.rapid, columns, rows, THREE.RedFormat),
      new THREE.DataTexture(colors, columns, rows),
    ];
    [this.textures, this.sources] = [make(), make()];
    const [heights, rapid, shaded] = this.textures;
    shaded.magFilter = shaded.minFilter = THREE.LinearFilter;
    for (const texture of [...this.textures, ...this.sources]) texture.unpackAlignment = 1;
    for (const texture of this.textures) texture.needsUpdate = true;
    const [left, lower] = cutting.box;
    const [low, high] = [Math.min(cutting.low, 0), cutting.top];
    const uniforms = {
      heights: { value: heights },
      rapid: { value: rapid },
      shaded: { value: shaded },
      size: { value: new THREE.Vector2(columns, rows) },
      corner: { value: new THREE.Vector2(left, lower) },
      texel: { value: texel },
      range: { value: new THREE.Vector2(low, high) },
      eye: { value: new THREE.Vector3() },
      across: { value: new THREE.Vector3() },
      upwards: { value: new THREE.Vector3() },
      way: { value: new THREE.Vector3() },
      wallColor: { value: vector(paints.shallow) },
      plateColor: { value: vector(paints.plate) },
      wrongColor: { value: vector(paints.wrong) },
    };
    const material = (fragmentShader: string) =>
      // Draw only the back faces of the box, because they cover each of its pixels exactly once.
      new THREE.ShaderMaterial({ glslVersion: THREE.GLSL3, uniforms, vertexShader: VERTEX, fragmentShader: HEAD + fragmentShader, side: THREE.BackSide, depthTest: false, depthWrite: false });
    [this.above, this.space] = [material(FROM_ABOVE), material(IN_SPACE)];
    const [wide, tall] = [columns * texel, rows * texel];
    const box = new THREE.BoxGeometry(wide, tall, high - low).translate(left + wide / 2, lower + tall / 2, (low + high) / 2);
    box.computeBoundingBox();
    this.object = new THREE.Mesh(box, this.above);
    this.object.frustumCulled = false;
    this.object.renderOrder = -1;
  }

  /** Returns the box of the stock in mm. */
  get box(): THREE.Box3 {
    return this.object.geometry.boundingBox!.clone();
  }

  /** Registers texels whose heights or colours have changed. They are uploaded by `prepare`. */
  change(texels: Texels): void {
    this.changed.push(texels);
  }

  /** Uploads changed texels, and sets the position of the camera. */
  prepare(renderer: THREE.WebGLRenderer, camera: THREE.OrthographicCamera): void {
    for (const [x0, y0, x1, y1] of this.changed.splice(0)) {
      const region = new THREE.Box2(new THREE.Vector2(x0, y0), new THREE.Vector2(x1, y1));
      this.textures.forEach((texture, index) => renderer.copyTextureToTexture(this.sources[index], texture, region, region.min));
    }
    const { eye, across, upwards, way, range } = this.space.uniforms;
    const toward = new THREE.Vector3();
    camera.matrixWorld.extractBasis(across.value, upwards.value, toward);
    way.value.copy(toward).negate();
    // Move the eye along its line of sight to the upper face, so that coordinates stay small and single precision suffices.
    const away = way.value.z === 0 ? 0 : (range.value.y - camera.position.z) / way.value.z;
    eye.value.copy(camera.position).addScaledVector(way.value, away);
    across.value.multiplyScalar(camera.right / camera.zoom);
    upwards.value.multiplyScalar(camera.top / camera.zoom);
    const lean = Math.hypot(way.value.x, way.value.y) * (range.value.y - range.value.x);
    this.object.material = lean < VERTICAL * this.map.texel * Math.abs(way.value.z) ? this.above : this.space;
  }

  dispose(): void {
    for (const texture of this.textures) texture.dispose();
    this.object.geometry.dispose();
    for (const material of [this.above, this.space]) material.dispose();
  }
}

function vector(color: Color): THREE.Vector3 {
  return new THREE.Vector3(...color).divideScalar(255);
}

const VERTEX = `
out vec2 at;
void main() {
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  at = gl_Position.xy;
}`;

const HEAD = `
precision highp float;
precision highp int;
uniform highp sampler2D heights;
uniform sampler2D rapid, shaded;
uniform vec2 size, corner, range;
uniform float texel;
uniform vec3 eye, across, upwards, way, wallColor, plateColor, wrongColor;
in vec2 at;
out vec4 color;

void found(vec4 it) {
  if (it.a < 0.5) discard;
  color = vec4(it.rgb, 1);
}
`;

const FROM_ABOVE = `
void main() {
  vec3 from = eye + across * at.x + upwards * at.y;
  found(texture(shaded, (from.xy - corner) / texel / size));
}`;

const IN_SPACE = `
const vec3 LIGHT = vec3(-0.42, 0.55, 0.72);

float heightAt(ivec2 i) {
  return texelFetch(heights, clamp(i, ivec2(0), ivec2(size) - 1), 0).x;
}

// Which way a wall faces: the gradient of the heights around it. The sides of its texels would make stripes on round walls.
vec2 facing(ivec2 i) {
  vec2 gradient = vec2(0);
  for (int y = -2; y <= 2; y++)
    for (int x = -2; x <= 2; x++) gradient += vec2(x, y) * max(heightAt(i + ivec2(x, y)), range.x);
  return length(gradient) > 1e-6 ? -normalize(gradient) : vec2(0);
}

void wall(ivec2 i, vec2 side, bool isEdge) {
  vec2 normal = isEdge ? side : facing(i);
  if (dot(normal, normal) < 0.5) normal = side;
  color = vec4(wallColor * (clamp(dot(vec3(normal, 0), normalize(LIGHT)), 0.0, 1.0) * 0.6 + 0.36), 1);
  if (texelFetch(rapid, i, 0).r > 0.5) color.rgb = mix(color.rgb, wrongColor, 0.75);
}

void main() {
  vec3 from = eye + across * at.x + upwards * at.y;
  vec3 enter = from + way * ((range.y - from.z) / way.z);
  vec3 leave = from + way * ((range.x - from.z) / way.z);
  vec2 begin = (enter.xy - corner) / texel;
  vec2 run = (leave.xy - enter.xy) / texel;
  // The part of the ray over the map, and the side on which it enters.
  float first = 0.0, last = 1.0;
  int axis = -1;
  for (int k = 0; k < 2; k++) {
    if (abs(run[k]) < 1e-6) {
      if (begin[k] < 0.0 || begin[k] >= size[k]) discard;
      continue;
    }
    vec2 ends = vec2(-begin[k], size[k] - begin[k]) / run[k];
    float near = min(ends.x, ends.y);
    if (near > first) { first = near; axis = k; }
    last = min(last, max(ends.x, ends.y));
  }
  if (last <= first) discard;
  ivec2 i = ivec2(floor(clamp(begin + run * (first + 1e-5), vec2(0), size - 1.0)));
  ivec2 turn = ivec2(sign(run));
  vec2 each = vec2(abs(run.x) < 1e-6 ? 1e9 : 1.0 / abs(run.x), abs(run.y) < 1e-6 ? 1e9 : 1.0 / abs(run.y));
  vec2 next = (vec2(i) + vec2(max(turn, ivec2(0))) - begin) / run;
  if (abs(run.x) < 1e-6) next.x = 1e9;
  if (abs(run.y) < 1e-6) next.y = 1e9;
  float share = first, drop = range.x - range.y;
  bool isEdge = axis >= 0, isFloor = false, isSide = false;
  int most = int(size.x + size.y);
  // Only the search is in the loop: software evaluates all of a loop for every texel of a ray.
  for (int k = 0; k < most; k++) {
    float height = heightAt(i), until = min(next.x, next.y);
    isSide = axis >= 0 && range.y + drop * share < height - 1e-4;
    isFloor = range.y + drop * min(until, last) <= height;
    if (isSide || isFloor || until >= last) break;
    isEdge = false;
    share = until;
    axis = next.x < next.y ? 0 : 1;
    ivec2 onward = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    i += turn * onward;
    next += each * vec2(onward);
  }
  if (isSide) {
    ivec2 back = axis == 0 ? ivec2(-turn.x, 0) : ivec2(0, -turn.y);
    // A low step belongs to a slope, which has the colour of its floor.
    if (isEdge || heightAt(i) - heightAt(i + back) >= 2.0 * texel) wall(i, vec2(back), isEdge);
    else found(texelFetch(shaded, i, 0));
  } else if (isFloor) found(texelFetch(shaded, i, 0));
  else if (last < 1.0 || heightAt(i) < range.x - 1.0) discard;
  else color = vec4(plateColor, 1);
}`;
