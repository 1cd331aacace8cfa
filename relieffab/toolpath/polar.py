"""Drop-cutter on a round stock: the cutter stands square on the axis, the stock turns.

Seen by a cutter at the angle a, a node at the angle a + p and the radius r stands r sin p
beside it and r cos p above the axis: at depth, walls come nearer to the tip than on the
flat panel, and what is beside the cutter falls away.  The triangles between nodes are
taken as flat in that picture, where each contact is exact; by how much they are lower
than the bent surface is added to the distance the cutter keeps.

Inside, lengths are in mm from node [0, 0], x along columns, which is along the axis, and
y along rows, round the face.
"""

from math import asin, cos, hypot, inf, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.toolpath.drop import drop_on_edge
from relieffab.toolpath.outline import R1, height_at, radius_at, touch

Floats = NDArray[np.float64]

CHUNK = 512
SEAM = 1e-6  # mm by which the last row may miss the first, once round
_THIN = 1e-12
_INSIDE = 1e-9
_HIGHER = 1.05  # for terms of higher order


def bend_error(heights: Floats, pitch: float, radius: float) -> float:
    """Bound how far a bent surface rises over flat triangles between its nodes, mm.

    Square to the surface: p² / 8r where it is level, and for a pixel that rises by dh
    the shift along the way round, p dh / 4r, by the share of it that is square to it.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        mm.
    pitch, radius : float
        Of the face, mm.
    """
    rise = float(np.abs(np.diff(heights, axis=0)).max(initial=0.0))
    rise = max(rise, float(np.abs(np.diff(heights, axis=1)).max(initial=0.0)))
    least = radius + float(heights.min())
    return 4 / 3 * _HIGHER * (pitch**2 / 2 + pitch * rise) / (4 * least)


@kernel
def _on_edge(best, ax, ay, az, bx, by, bz, outline):  # type: ignore[no-untyped-def]
    """`drop_on_edge`, for an edge that may stand upright, too."""
    if hypot(bx - ax, by - ay) > _THIN:
        return drop_on_edge(best, ax, ay, az, bx, by, bz, outline)
    away = hypot(ax, ay)
    if away > outline[-1, R1]:
        return best
    return max(best, max(az, bz) - height_at(outline, away))


@kernel
def _on_facet(best, a, b, c, outline):  # type: ignore[no-untyped-def]
    """Tip height at which the cutter on the origin's axis rests within a triangle, or `best`."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    if abs(area) < _THIN:
        return best
    gx = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / area
    gy = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / area
    slope = hypot(gx, gy)
    px, py, fall = 0.0, 0.0, 0.0
    if slope > 0.0:
        r = touch(outline, slope)
        px, py, fall = r * gx / slope, r * gy / slope, height_at(outline, r)
    contact = a[2] + gx * (px - a[0]) + gy * (py - a[1]) - fall
    if contact <= best:
        return best
    u = ((px - a[0]) * (c[1] - a[1]) - (py - a[1]) * (c[0] - a[0])) / area
    v = ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / area
    inside = u >= -_INSIDE and v >= -_INSIDE and u + v <= 1.0 + _INSIDE
    return contact if inside else best


@kernel
def _on_cell(best, heights, i, j, x0, pitch, radius, turn, outline):  # type: ignore[no-untyped-def]
    """Tip height at which the cutter rests on cell (i, j), whose left is at `x0`, or `best`.

    `turn` holds the sines and cosines of its upper and its lower row.
    """
    x1 = x0 + pitch
    s0, c0, s1, c1 = turn
    ra, rb = radius + heights[i, j], radius + heights[i, j + 1]
    rc, rd = radius + heights[i + 1, j], radius + heights[i + 1, j + 1]
    a, b = (x0, ra * s0, ra * c0 - radius), (x1, rb * s0, rb * c0 - radius)
    c, d = (x0, rc * s1, rc * c1 - radius), (x1, rd * s1, rd * c1 - radius)
    best = _on_facet(best, a, c, d, outline)
    best = _on_facet(best, a, d, b, outline)
    for p, q in ((a, d), (a, b), (a, c), (b, d), (c, d)):
        best = _on_edge(best, p[0], p[1], p[2], q[0], q[1], q[2], outline)
    return best


@kernel
def _turned_row(i, cy, low, pitch, radius):  # type: ignore[no-untyped-def]
    """Give a row's turn from the cutter at cy, how near it comes, and its largest cosine."""
    p0, p1 = (i * pitch - cy) / radius, ((i + 1) * pitch - cy) / radius
    turn = (sin(p0), cos(p0), sin(p1), cos(p1))
    if p0 <= 0.0 <= p1:
        return turn, 0.0, 1.0
    return turn, (radius + low) * min(abs(turn[0]), abs(turn[2])), max(turn[1], turn[3])


