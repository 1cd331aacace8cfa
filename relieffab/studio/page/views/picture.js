// A picture or a drawing as it lies on the panel, its drawn lines over it.

import { Vector4 } from "../three.js";
import { Edge } from "../edge.js";
import { DrawnView } from "./layers.js";

// What is transparent shows the sheet below, and what lies beyond the panel is not there.
const ON_SHEET = `uniform vec4 panel;
  vec3 colour(vec4 texel) {
    if (any(lessThan(vUv, panel.xy)) || any(greaterThan(vUv, panel.zw))) discard;
    return mix(vec3(0.984, 0.973, 0.945), texel.rgb, texel.a);
  }`;

export class PictureView extends DrawnView {
  help = "Arrow keys move the picture, plus and minus zoom, 0 shows all of it. It cannot be turned.";

  constructor() {
    super({ wants: ["layers"], fragment: ON_SHEET, uniforms: { panel: { value: new Vector4() } } });
    this.edge = new Edge();
    this.scene.add(this.edge.object);
  }

  /** Take another picture; where it lies comes with its layers. */
  load({ arrays, box }) {
    this.forgetStrokes();
    this.clear();
    this.colours = arrays.colours;
    this.bounds = box;
    this.rig.reset();
  }

  /** Lay it where the studio does, and draw its lines. */
  draw(frame, settings) {
    const [[scale, , x], [, down, y]] = frame.matrix;
    const [left, top, right, bottom] = this.bounds;
    const [x0, y0, x1, y1] = [x + scale * left, y + down * bottom, x + scale * right, y + down * top];
    const [w, h] = frame.size_mm;
    const [across, along] = [x1 - x0, y1 - y0];
    this.colouring.uniforms.panel.value.set(-x0 / across, -y0 / along, (w - x0) / across, (h - y0) / along);
    this.take(this.colours, [x0, y0, x1, y1], frame.size_mm);
    this.edge.fit(frame.size_mm);
    this.drawOver(frame, settings, "--over");
    this.dress();
  }

  enter() {
    this.dress();
  }

  dress() {
    this.edge.dress();
  }

  place() {}
}
