// The relief as a solid block under the light.

import { Slab } from "../slab.js";
import { SolidView } from "./solid.js";

export class ReliefView extends SolidView {
  constructor(sun) {
    super(sun, ["relief"]);
    this.rig.reset = () => Object.assign(this.rig, { azimuth: 0, elevation: 74, scale: 1, aside: [0, 0] });
    this.rig.reset();
    this.slab = new Slab();
    this.scene.add(this.slab.object);
  }

  show({ arrays, pitch_mm: pitch, origin_mm: origin }, settings) {
    this.bound(settings);
    this.slab.dress(settings.material);
    this.slab.update(arrays.heights, { pitch, origin, thickness: this.rig.size[2] });
  }

  relight(direction) {
    super.relight(direction);
    this.slab.relight(this.towards);
  }
}