@kernel
def _bound(best, top, keeps, x0, dy, pitch, radius, outline):  # type: ignore[no-untyped-def]
    """Tip height that a cell cannot ask more of; -inf where the cutter does not reach it."""
    rise = (radius + top) * keeps - radius
    if rise <= best:
        return -inf
    dx = max(x0, -x0 - pitch, 0.0)
    away = sqrt(dx * dx + dy * dy)
    return rise - height_at(outline, away) if away <= outline[-1, R1] else -inf


@kernel
def _on_rows(best, heights, cell_top, cx, cy, low, pitch, radius, outline):  # type: ignore[no-untyped-def]
    """Tip height at which the cutter at (cx, cy) rests on any cell, or `best`."""
    rows, cols = cell_top.shape
    least = radius + low
    # Nothing stands above the face: further out the cutter is higher than that.
    reach = outline[-1, R1] if best == -inf else radius_at(outline, max(-best, 0.0))
    wide = 0.5 * pi if reach >= least else asin(reach / least)
    first = max(int(np.floor((cy - wide * radius) / pitch)), 0)
    last = min(int(np.floor((cy + wide * radius) / pitch)), rows - 1)
    left, right = max(int((cx - reach) / pitch) - 1, 0), min(int((cx + reach) / pitch), cols - 1)
    # The cell that may ask the most comes first: after it most others need no look.
    most, at = best, (-1, -1)
    for i in range(first, last + 1):
        _, dy, keeps = _turned_row(i, cy, low, pitch, radius)
        for j in range(left, right + 1):
            x0 = j * pitch - cx
            bound = _bound(most, cell_top[i, j], keeps, x0, dy, pitch, radius, outline)
            if bound > most:
                most, at = bound, (i, j)
    if at[0] < 0:
        return best
    turn, _, _ = _turned_row(at[0], cy, low, pitch, radius)
    best = _on_cell(best, heights, at[0], at[1], at[1] * pitch - cx, pitch, radius, turn, outline)
    for i in range(first, last + 1):
        turn, dy, keeps = _turned_row(i, cy, low, pitch, radius)
        for j in range(left, right + 1):
            x0 = j * pitch - cx
            bound = _bound(best, cell_top[i, j], keeps, x0, dy, pitch, radius, outline)
            if bound > best:
                best = _on_cell(best, heights, i, j, x0, pitch, radius, turn, outline)
    return best


@kernel
def _drop(heights, cell_top, cx, cy, low, pitch, radius, outline):  # type: ignore[no-untyped-def]
    """Tip height at one point; beyond the grid the face goes on."""
    rows, cols = cell_top.shape
    around = 2.0 * pi * radius
    once = rows * pitch > around - SEAM
    reach = outline[-1, R1]
    border = min(cx, cols * pitch - cx)
    if not once:
        side = min(cy, rows * pitch - cy)
        border = min(border, radius * sin(min(side / radius, 0.5 * pi)) if side > 0.0 else side)
    best = 0.0 if border <= 0.0 else -height_at(outline, border) if border <= reach else -inf
    # The cell below comes first: most others then need no look.
    i, j = int(np.floor(cy / pitch)), int(np.floor(cx / pitch))
    if 0 <= i < rows and 0 <= j < cols:
        p0, p1 = (i * pitch - cy) / radius, ((i + 1) * pitch - cy) / radius
        turn = (sin(p0), cos(p0), sin(p1), cos(p1))
        best = _on_cell(best, heights, i, j, j * pitch - cx, pitch, radius, turn, outline)
    for turns in range(-1, 2):
        y = cy + turns * around
        best = _on_rows(best, heights, cell_top, cx, y, low, pitch, radius, outline)
    return best


@parallel_kernel
def drop_round(heights, cell_top, low, pitch, radius, x, y, outline, out):  # type: ignore[no-untyped-def]
    """Fill `out` with the tip heights at points (x, y), mm from node [0, 0].

    `low` is the least of the heights.  Rows that go once round join.
    """
    for chunk in prange((x.size + CHUNK - 1) // CHUNK):
        for k in range(chunk * CHUNK, min((chunk + 1) * CHUNK, x.size)):
            out[k] = _drop(heights, cell_top, x[k], y[k], low, pitch, radius, outline)
