// The stock in the WebGL picture. Script finds heights and colours; the GPU follows a ray for each pixel through the texels.

import * as THREE from "three";

import { Heights, Texels } from "./heights.js";
import { PLATE, RAPID } from "./shading.js";

/** Draws over the whole window what a ray through each pixel meets first. */
export class StockPicture {
  readonly object: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private textures: THREE.DataTexture[];
  /** The same memory, of which parts are uploaded into the textures. */
  private sources: THREE.DataTexture[];
  private changed: Texels[] = [];

  constructor(map: Heights, colors: Uint8ClampedArray) {
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
    const material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      uniforms: {
        heights: { value: heights },
        rapid: { value: rapid },
        shaded: { value: shaded },
        size: { value: new THREE.Vector2(columns, rows) },
        corner: { value: new THREE.Vector2(cutting.box[0], cutting.box[1]) },
        texel: { value: texel },
        range: { value: new THREE.Vector2(Math.min(cutting.low, 0), cutting.top) },
        eye: { value: new THREE.Vector3() },
        across: { value: new THREE.Vector3() },
        upwards: { value: new THREE.Vector3() },
        way: { value: new THREE.Vector3() },
      },
      vertexShader: "out vec2 at; void main() { at = position.xy; gl_Position = vec4(position.xy, 0.0, 1.0); }",
      fragmentShader: FRAGMENT,
      depthTest: false,
      depthWrite: false,
    });
    this.object = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = -1;
  }

  /** These texels have other heights and colours now. */
  change(texels: Texels): void {
    this.changed.push(texels);
  }

  /** Uploads what has changed, and sets from where it is seen. */
  prepare(renderer: THREE.WebGLRenderer, camera: THREE.OrthographicCamera): void {
    for (const [x0, y0, x1, y1] of this.changed.splice(0)) {
      const region = new THREE.Box2(new THREE.Vector2(x0, y0), new THREE.Vector2(x1, y1));
      this.textures.forEach((texture, index) => renderer.copyTextureToTexture(this.sources[index], texture, region, region.min));
    }
    const { eye, across, upwards, way, range } = this.object.material.uniforms;
    const toward = new THREE.Vector3();
    camera.matrixWorld.extractBasis(across.value, upwards.value, toward);
    way.value.copy(toward).negate();
    // The eye lies on the upper face: numbers stay small, so that single precision is enough for them.
    const away = way.value.z === 0 ? 0 : (range.value.y - camera.position.z) / way.value.z;
    eye.value.copy(camera.position).addScaledVector(way.value, away);
    across.value.multiplyScalar(camera.right / camera.zoom);
    upwards.value.multiplyScalar(camera.top / camera.zoom);
  }

  dispose(): void {
    for (const texture of this.textures) texture.dispose();
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}

const vec3 = (color: number[]) => `vec3(${color.map((part) => (part / 255).toFixed(3)).join(",")})`;

const FRAGMENT = `
precision highp float;
precision highp int;
uniform highp sampler2D heights;
uniform sampler2D rapid, shaded;
uniform vec2 size, corner, range;
uniform float texel;
uniform vec3 eye, across, upwards, way;
in vec2 at;
out vec4 color;

const vec3 LIGHT = vec3(-0.42, 0.55, 0.72);
const vec3 WALL = vec3(0.62, 0.46, 0.27);

float heightAt(ivec2 i) {
  return texelFetch(heights, clamp(i, ivec2(0), ivec2(size) - 1), 0).x;
}

void found(vec4 it) {
  if (it.a < 0.5) discard;
  color = vec4(it.rgb, 1);
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
  color = vec4(WALL * (clamp(dot(vec3(normal, 0), normalize(LIGHT)), 0.0, 1.0) * 0.7 + 0.42), 1);
  if (texelFetch(rapid, i, 0).r > 0.5) color.rgb = mix(color.rgb, ${vec3(RAPID)}, 0.75);
}

void main() {
  vec3 from = eye + across * at.x + upwards * at.y;
  vec3 enter = from + way * ((range.y - from.z) / way.z);
  vec3 leave = from + way * ((range.x - from.z) / way.z);
  vec2 begin = (enter.xy - corner) / texel;
  vec2 run = (leave.xy - enter.xy) / texel;
  if (dot(run, run) < 1e-4) {
    if (any(lessThan(begin, vec2(0))) || any(greaterThan(begin, size))) discard;
    found(texture(shaded, begin / size));
    return;
  }
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
  bool isEdge = axis >= 0;
  int most = int(size.x + size.y);
  for (int k = 0; k < most; k++) {
    float height = heightAt(i);
    if (axis >= 0 && range.y + drop * share < height - 1e-4) {
      ivec2 before = i - (axis == 0 ? ivec2(turn.x, 0) : ivec2(0, turn.y));
      // A low step belongs to a slope, which has the colour of its floor.
      if (!isEdge && height - heightAt(before) < 2.0 * texel) found(texelFetch(shaded, i, 0));
      else wall(i, axis == 0 ? vec2(-turn.x, 0) : vec2(0, -turn.y), isEdge);
      return;
    }
    float until = min(next.x, next.y);
    if (range.y + drop * min(until, last) <= height) {
      found(texelFetch(shaded, i, 0));
      return;
    }
    if (until >= last) break;
    isEdge = false;
    share = until;
    axis = next.x < next.y ? 0 : 1;
    if (axis == 0) { i.x += turn.x; next.x += each.x; }
    else { i.y += turn.y; next.y += each.y; }
  }
  if (last < 1.0 || heightAt(i) < range.x - 1.0) discard;
  color = vec4(${vec3(PLATE)}, 1);
}`;
