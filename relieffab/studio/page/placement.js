// How a model sits on the panel, as relieffab.layers.view places it.

import { Matrix4 } from "./three.js";
import { pair, quantity } from "./quantity.js";

const RADIANS = Math.PI / 180;

export const VIEWS = {
  front: [0, 0],
  right: [90, 0],
  back: [180, 0],
  left: [-90, 0],
  top: [0, 90],
  bottom: [0, -90],
};

/** Read the view's angles, degrees, from settings as typed. */
export function anglesOf(settings) {
  const [azimuth, elevation] = VIEWS[settings.view] ?? VIEWS.front;
  return {
    azimuth: quantity(settings.azimuth, "deg") ?? azimuth,
    elevation: quantity(settings.elevation, "deg") ?? elevation,
    roll: quantity(settings.roll, "deg") ?? 0,
    perspective: quantity(settings.perspective, "deg") ?? 0,
  };
}

/** Read the panel's size and the border that stays free, mm; null if they cannot be read. */
export function roomOf(settings) {
  const size = pair(settings.size);
  const margin = quantity(settings.margin, "mm");
  const frame = settings.frame ? quantity(settings.frame, "mm") : 0;
  if (size === null || margin === null || frame === null) return null;
  return { size, margin: margin + frame };
}

/** Rows are the panel's X, Y and Z (to the viewer) in model axes. */
export function rotationOf({ azimuth, elevation, roll }, up) {
  const [a, e, r] = [azimuth, elevation, roll].map((angle) => angle * RADIANS);
  const right = [Math.cos(a), Math.sin(a), 0];
  const toward = [Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e)];
  const upward = [
    toward[1] * right[2] - toward[2] * right[1],
    toward[2] * right[0] - toward[0] * right[2],
    toward[0] * right[1] - toward[1] * right[0],
  ];
  const [c, s] = [Math.cos(r), Math.sin(r)];
  const rows = [
    right.map((x, i) => c * x - s * upward[i]),
    right.map((x, i) => s * x + c * upward[i]),
    toward,
  ];
  return up === "y" ? rows.map(([x, y, z]) => [x, z, -y]) : rows;
}

/**
 * Fit a model, seen from a view, into the panel.
 *
 * @param {Float32Array} points  of the model, x, y, z after each other
 * @param {object} angles  azimuth, elevation, roll and perspective, degrees
 * @param {string} up  the model's axis that points up, y or z
 * @param {{size: number[], margin: number}} room  mm
 * @returns {Matrix4} from model units to the panel, mm
 */
export function placement(points, angles, up, { size, margin }) {
  const rows = rotationOf(angles, up);
  const [low, high] = bounds(points, rows);
  const foot = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[2]];
  const nearness = angles.perspective > 0 ? nearnessOf(points, rows, foot, angles.perspective) : 0;
  const [seenLow, seenHigh] = bounds(points, rows, foot, nearness);
  const free = size.map((side) => side - 2 * margin);
  const scale = Math.min(...[0, 1].map((axis) => free[axis] / (seenHigh[axis] - seenLow[axis])));
  const [x, y] = [0, 1].map((axis) => size[axis] / 2 - (scale * (seenLow[axis] + seenHigh[axis])) / 2);
  const linear = rows.flatMap((row, axis) => [
    ...row.map((value) => scale * value),
    [x, y, 0][axis] - scale * foot[axis],
  ]);
  const matrix = new Matrix4().set(...linear, 0, 0, 0, 1);
  return eye(x, y, nearness / scale).multiply(matrix);
}

/** From a model's true shape to what is seen from above a point, 1 / nearness high. */
function eye(x, y, nearness) {
  return new Matrix4().set(1, 0, -nearness * x, 0, 0, 1, -nearness * y, 0, 0, 0, 1, 0, 0, 0, -nearness, 1);
}

/** Bounds of points, turned, moved so that `foot` is the origin, and bent by the eye. */
function bounds(points, [r0, r1, r2], foot = [0, 0, 0], nearness = 0) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let at = 0; at < points.length; at += 3) {
    const [a, b, c] = [points[at], points[at + 1], points[at + 2]];
    const z = r2[0] * a + r2[1] * b + r2[2] * c - foot[2];
    const bend = 1 / (1 - nearness * z);
    const x = (r0[0] * a + r0[1] * b + r0[2] * c - foot[0]) * bend;
    const y = (r1[0] * a + r1[1] * b + r1[2] * c - foot[1]) * bend;
    if (x < low[0]) low[0] = x;
    if (x > high[0]) high[0] = x;
    if (y < low[1]) low[1] = y;
    if (y > high[1]) high[1] = y;
    if (z < low[2]) low[2] = z;
    if (z > high[2]) high[2] = z;
  }
  return [low, high];
}

/** 1 over the eye's height, from which the model's sphere spans the angle of view. */
function nearnessOf(points, rows, foot, angle) {
  const middle = bounds(points, rows, foot)[0][2] / 2;
  let radius = 0;
  for (let at = 0; at < points.length; at += 3) {
    const [x, y, z] = rows.map(
      (row, axis) => row[0] * points[at] + row[1] * points[at + 1] + row[2] * points[at + 2] - foot[axis],
    );
    radius = Math.max(radius, Math.hypot(x, y, z - middle));
  }
  const half = Math.sin((angle * RADIANS) / 2);
  return half / (radius + half * middle);
}
