// The edge of the panel, seen straight on.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineLoop } from "./three.js";
import { colourOf } from "./dom.js";

export class Edge {
  constructor() {
    this.object = new LineLoop(new BufferGeometry(), new LineBasicMaterial());
    this.object.frustumCulled = false;
  }

  /** Take the panel's size, mm. */
  fit([w, h]) {
    const corners = new Float32Array([0, 0, 0, w, 0, 0, w, h, 0, 0, h, 0]);
    this.object.geometry.setAttribute("position", new BufferAttribute(corners, 3));
  }

  dress() {
    this.object.material.color.set(colourOf("--line"));
  }
}
