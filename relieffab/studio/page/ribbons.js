// Drawn strokes as ribbons of ink, as wide as they are strong.

import { BufferAttribute, BufferGeometry, Mesh, ShaderMaterial, Color, DoubleSide } from "./three.js";

const LEAST = 0.3; // of the width, where a stroke fades out

/** Make the ink; `fade` is how much of it is seen. */
export function ink() {
  return new ShaderMaterial({
    side: DoubleSide,
    transparent: true,
    uniforms: { colour: { value: new Color() }, fade: { value: 1 } },
    vertexShader: `void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: /* glsl */ `
      uniform vec3 colour;
      uniform float fade;
      void main() {
        gl_FragColor = vec4(colour, fade);
        #include <colorspace_fragment>
      }`,
  });
}

/**
 * Lay strokes out as ribbons.
 *
 * @param {{data: Float32Array, shape: number[]}} points  n x 4: x, y, z (mm), strength
 * @param {{data: Uint32Array}} starts  of each stroke, and one past the last
 * @param {number} width  at full strength, mm
 */
export function ribbons(points, starts, width, material) {
  const [count, step] = points.shape;
  const places = new Float32Array(6 * count);
  const index = [];
  for (let stroke = 0; stroke + 1 < starts.data.length; stroke++) {
    const [first, last] = [starts.data[stroke], starts.data[stroke + 1] - 1];
    for (let at = first; at <= last; at++) {
      widen(points.data, step, [Math.max(first, at - 1), at, Math.min(last, at + 1)], width / 2, places);
      if (at < last) index.push(2 * at, 2 * at + 1, 2 * at + 2, 2 * at + 2, 2 * at + 1, 2 * at + 3);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  geometry.setIndex(index);
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

/** Set two points aside a stroke's point, across the way from its neighbours. */
function widen(data, step, [before, at, after], half, places) {
  const dx = data[after * step] - data[before * step];
  const dy = data[after * step + 1] - data[before * step + 1];
  const strength = step > 3 ? LEAST + (1 - LEAST) * data[at * step + 3] : 1;
  const across = (half * strength) / (Math.hypot(dx, dy) || 1);
  const z = step > 2 ? data[at * step + 2] : 0;
  const [x, y] = [data[at * step], data[at * step + 1]];
  places.set([x - dy * across, y + dx * across, z, x + dy * across, y - dx * across, z], 6 * at);
}
