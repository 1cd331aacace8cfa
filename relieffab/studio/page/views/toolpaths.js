// The programs over the stock that they carve, up to a moment.

import {
  BufferAttribute,
  BufferGeometry,
  LatheGeometry,
  LineSegments,
  Mesh,
  ShaderMaterial,
  Color,
  Vector2,
  Vector3,
} from "../three.js";
import { Slab } from "../slab.js";
import { dispose } from "../stage.js";
import { stone } from "../stone.js";
import { SolidView } from "./solid.js";

export const PASSES = {
  rapid: "#8b8b93",
  rough: "#4a63c0",
  finish: "#2d8f57",
  rest: "#b7791a",
  waterline: "#14808f",
  pencil: "#8a4fb5",
  lines: "#c6401a",
  marks: "#8c2f63",
};
const MOST = 16; // kinds of move
const LIFT = 0.04; // mm: paths lie on the surface they cut
const FRESH = 0.02; // of the whole time: how long what was cut last stands out

export class ToolpathView extends SolidView {
  constructor(sun) {
    super(sun, ["toolpaths"]);
    this.slab = new Slab();
    this.scene.add(this.slab.object);
    this.paths = this.tool = null;
    this.at = 0;
  }

  /** Take the programs: their moves, and what they are. */
  show(frame, settings) {
    for (const old of [this.paths, this.tool]) if (old) dispose(old);
    this.tool = null;
    this.bound(settings);
    this.frame = frame;
    this.total = frame.seconds_total;
    this.slab.dress(settings.material);
    this.paths = new LineSegments(segments(frame.arrays), thread(frame.kinds, this.total));
    this.paths.frustumCulled = false;
    this.paths.position.z = LIFT;
    this.paths.renderOrder = 1;
    this.scene.add(this.paths);
    this.seek(this.total);
  }

  /** Take the stock as it is at a moment. */
  carve({ arrays, pitch_mm: pitch, origin_mm: origin }) {
    this.slab.update(arrays.heights, { pitch, origin, thickness: this.rig.size[2] });
    this.slab.relight(this.towards);
  }

  /** Go to a moment, seconds after the start. */
  seek(seconds) {
    this.at = seconds;
    if (!this.paths) return;
    this.paths.material.uniforms.now.value = seconds;
    this.#hold(seconds);
  }

  /** Show or hide a kind of move. */
  toggle(kind, shown) {
    this.paths.material.uniforms.shown.value[kind] = shown ? 1 : 0;
  }

  relight(direction) {
    super.relight(direction);
    this.slab.relight(this.towards);
  }

  /** Put the cutter of that moment where it is. */
  #hold(seconds) {
    const { moves, program_of: program } = this.frame.arrays;
    const next = firstAfter(moves.data, moves.shape[0], seconds);
    const which = program ? program.data[Math.min(next, moves.shape[0] - 1)] : 0;
    if (!this.tool || this.tool.userData.which !== which) this.#take(which);
    this.tool.visible = seconds < this.total;
    this.tool.position.copy(between(moves.data, next, seconds));
  }

  #take(which) {
    if (this.tool) dispose(this.tool);
    const { profile, diameter_mm: diameter = 3 } = this.frame.programs[which] ?? {};
    const half = diameter / 2;
    const outline = profile ?? [
      [0, 0],
      [half, 0],
      [half, 6 * half],
    ];
    const points = outline.map(([radius, height]) => new Vector2(radius, height));
    this.tool = new Mesh(new LatheGeometry(points, 32), stone());
    this.tool.geometry.rotateX(Math.PI / 2);
    this.tool.material.uniforms.stone.value.set("#9aa3ab");
    this.tool.userData.which = which;
    this.scene.add(this.tool);
  }
}

/** Two ends a move, each with its time and kind. */
function segments({ moves, kinds }) {
  const count = Math.max(0, moves.shape[0] - 1);
  const places = new Float32Array(6 * count);
  const about = new Float32Array(4 * count);
  for (let move = 0; move < count; move++) {
    for (let end = 0; end < 2; end++) {
      const from = 4 * (move + end);
      for (let axis = 0; axis < 3; axis++) places[6 * move + 3 * end + axis] = moves.data[from + axis];
      about[4 * move + 2 * end] = moves.data[from + 3];
      about[4 * move + 2 * end + 1] = kinds.data[move + 1];
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  geometry.setAttribute("about", new BufferAttribute(about, 2));
  return geometry;
}

function thread(kinds, total) {
  const colours = Array.from({ length: MOST }, (_, kind) => new Color(PASSES[kinds[kind]] ?? "#777777"));
  return new ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: {
      palette: { value: colours },
      shown: {
        value: kinds
          .map((kind) => (kind === "rapid" ? 0 : 1))
          .concat(Array(MOST).fill(1))
          .slice(0, MOST),
      },
      now: { value: total },
      fresh: { value: Math.max(FRESH * total, 1e-3) },
    },
    vertexShader: /* glsl */ `
      attribute vec2 about;
      uniform vec3 palette[${MOST}];
      uniform float shown[${MOST}];
      uniform float now, fresh;
      varying vec4 vColour;
      void main() {
        int kind = int(about.y + 0.5);
        float age = (now - about.x) / fresh;
        float seen = age < 0.0 ? 0.0 : mix(0.95, 0.2, clamp(age, 0.0, 1.0));
        vColour = vec4(palette[kind], seen * shown[kind]);
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: /* glsl */ `
      varying vec4 vColour;
      void main() {
        if (vColour.a < 0.01) discard;
        gl_FragColor = vColour;
        #include <colorspace_fragment>
      }`,
  });
}

/** Find the first move that ends after a moment. */
function firstAfter(data, count, seconds) {
  let [low, high] = [0, count];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (data[4 * middle + 3] <= seconds) low = middle + 1;
    else high = middle;
  }
  return low;
}

function between(data, next, seconds) {
  const count = data.length / 4;
  const [b, a] = [Math.min(next, count - 1), Math.max(0, Math.min(next, count - 1) - 1)];
  const [start, end] = [data[4 * a + 3], data[4 * b + 3]];
  const share = end > start ? Math.min(1, (seconds - start) / (end - start)) : 1;
  const [x, y, z] = [0, 1, 2].map(
    (axis) => data[4 * a + axis] + share * (data[4 * b + axis] - data[4 * a + axis]),
  );
  return new Vector3(x, y, z);
}
