"""Signed distances of simple solids and the ways to join them: negative inside, mm.

Coordinates may be open (broadcastable) grids, so that what depends on X and Y
alone is worked out once a column.  Single precision stays single precision.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Field = NDArray[np.floating]


class Point(NamedTuple):
    """Coordinates of many points, each an array that broadcasts with the others, mm."""

    x: Field
    y: Field
    z: Field


def ellipsoid(p: Point, centre: ArrayLike, radii: ArrayLike) -> Field:
    """Signed distance to an ellipsoid with its axes along the coordinate axes.

    First order: k0 (k0 - 1) / k1 with k0 = |p/r| and k1 = |p/r²|, which is exact
    for a sphere and exact in the limit near any surface.
    """
    cx, cy, cz = np.asarray(centre, float).tolist()
    rx, ry, rz = np.asarray(radii, float).tolist()
    x, y, z = (p.x - cx) / rx, (p.y - cy) / ry, (p.z - cz) / rz
    k0 = np.sqrt(x * x + y * y + z * z)
    k1 = np.sqrt((x / rx) ** 2 + (y / ry) ** 2 + (z / rz) ** 2)
    at_centre = k1 < 1e-6
    inside = -min(rx, ry, rz)
    return np.where(at_centre, inside, k0 * (k0 - 1) / np.where(at_centre, 1, k1))


def cone(p: Point, start: ArrayLike, end: ArrayLike, radii: tuple[float, float]) -> Field:
    """Exact signed distance to the hull of two balls; equal radii make a capsule.

    The nearest of the balls along the axis is the one whose surface normal, leaning
    by k = (ra - rb) / length from the perpendicular, passes through the point.
    """
    a, b = np.asarray(start, float), np.asarray(end, float)
    length = float(np.linalg.norm(b - a))
    ux, uy, uz = ((b - a) / length).tolist()
    ax, ay, az = a.tolist()
    k = (radii[0] - radii[1]) / length
    x, y, z = p.x - ax, p.y - ay, p.z - az
    along = x * ux + y * uy + z * uz
    across = np.sqrt(np.maximum(x * x + y * y + z * z - along * along, 0))
    ball = np.clip(along - across * (k / math.sqrt(1 - k * k)), 0, length)
    return np.hypot(along - ball, across) - (radii[0] - k * ball)


def torus(p: Point, centre: ArrayLike, radius: float, tube: float) -> Field:
    """Exact signed distance to a ring that lies flat, its axis along Z."""
    cx, cy, cz = np.asarray(centre, float).tolist()
    ring = np.hypot(p.x - cx, p.y - cy) - radius
    return np.hypot(ring, p.z - cz) - tube


def disc(p: Point, centre: tuple[float, float], radius: float) -> Field:
    """Exact signed distance to an upright cylinder without ends."""
    return np.hypot(p.x - centre[0], p.y - centre[1]) - radius


class Stroke(NamedTuple):
    """A tapered stroke in the plane, and where points lie along and across it."""

    distance: Field
    along: Field
    across: Field


def stroke(p: Point, path: ArrayLike, radii: ArrayLike) -> Stroke:
    """Signed distance, in X and Y, to a polyline drawn with a pen of changing width.

    Parameters
    ----------
    p : Point
        Z is not used.
    path : (n, 2) array_like
        Corners, mm.
    radii : (n,) array_like
        Half the width at the corners, mm; linear between.

    Returns
    -------
    Stroke
        Distance (first order where the width changes); length along the path, mm,
        from 0; and offset across it in half widths, -1 at the left edge, 1 at the right.
    """
    path, radii = np.asarray(path, float), np.asarray(radii, float)
    shape = np.broadcast_shapes(p.x.shape, p.y.shape)
    kind = np.result_type(p.x)
    best = np.full(shape, np.inf, kind)
    along, across = np.zeros(shape, kind), np.zeros(shape, kind)
    travelled = 0.0
    for (ax, ay), (bx, by), ra, rb in zip(
        path[:-1].tolist(), path[1:].tolist(), radii[:-1].tolist(), radii[1:].tolist(), strict=True
    ):
        length = float(np.hypot(bx - ax, by - ay))
        ux, uy = (bx - ax) / length, (by - ay) / length
        x, y = p.x - ax, p.y - ay
        u, w = x * ux + y * uy, x * uy - y * ux
        t = np.clip(u, 0, length)
        width = ra + (rb - ra) / length * t
        distance = np.hypot(u - t, w) - width
        nearer = distance < best
        best = np.where(nearer, distance, best)
        along = np.where(nearer, travelled + u, along)
        across = np.where(nearer, w / width, across)
        travelled += length
    return Stroke(best, along, across)


def union(a: Field, b: Field, blend: float = 0.0) -> Field:
    """Join two solids; a blend rounds the seam over that many mm.

    Cubic blend: within `blend` of each other the two sink by up to blend / 6 below
    the lesser, beyond it nothing changes.
    """
    if blend <= 0:
        return np.minimum(a, b)
    h = np.maximum(blend - np.abs(a - b), 0) / blend
    return np.minimum(a, b) - h * h * h * (blend / 6)


def common(a: Field, b: Field, blend: float = 0.0) -> Field:
    """Keep what two solids share; a blend rounds the edge over that many mm."""
    return -union(-a, -b, blend)


def groove(solid: Field, tool: Field, depth: float, blend: float = 0.0) -> Field:
    """Cut a solid where it meets a tool, no deeper than `depth` below its surface."""
    return common(solid, union(-tool, solid + depth), blend)


def bezier(points: ArrayLike, t: ArrayLike) -> NDArray[np.float64]:
    """Points of a Bézier curve by de Casteljau's rule.

    Parameters
    ----------
    points : (n, d) array_like
        Control points.
    t : (m,) array_like
        0 at the start, 1 at the end.

    Returns
    -------
    ndarray (m, d)
    """
    t = np.asarray(t, float)[:, None]
    level = [np.broadcast_to(q, (len(t), len(q))) for q in np.asarray(points, float)]
    while len(level) > 1:
        level = [a * (1 - t) + b * t for a, b in pairwise(level)]
    return level[0]
