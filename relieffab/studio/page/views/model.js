// The model as it will be carved: turned by hand, its drawn lines with it.

import { BufferAttribute, BufferGeometry, Color, Matrix4, Mesh, Scene } from "../three.js";
import { colourOf } from "../dom.js";
import { Edge } from "../edge.js";
import { anglesOf, placement, roomOf } from "../placement.js";
import { quantity } from "../quantity.js";
import { FlatRig } from "../rigs.js";
import { ink, ribbons } from "../ribbons.js";
import { dispose } from "../stage.js";
import { stone } from "../stone.js";

const PER_PIXEL = 0.4; // degrees
const ABOVE = 0.6; // mm that the ink lies over the model, not to sink into it
const STALE = 0.45; // of the ink, until the lines of this view have come

export class ModelView {
  help = "Arrow keys turn the model, q and e roll it, plus and minus zoom, 0 goes back to the named view.";
  wants = ["layers"];

  constructor(store) {
    this.store = store;
    this.rig = new FlatRig();
    this.scene = new Scene();
    this.edge = new Edge();
    this.scene.add(this.edge.object);
    this.model = this.strokes = this.asked = null;
  }

  /** Take another model: a mesh in its own units. */
  load({ arrays }, { up }) {
    if (this.model) dispose(this.model);
    this.forgetStrokes();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(arrays.positions.data, 3));
    geometry.setIndex(new BufferAttribute(arrays.indices.data, 1));
    geometry.computeVertexNormals();
    this.up = up;
    this.points = arrays.positions.data;
    this.model = new Mesh(geometry, stone());
    this.model.material.uniforms.light.value.set(-0.45, 0.5, 0.74);
    this.model.matrixAutoUpdate = false;
    this.model.frustumCulled = false;
    this.scene.add(this.model);
    this.rig.reset();
    this.place();
  }

  forgetStrokes() {
    if (this.strokes) dispose(this.strokes);
    this.strokes = null;
  }

  /** Put the model where the settings want it, and the strokes it had along with it. */
  place() {
    const room = roomOf(this.store.settings);
    if (!this.model || !room) return;
    const up = this.store.settings.up || this.up;
    const matrix = placement(this.points, anglesOf(this.store.settings), up, room);
    if (!matrix.elements.every(Number.isFinite)) return;
    this.model.matrix.copy(matrix);
    this.model.matrixWorldNeedsUpdate = true;
    this.rig.size = room.size;
    this.edge.fit(room.size);
    if (this.strokes) this.#carry(matrix);
  }

  /** Take the lines drawn of a view. */
  draw({ arrays, matrix }, settings) {
    this.forgetStrokes();
    this.asked = new Matrix4().set(...matrix.flat());
    const width = quantity(settings.line_width, "mm") ?? 0.6;
    this.strokes = ribbons(arrays.stroke_points, arrays.stroke_starts, width, ink());
    this.strokes.matrixAutoUpdate = false;
    this.strokes.renderOrder = 1;
    this.scene.add(this.strokes);
    this.dress();
    this.place();
  }

  dress() {
    this.edge.dress();
    this.strokes?.material.uniforms.colour.value.set(new Color(colourOf("--drawn")));
  }

  enter() {
    this.dress();
    this.place();
  }

  turn(dx, dy) {
    const { azimuth, elevation } = anglesOf(this.store.settings);
    const around = ((((azimuth - dx * PER_PIXEL + 180) % 360) + 360) % 360) - 180;
    const over = Math.min(90, Math.max(-90, elevation + dy * PER_PIXEL));
    this.#look({ azimuth: around, elevation: over });
  }

  roll(dx) {
    const { roll } = anglesOf(this.store.settings);
    this.#look({ roll: ((((roll - dx * PER_PIXEL + 180) % 360) + 360) % 360) - 180 });
  }

  pan(dx, dy) {
    this.rig.pan(dx, dy);
  }

  zoom(factor, x, y) {
    this.rig.zoom(factor, x, y);
  }

  light() {}

  /** Back to the named view. */
  reset() {
    this.rig.reset();
    this.store.change({ azimuth: "", elevation: "", roll: "0deg" });
  }

  #look(angles) {
    const texts = Object.entries(angles).map(([name, angle]) => [name, `${Number(angle.toFixed(1))}deg`]);
    this.store.change(Object.fromEntries(texts), "turn");
  }

  /** Move the strokes from the view they were drawn of to the one shown. */
  #carry(matrix) {
    const moved = matrix.clone().multiply(this.asked.clone().invert());
    this.strokes.matrix.makeTranslation(0, 0, ABOVE).multiply(moved);
    this.strokes.matrixWorldNeedsUpdate = true;
    const away = moved.elements.reduce(
      (most, value, at) => Math.max(most, Math.abs(value - (at % 5 ? 0 : 1))),
      0,
    );
    // What the drawing hides is hidden in its own view alone.
    const stale = away > 0.02;
    this.strokes.material.depthTest = stale;
    this.strokes.material.uniforms.fade.value = stale ? STALE : 0.92;
  }
}
