// The panel as a solid, with its frame, outline and holes.

import { BufferAttribute, BufferGeometry, Mesh } from "../three.js";
import { dispose } from "../stage.js";
import { dressed, stone } from "../stone.js";
import { SolidView } from "./solid.js";

const CREASE = Math.cos((35 * Math.PI) / 180);

export class PanelView extends SolidView {
  constructor(sun) {
    super(sun, ["panel"]);
    this.solid = null;
  }

  show({ arrays, extent_mm: extent }, settings) {
    if (this.solid) dispose(this.solid);
    this.solid = new Mesh(creased(arrays.positions.data, arrays.indices.data), stone());
    this.solid.frustumCulled = false;
    dressed(this.solid.material, settings.material);
    this.scene.add(this.solid);
    this.rig.size = extent;
    this.relight(this.sun.direction);
  }

  relight(direction) {
    super.relight(direction);
    this.solid?.material.uniforms.light.value.copy(this.towards);
  }
}

/** Give each corner the mean normal of the faces round it that bend less than a crease. */
function creased(points, index) {
  const flat = faceNormals(points, index);
  const around = facesAround(points.length / 3, index);
  const places = new Float32Array(3 * index.length);
  const normals = new Float32Array(3 * index.length);
  for (let corner = 0; corner < index.length; corner++) {
    const own = 3 * Math.floor(corner / 3);
    const sum = [0, 0, 0];
    for (let at = around.first[index[corner]]; at < around.first[index[corner] + 1]; at++) {
      const other = 3 * around.faces[at];
      const [dot, area] = compare(flat, own, other);
      if (dot >= CREASE) for (let axis = 0; axis < 3; axis++) sum[axis] += area * flat.unit[other + axis];
    }
    const length = Math.hypot(...sum) || 1;
    for (let axis = 0; axis < 3; axis++) {
      places[3 * corner + axis] = points[3 * index[corner] + axis];
      normals[3 * corner + axis] = sum[axis] / length;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  return geometry;
}

function compare({ unit, area }, own, other) {
  const dot = unit[own] * unit[other] + unit[own + 1] * unit[other + 1] + unit[own + 2] * unit[other + 2];
  return [dot, area[other / 3]];
}

function faceNormals(points, index) {
  const unit = new Float32Array(index.length);
  const area = new Float32Array(index.length / 3);
  for (let face = 0; face < index.length; face += 3) {
    const [a, b, c] = [3 * index[face], 3 * index[face + 1], 3 * index[face + 2]];
    const [ux, uy, uz] = [
      points[b] - points[a],
      points[b + 1] - points[a + 1],
      points[b + 2] - points[a + 2],
    ];
    const [vx, vy, vz] = [
      points[c] - points[a],
      points[c + 1] - points[a + 1],
      points[c + 2] - points[a + 2],
    ];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(...normal);
    area[face / 3] = length;
    for (let axis = 0; axis < 3; axis++) unit[face + axis] = normal[axis] / (length || 1);
  }
  return { unit, area };
}

/** Which faces meet at each point: faces[first[point]] to faces[first[point + 1]]. */
function facesAround(count, index) {
  const first = new Uint32Array(count + 1);
  for (const point of index) first[point + 1] += 1;
  for (let point = 0; point < count; point++) first[point + 1] += first[point];
  const next = first.slice();
  const faces = new Uint32Array(index.length);
  index.forEach((point, corner) => (faces[next[point]++] = Math.floor(corner / 3)));
  return { first, faces };
}
