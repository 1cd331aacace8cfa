// What carving leaves beside what was wanted: blue too deep, red left standing.

import { pair } from "../quantity.js";
import { FlatView, plain } from "./flat.js";

export class DeviationView extends FlatView {
  constructor() {
    super({
      wants: ["toolpaths"],
      exact: true,
      uniforms: {
        limit: { value: 0.1 },
        low: plain("#2040c8"),
        even: plain("#f6f4ee"),
        high: plain("#c83c0a"),
        off: plain("#cfccc4"),
      },
      fragment: `uniform float limit; uniform vec3 low, even, high, off;
        vec3 colour(vec4 texel) {
          float value = texel.r;
          if (!(abs(value) < 1e20)) return off;
          float share = clamp(value / limit, -1.0, 1.0);
          return mix(even, share < 0.0 ? low : high, abs(share));
        }`,
    });
  }

  show(frame, settings) {
    const array = frame.arrays.deviation;
    const [rows, cols] = array.shape;
    const { pitch_mm: pitch } = frame;
    const [x, y] = frame.origin_mm;
    this.colouring.uniforms.limit.value = frame.deviation_mm.limit;
    const half = pitch / 2; // values are at nodes: each stands for the pixel round it
    this.take(
      array,
      [x - half, y - (rows - 0.5) * pitch, x + (cols - 0.5) * pitch, y + half],
      pair(settings.size),
    );
  }
}
