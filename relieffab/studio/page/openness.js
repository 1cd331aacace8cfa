// How open each node of a height field lies to the light and to the sky, as
// relieffab.picture.stone works it out: by the horizon, one way after another.

const LEAST = 0.15; // tangents of lower horizons do not matter, and bound the search
const HALF = (3 * Math.PI) / 180; // of the sun's disc: it softens a shadow's edge

/** Whole-node steps one way, ever farther: [index offset, rows, columns, 1 / length]. */
function offsets([x, y], reach, growth, cols) {
  const steps = new Map();
  for (let far = 1; far <= Math.max(reach, 1); far = Math.max(far + 1, far * growth)) {
    const row = Math.round(-y * far);
    const col = Math.round(x * far);
    if (row || col) steps.set(`${row} ${col}`, [row * cols + col, row, col, 1 / Math.hypot(row, col)]);
  }
  return [...steps.values()];
}

/** Tangent of the horizon's elevation from every node below the face, one way. */
function horizon(field, way, { growth = 1, least = LEAST, each }) {
  const { heights, rows, cols, pitch, lowest, highest } = field;
  const steps = offsets(way, (highest - lowest) / (least * pitch), growth, cols);
  for (let row = 0, at = 0; row < rows; row++) {
    for (let col = 0; col < cols; col++, at++) {
      const here = heights[at];
      if (here >= highest - 1e-6) continue;
      let tangent = 0;
      for (const [offset, dr, dc, nearness] of steps) {
        const r = row + dr;
        const c = col + dc;
        if (r < 0 || r >= rows || c < 0 || c >= cols) break;
        const rise = (heights[at + offset] - here) * nearness;
        if (rise > tangent) tangent = rise;
      }
      each(at, tangent / pitch);
    }
  }
}

/** Share of a small sun that each node sees, into every second place of `open`. */
export function openToLight(field, light, open) {
  for (let at = 0; at < open.length; at += 2) open[at] = 1;
  const flat = Math.hypot(light.x, light.y);
  if (flat < 1e-6) return;
  const elevation = Math.atan2(light.z, flat);
  const least = Math.max(0.1, Math.tan(elevation - HALF));
  horizon(field, [light.x / flat, light.y / flat], {
    least,
    each: (at, tangent) => {
      const seen = (elevation + HALF - Math.atan(tangent)) / (2 * HALF);
      open[2 * at] = Math.min(1, Math.max(0, seen));
    },
  });
  soften(field, open);
}

/** Average each node's light with its neighbours': 1/4 1/2 1/4, both ways. */
function soften({ rows, cols }, open) {
  const before = new Float32Array(rows * cols);
  for (const [step, side] of [
    [1, cols],
    [cols, rows],
  ]) {
    for (let at = 0; at < before.length; at++) before[at] = open[2 * at];
    for (let at = 0; at < before.length; at++) {
      const place = step === 1 ? at % cols : Math.floor(at / cols);
      if (place === 0 || place === side - 1) continue;
      open[2 * at] = (before[at - step] + 2 * before[at] + before[at + step]) / 4;
    }
  }
}

/** Share of an even sky that each node sees, into every other place of `open`. */
export function openToSky(field, open, ways = 8) {
  for (let at = 1; at < open.length; at += 2) open[at] = 1;
  for (let way = 0; way < ways; way++) {
    const angle = (2 * Math.PI * (way + 0.5)) / ways;
    horizon(field, [Math.cos(angle), Math.sin(angle)], {
      growth: 1.4,
      each: (at, tangent) => {
        open[2 * at + 1] -= (1 - 1 / (1 + tangent * tangent)) / ways;
      },
    });
  }
}

/** A height field with its extremes: heights (mm) row by row, row 0 the far edge. */
export function fieldOf(heights, [rows, cols], pitch) {
  let lowest = 0;
  let highest = -Infinity;
  for (const height of heights) {
    if (height < lowest) lowest = height;
    if (height > highest) highest = height;
  }
  return { heights, rows, cols, pitch, lowest, highest };
}
