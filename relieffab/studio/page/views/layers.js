// The three layers: lines, Lambertian shading, depth.

import { colourOf } from "../dom.js";
import { quantity } from "../quantity.js";
import { ink, ribbons } from "../ribbons.js";
import { dispose } from "../stage.js";
import { FlatView } from "./flat.js";

// Warm greys: a picture on the same paper.
const GREY =
  "vec3 colour(float value) { return mix(vec3(0.11, 0.1, 0.085), vec3(0.984, 0.973, 0.945), value); }";
// A blank sheet: the strokes themselves are drawn on it, sharper than their picture.
const SHEET = "vec3 colour(float value) { return vec3(0.984, 0.973, 0.945); }";

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

export class LinesView extends FlatView {
  constructor() {
    super({ wants: ["layers"], fragment: SHEET });
    this.strokes = null;
  }

  show(frame, settings) {
    const { arrays } = frame;
    this.take(arrays.lines, border(frame, arrays.lines.shape), frame.size_mm);
    if (this.strokes) dispose(this.strokes);
    const width = quantity(settings.line_width, "mm") ?? 0.6;
    this.strokes = ribbons(arrays.stroke_points, arrays.stroke_starts, width, ink());
    this.strokes.material.depthTest = false;
    this.strokes.material.uniforms.colour.value.set(colourOf("--drawn"));
    this.strokes.renderOrder = 1;
    this.scene.add(this.strokes);
  }
}
