// A block of stone whose face is a height field.

import { BufferAttribute, BufferGeometry, Mesh, Object3D } from "./three.js";
import { fieldOf, openToLight, openToSky } from "./openness.js";
import { dispose } from "./stage.js";
import { dressed, stone } from "./stone.js";

export class Slab {
  constructor() {
    this.object = new Object3D();
    this.face = null;
    this.light = null;
    this.material = null;
  }

  /**
   * Take heights; what the graphics card holds is kept while their number stays.
   *
   * @param {{data: Float32Array, shape: number[]}} heights  at nodes, mm, row 0 the far edge
   * @param {object} place  pitch and origin [x, y] of heights[0], and the block's thickness, mm
   */
  update(heights, { pitch, origin, thickness }) {
    const key = [heights.shape, pitch, origin, thickness].join(" ");
    if (key !== this.key) this.#build(heights.shape, { pitch, origin, thickness });
    this.key = key;
    this.field = fieldOf(heights.data, heights.shape, pitch);
    this.#raise();
    openToSky(this.field, this.open.array);
    this.relight(this.light);
  }

  /** Move the light: a unit vector towards it. */
  relight(light) {
    this.light = light;
    if (!this.face || !light) return;
    openToLight(this.field, light, this.open.array);
    this.open.needsUpdate = true;
    for (const mesh of this.object.children) mesh.material.uniforms.light.value.copy(light);
  }

  /** Make it of another material. */
  dress(name) {
    this.material = name;
    for (const mesh of this.object.children) dressed(mesh.material, name);
  }

  #build([rows, cols], { pitch, origin, thickness }) {
    for (const mesh of [...this.object.children]) dispose(mesh);
    const geometry = new BufferGeometry();
    const places = new Float32Array(3 * rows * cols);
    for (let row = 0, at = 0; row < rows; row++)
      for (let col = 0; col < cols; col++, at += 3) {
        places[at] = origin[0] + col * pitch;
        places[at + 1] = origin[1] - row * pitch;
      }
    geometry.setAttribute("position", new BufferAttribute(places, 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * rows * cols), 3));
    this.open = new BufferAttribute(new Float32Array(2 * rows * cols).fill(1), 2);
    geometry.setAttribute("openness", this.open);
    geometry.setIndex(new BufferAttribute(new Uint32Array(6 * (rows - 1) * (cols - 1)), 1));
    this.face = new Mesh(geometry, stone({ open: true }));
    this.face.frustumCulled = false;
    const [x, y] = origin;
    const sides = block([x, y - (rows - 1) * pitch, x + (cols - 1) * pitch, y], thickness);
    this.object.add(this.face, new Mesh(sides, stone()));
    this.dress(this.material);
  }

  /** Write heights, normals and which way each cell is folded. */
  #raise() {
    const { position, normal } = this.face.geometry.attributes;
    const { heights } = this.field;
    for (let at = 0; at < heights.length; at++) position.array[3 * at + 2] = heights[at];
    lean(this.field, normal.array);
    fold(this.field, this.face.geometry.index.array);
    position.needsUpdate = normal.needsUpdate = this.face.geometry.index.needsUpdate = true;
  }
}

/** Normals at nodes, by differences averaged across: a steep wall's steps are no form. */
function lean({ heights, rows, cols, pitch }, normals) {
  for (let row = 0, at = 0; row < rows; row++) {
    const up = row > 0 ? -cols : 0;
    const down = row < rows - 1 ? cols : 0;
    for (let col = 0; col < cols; col++, at++) {
      const left = col > 0 ? -1 : 0;
      const right = col < cols - 1 ? 1 : 0;
      const along = (by) => heights[at + by + right] - heights[at + by + left];
      const across = (by) => heights[at + by + up] - heights[at + by + down];
      const p = (along(up) + 2 * along(0) + along(down)) / (4 * (right - left) * pitch);
      const q = (across(left) + 2 * across(0) + across(right)) / (4 * ((down - up) / cols) * pitch);
      const length = Math.sqrt(p * p + q * q + 1);
      normals[3 * at] = -p / length;
      normals[3 * at + 1] = -q / length;
      normals[3 * at + 2] = 1 / length;
    }
  }
}

/** Two triangles a cell, folded along the diagonal that rises less: walls run on, unbroken. */
function fold({ heights, rows, cols }, index) {
  let at = 0;
  for (let row = 0; row < rows - 1; row++)
    for (let col = 0; col < cols - 1; col++) {
      const a = row * cols + col;
      const [b, c, d] = [a + 1, a + cols, a + cols + 1];
      const other = Math.abs(heights[a] - heights[d]) < Math.abs(heights[b] - heights[c]);
      index[at] = a;
      index[at + 1] = c;
      index[at + 2] = other ? d : b;
      index[at + 3] = other ? a : b;
      index[at + 4] = other ? d : c;
      index[at + 5] = other ? b : d;
      at += 6;
    }
}

/** The sides and the back of a block under the face. */
function block([x0, y0, x1, y1], thickness) {
  const [low, high] = [-thickness, 0];
  const walls = [
    [
      [x0, y0],
      [x1, y0],
      [0, -1, 0],
    ],
    [
      [x1, y0],
      [x1, y1],
      [1, 0, 0],
    ],
    [
      [x1, y1],
      [x0, y1],
      [0, 1, 0],
    ],
    [
      [x0, y1],
      [x0, y0],
      [-1, 0, 0],
    ],
  ];
  const places = [];
  const normals = [];
  for (const [a, b, normal] of walls)
    for (const [[x, y], z] of [
      [a, low],
      [b, low],
      [b, high],
      [a, low],
      [b, high],
      [a, high],
    ]) {
      places.push(x, y, z);
      normals.push(...normal);
    }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  return geometry;
}
