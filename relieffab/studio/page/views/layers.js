// The three layers: lines, Lambertian shading, depth.

import { colourOf } from "../dom.js";
import { quantity } from "../quantity.js";
import { ink, ribbons } from "../ribbons.js";
import { dispose } from "../stage.js";
import { FlatView } from "./flat.js";

// Warm greys: a picture on the same paper.
const GREY =
  "vec3 colour(vec4 texel) { return mix(vec3(0.11, 0.1, 0.085), vec3(0.984, 0.973, 0.945), texel.r); }";
// A blank sheet: the strokes themselves are drawn on it, sharper than their picture.
const SHEET = "vec3 colour(vec4 texel) { return vec3(0.984, 0.973, 0.945); }";

/** The border of an image of pixels on the panel, mm. */
function border({ origin_mm: [x, y], pitch_mm: pitch }, [rows, cols]) {
  return [x, y - rows * pitch, x + cols * pitch, y];
}

export class LayerView extends FlatView {
  /** @param {"lambert" | "depth"} name */
  constructor(name) {
    super({ wants: ["layers"], fragment: GREY });
    this.name = name;
  }

  show(frame) {
    const array = frame.arrays[this.name];
    this.take(array, border(frame, array.shape), frame.size_mm);
  }
}

/** Strokes drawn over a flat picture. */
export class DrawnView extends FlatView {
  strokes = null;

  /** Take the strokes of a frame, as ink of a colour of the style sheet. */
  drawOver({ arrays }, settings, colour) {
    this.forgetStrokes();
    const width = quantity(settings.line_width, "mm") ?? 0.6;
    this.strokes = ribbons(arrays.stroke_points, arrays.stroke_starts, width, ink());
    this.strokes.material.depthTest = false;
    this.strokes.material.uniforms.colour.value.set(colourOf(colour));
    this.strokes.renderOrder = 1;
    this.scene.add(this.strokes);
  }

  forgetStrokes() {
    if (this.strokes) dispose(this.strokes);
    this.strokes = null;
  }
}

export class LinesView extends DrawnView {
  constructor() {
    super({ wants: ["layers"], fragment: SHEET });
  }

  show(frame, settings) {
    const { lines } = frame.arrays;
    this.take(lines, border(frame, lines.shape), frame.size_mm);
    this.drawOver(frame, settings, "--drawn");
  }
}
