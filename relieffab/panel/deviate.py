"""How far triangles are from a relief, at every point of them."""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SLACK = 1e-9  # pixels by which a node may lie outside a triangle and count
THIN = 1e-12  # twice the area in plan, pixels², below which a triangle is upright


@kernel
def _height(heights, x, y):  # type: ignore[no-untyped-def]
    """Height of the relief at column x, row y; its pixels' diagonals go from [i, j] on."""
    i, j = max(min(int(y), len(heights) - 2), 0), max(min(int(x), heights.shape[1] - 2), 0)
    u, v = x - j, y - i
    a, d = heights[i, j], heights[i + 1, j + 1]
    if u > v:
        b = heights[i, j + 1]
        return a + u * (b - a) + v * (d - b)
    c = heights[i + 1, j]
    return a + v * (c - a) + u * (d - c)


@kernel
def _over(heights, x, y, margin):  # type: ignore[no-untyped-def]
    return margin <= x <= heights.shape[1] - 1 - margin and margin <= y <= len(heights) - 1 - margin


@kernel
def _along(heights, p, q, margin):  # type: ignore[no-untyped-def]
    """Largest distance along an edge: at its start, and where it crosses the lattice's."""
    worst = abs(p[2] - _height(heights, p[0], p[1])) if _over(heights, p[0], p[1], margin) else 0.0
    for family in range(3):
        start = p[family] if family < 2 else p[0] - p[1]
        end = q[family] if family < 2 else q[0] - q[1]
        for k in range(np.ceil(min(start, end)), np.floor(max(start, end)) + 1):
            if start != end:
                s = (k - start) / (end - start)
                x, y = p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])
                if _over(heights, x, y, margin):
                    gap = abs(p[2] + s * (q[2] - p[2]) - _height(heights, x, y))
                    worst = max(worst, gap)
    return worst


@kernel
def _inside(heights, a, b, c, margin):  # type: ignore[no-untyped-def]
    """Largest distance at the nodes within a triangle."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    sx = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / area
    sy = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / area
    low, high = min(a[1], b[1], c[1]), max(a[1], b[1], c[1])
    worst = 0.0
    for i in range(
        max(np.ceil(low - SLACK), np.ceil(margin)),
        min(np.floor(high + SLACK), len(heights) - 1 - np.ceil(margin)) + 1,
    ):
        first, last = np.inf, -np.inf
        for p, q in ((a, b), (b, c), (c, a)):
            if min(p[1], q[1]) - SLACK <= i <= max(p[1], q[1]) + SLACK:
                if p[1] == q[1]:
                    first, last = min(first, p[0], q[0]), max(last, p[0], q[0])
                else:
                    s = min(max((i - p[1]) / (q[1] - p[1]), 0.0), 1.0)
                    x = p[0] + s * (q[0] - p[0])
                    first, last = min(first, x), max(last, x)
        start = np.int64(max(np.ceil(first - SLACK), np.ceil(margin)))
        end = np.int64(min(np.floor(last + SLACK), heights.shape[1] - 1 - np.ceil(margin)))
        base = a[2] + sy * (i - a[1]) - sx * a[0]
        for j in range(start, end + 1):
            worst = max(worst, abs(heights[i, j] - base - sx * j))
    return worst


@parallel_kernel
def _deviate(heights, vertices, faces, margin, out):  # type: ignore[no-untyped-def]
    for t in prange(len(faces)):
        a, b, c = vertices[faces[t, 0]], vertices[faces[t, 1]], vertices[faces[t, 2]]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        out[t] = 0.0
        if abs(area) > THIN:
            out[t] = max(
                _along(heights, a, b, margin), _along(heights, b, c, margin),
                _along(heights, c, a, margin), _inside(heights, a, b, c, margin),
            )  # fmt: skip


def deviations(heights: Floats, vertices: Floats, faces: Ints, *, margin: float = 0.0) -> Floats:
    """Measure each triangle's largest vertical distance from a relief, at all its points.

    The difference is linear on each piece of the overlay of triangle and relief, and
    largest at a corner of one: a node of the relief, a corner of the triangle, or a
    crossing of their edges.

    Parameters
    ----------
    heights : (n, m) ndarray
        At nodes, mm.
    vertices : (v, 3) ndarray
        Column, row (nodes have whole numbers) and height, mm; what lies outside
        the lattice is not looked at.
    faces : (f, 3) ndarray of int
    margin : float
        Points nearer to the lattice's border than this are not looked at, pixels.

    Returns
    -------
    (f,) ndarray
        mm; 0 for triangles that stand upright.
    """
    out = np.empty(len(faces))
    _deviate(heights, np.ascontiguousarray(vertices), np.ascontiguousarray(faces), margin, out)
    return out
