// What all views of a solid share: walking round it, and a light.

import { Scene, Vector3 } from "../three.js";
import { pair, quantity } from "../quantity.js";
import { OrbitRig } from "../rigs.js";

export class SolidView {
  help = "Arrow keys walk round the panel, with Shift they move the light; plus and minus zoom, 0 goes back.";
  lit = true;

  /** @param {Sun} sun  the one light of all views */
  constructor(sun, wants) {
    this.sun = sun;
    this.wants = wants;
    this.rig = new OrbitRig();
    this.scene = new Scene();
    this.towards = new Vector3();
  }

  enter() {
    this.relight(this.sun.direction);
  }

  /** Take the light from [x, y, z]. */
  relight(direction) {
    this.towards.set(...direction);
  }

  /** Take the panel's bounds for looking at, of settings that the studio could read. */
  bound({ size, thickness }) {
    this.rig.size = [...pair(size), quantity(thickness, "mm")];
  }

  turn(dx, dy) {
    this.rig.turn(dx, dy);
  }

  pan(dx, dy) {
    this.rig.pan(dx, dy);
  }

  zoom(factor) {
    this.rig.zoom(factor);
  }

  roll(dx) {
    this.rig.turn(dx, 0);
  }

  light(dx, dy) {
    this.sun.move(dx, dy);
  }

  reset() {
    this.rig.reset();
  }
}
