// A picture of the panel, looked at straight on: the layers and the deviation.

import {
  Color,
  DataTexture,
  LinearFilter,
  Mesh,
  NearestFilter,
  PlaneGeometry,
  RedFormat,
  RGBAFormat,
  FloatType,
  Scene,
  ShaderMaterial,
  UnsignedByteType,
} from "../three.js";
import { FlatRig } from "../rigs.js";
import { dispose } from "../stage.js";

const VERTEX = `varying vec2 vUv;
  void main() { vUv = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

export class FlatView {
  help = "Arrow keys move the picture, plus and minus zoom, 0 shows all of it.";

  /** @param {object} colouring  fragment: GLSL of `vec3 colour(vec4 texel)`, uniforms, exact? */
  constructor({ wants, fragment, uniforms = {}, exact = false }) {
    this.wants = wants;
    this.colouring = { fragment, uniforms };
    this.exact = exact;
    this.rig = new FlatRig();
    this.scene = new Scene();
    this.sheet = null;
    this.told = () => {};
  }

  /**
   * Show an array.
   *
   * @param {{data, shape}} array  uint8 or float32, row 0 the far edge; of four values if (.., .., 4)
   * @param {number[]} box  x0, y0, x1, y1 of its border on the panel, mm
   */
  take(array, box, size) {
    if (this.sheet) dispose(this.sheet);
    const [rows, cols] = array.shape;
    const real = array.data instanceof Float32Array;
    const format = array.shape[2] === 4 ? RGBAFormat : RedFormat;
    const texture = new DataTexture(array.data, cols, rows, format, real ? FloatType : UnsignedByteType);
    texture.unpackAlignment = 1;
    texture.flipY = false;
    texture.magFilter = texture.minFilter = real || this.exact ? NearestFilter : LinearFilter;
    texture.needsUpdate = true;
    const [x0, y0, x1, y1] = box;
    this.sheet = new Mesh(new PlaneGeometry(x1 - x0, y1 - y0), this.#paint(texture));
    this.sheet.position.set((x0 + x1) / 2, (y0 + y1) / 2, -1);
    this.sheet.frustumCulled = false;
    this.scene.add(this.sheet);
    this.rig.size = size;
    this.array = array;
    this.box = box;
  }

  /** Show nothing. */
  clear() {
    if (this.sheet) dispose(this.sheet);
    this.sheet = this.array = null;
  }

  #paint(texture) {
    return new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: `uniform sampler2D picture; varying vec2 vUv;
        ${this.colouring.fragment}
        void main() { gl_FragColor = vec4(colour(texture2D(picture, vec2(vUv.x, 1.0 - vUv.y))), 1.0); }`,
      uniforms: { picture: { value: texture }, ...this.colouring.uniforms },
    });
  }

  /** Tell what lies under the pointer: (x, y, value), or null. */
  point(px, py) {
    if (px === null || !this.array || !this.rig.view) return this.told(null);
    const [x, y] = this.rig.at(px, py);
    const [x0, y0, x1, y1] = this.box;
    const [rows, cols] = this.array.shape;
    const col = Math.floor(((x - x0) / (x1 - x0)) * cols);
    const row = Math.floor(((y1 - y) / (y1 - y0)) * rows);
    const inside = row >= 0 && row < rows && col >= 0 && col < cols;
    return this.told(inside ? { x, y, value: this.array.data[row * cols + col] } : null);
  }

  turn(dx, dy) {
    this.rig.pan(dx, dy);
  }

  pan(dx, dy) {
    this.rig.pan(dx, dy);
  }

  zoom(factor, x, y) {
    this.rig.zoom(factor, x, y);
  }

  reset() {
    this.rig.reset();
  }

  roll() {}

  light() {}
}

/** Make a colour of the style sheet into a uniform: sRGB as it stands, for nothing is lit. */
export function plain(text) {
  return { value: new Color().setStyle(text, "srgb-linear") };
}
