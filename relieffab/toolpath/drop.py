"""Compiled drop-cutter: how low a cutter may stand on a triangulated height field.

A cutter's profile is convex and a triangle is flat, so the gap between them is
convex on every vertex, edge and facet: each has one first contact in closed form
(by iteration for an arc off the axis, as a bull nose has, along an edge).  Contact cases after
Chuang, Chen, Yau, "A reverse engineering approach to generating interference-free
tool paths in three-axis machining", Int J Adv Manuf Technol 19 (2002), written
anew for outlines of lines and arcs.

Inside, lengths are in mm from node [0, 0], x along columns and y along rows.
"""

from math import inf, sqrt

import numpy as np

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.toolpath.outline import (
    ARC,
    MID,
    R0,
    R1,
    height_at,
    radius_at,
    slope_at,
    touch,
)

BLOCK = 8
CHUNK = 512
_STEPS = 60
_INSIDE = 1e-9


@kernel
def _bull_excess(way, square, slope, flat, arc):  # type: ignore[no-untyped-def]
    """Sign of how much steeper a bull nose's arc is than the line, `way` from the foot."""
    r = sqrt(square + way * way)
    across = r - flat
    return across * way - slope * r * sqrt(max(arc * arc - across * across, 0.0))


@kernel
def _bull_reach(square, slope, flat, arc, low, high):  # type: ignore[no-untyped-def]
    """Where between `low` and `high` a line of a given slope touches a bull nose's arc.

    False position, the Illinois variant.
    """
    above = _bull_excess(high, square, slope, flat, arc)
    if above <= 0.0:
        return high
    below = _bull_excess(low, square, slope, flat, arc)
    if below >= 0.0:
        return low
    side, way = 0, low
    for _ in range(_STEPS):
        last = way
        way = (low * above - high * below) / (above - below)
        excess = _bull_excess(way, square, slope, flat, arc)
        if excess == 0.0 or abs(way - last) < 1e-9:
            break
        if excess < 0.0:
            low, below = way, excess
            if side < 0:
                above *= 0.5
            side = -1
        else:
            high, above = way, excess
            if side > 0:
                below *= 0.5
            side = 1
    return way


@kernel
def _reach_on_edge(outline, distance, slope, end):  # type: ignore[no-untyped-def]
    """Where a line of a given slope, passing the axis at a distance, touches first.

    Returns the way along the line from its foot to the contact, uphill
    (slope >= 0), exact up to `end`, where the edge ends.
    """
    if slope == 0.0:
        return 0.0
    square = distance * distance
    for k in range(len(outline)):
        last = outline[k, R1]
        if last <= distance:
            continue
        high = sqrt(last * last - square)
        steep = slope_at(outline, k, last)
        if steep * high < slope * last:
            continue
        first, arc, mid = outline[k, R0], outline[k, ARC], outline[k, MID]
        low = sqrt(first * first - square) if first > distance else 0.0
        if low >= end or (low > 0.0 and slope_at(outline, k, first) * low >= slope * first):
            return low
        if arc == 0.0:
            way = slope * distance / sqrt(max(steep * steep - slope * slope, 1e-300))
        elif mid == 0.0:
            way = slope * sqrt(max(arc * arc - square, 0.0) / (1.0 + slope * slope))
        else:
            way = _bull_reach(square, slope, mid, arc, low, min(high, end))
        return min(max(way, low), high)
    radius = outline[-1, R1]
    return sqrt(max(radius * radius - square, 0.0))


@kernel
def drop_on_edge(best, ax, ay, az, bx, by, bz, outline):  # type: ignore[no-untyped-def]
    """Tip height at which the cutter on the origin's axis rests on the edge a-b, or `best`."""
    if az > bz:
        ax, ay, az, bx, by, bz = bx, by, bz, ax, ay, az
    radius = outline[-1, R1]
    dx, dy = bx - ax, by - ay
    length = sqrt(dx * dx + dy * dy)
    tx, ty = dx / length, dy / length
    distance = abs(ax * ty - ay * tx)
    if distance > radius:
        return best
    start = ax * tx + ay * ty
    end = start + length
    slope = (bz - az) / length
    far = sqrt(radius * radius - distance * distance)
    if start > far or end < -far:
        return best
    foot = min(max(0.0, start), end)
    near = min(sqrt(distance * distance + foot * foot), radius)
    highest = az + slope * (min(end, far) - start)
    if highest - height_at(outline, near) <= best:
        return best
    way = _reach_on_edge(outline, distance, slope, end)
    way = min(max(way, start), end)
    r = min(sqrt(distance * distance + way * way), radius)
    height = az + slope * (way - start)
    return max(best, height - height_at(outline, r))


@kernel
def _drop_on_cell(  # type: ignore[no-untyped-def]
    best, heights, i, j, cx, cy, pitch, outline
):
    """Tip height at which the cutter at (cx, cy) rests on cell (i, j), or `best`.

    Its two facets, their diagonal, and its upper and left edge: the other two
    belong to the neighbours.  On its plane without end a facet could hold the cutter
    no lower; nor could its edges, which lie on that plane.
    """
    x0, y0 = j * pitch - cx, i * pitch - cy
    x1, y1 = x0 + pitch, y0 + pitch
    a, b = heights[i, j], heights[i, j + 1]
    c, d = heights[i + 1, j], heights[i + 1, j + 1]
    both, before = 0, best
    for side in range(2):
        gx = (d - c) / pitch if side == 0 else (b - a) / pitch
        gy = (c - a) / pitch if side == 0 else (d - b) / pitch
        slope = sqrt(gx * gx + gy * gy)
        px, py, fall = 0.0, 0.0, 0.0
        if slope > 0.0:
            r = touch(outline, slope)
            px, py, fall = r * gx / slope, r * gy / slope, height_at(outline, r)
        contact = a + gx * (px - x0) + gy * (py - y0) - fall
        if contact <= before:
            continue
        both += 1
        u, v = (py - y0) / pitch, (px - x0) / pitch
        above = u - v if side == 0 else v - u
        if above >= -_INSIDE and min(u, v) >= -_INSIDE and max(u, v) <= 1.0 + _INSIDE:
            best = max(best, contact)
        elif side == 0:
            best = drop_on_edge(best, x0, y0, a, x0, y1, c, outline)
        else:
            best = drop_on_edge(best, x0, y0, a, x1, y0, b, outline)
    if both == 2:
        best = drop_on_edge(best, x0, y0, a, x1, y1, d, outline)
    return best


@kernel
def _drop_point(  # type: ignore[no-untyped-def]  # noqa: PLR0912
    heights, cell_top, block_top, top, pitch, cx, cy, hint_i, hint_j, outline
):
    """Tip height at one point, and the cell it rests on (the next point's hint)."""
    radius = outline[-1, R1]
    rows, cols = cell_top.shape
    width, height = cols * pitch, rows * pitch
    border = min(cx, width - cx, cy, height - cy)
    if border <= 0.0:
        return 0.0, hint_i, hint_j
    best = -inf
    if border <= radius:
        best = -height_at(outline, border)
    wi, wj = hint_i, hint_j
    home_i, home_j = min(int(cy / pitch), rows - 1), min(int(cx / pitch), cols - 1)
    for i, j in ((hint_i, hint_j), (home_i, home_j)):
        if i >= 0:
            rest = _drop_on_cell(best, heights, i, j, cx, cy, pitch, outline)
            if rest > best:
                best, wi, wj = rest, i, j
    reach = radius
    if best > -inf:
        reach = radius_at(outline, top - best)
    low_i, high_i = max(int((cy - reach) / pitch) - 1, 0), min(int((cy + reach) / pitch), rows - 1)
    low_j, high_j = max(int((cx - reach) / pitch) - 1, 0), min(int((cx + reach) / pitch), cols - 1)
    limit = radius * radius * (1.0 + 1e-12)
    for block_i in range(low_i // BLOCK, high_i // BLOCK + 1):
        i0, i1 = max(block_i * BLOCK, low_i), min(block_i * BLOCK + BLOCK - 1, high_i)
        dy = max(i0 * pitch - cy, cy - (i1 + 1) * pitch, 0.0)
        for block_j in range(low_j // BLOCK, high_j // BLOCK + 1):
            block = block_top[block_i, block_j]
            if block <= best:
                continue
            j0, j1 = max(block_j * BLOCK, low_j), min(block_j * BLOCK + BLOCK - 1, high_j)
            dx = max(j0 * pitch - cx, cx - (j1 + 1) * pitch, 0.0)
            square = dx * dx + dy * dy
            if square > limit:
                continue
            near = height_at(outline, sqrt(square))
            if block - near <= best:
                continue
            for i in range(i0, i1 + 1):
                ey = max(i * pitch - cy, cy - (i + 1) * pitch, 0.0)
                for j in range(j0, j1 + 1):
                    cell = cell_top[i, j]
                    if cell <= best:
                        continue
                    ex = max(j * pitch - cx, cx - (j + 1) * pitch, 0.0)
                    square = ex * ex + ey * ey
                    if square > limit:
                        continue
                    near = height_at(outline, sqrt(square))
                    if cell - near <= best:
                        continue
                    rest = _drop_on_cell(best, heights, i, j, cx, cy, pitch, outline)
                    if rest > best:
                        best, wi, wj = rest, i, j
    return best, wi, wj


@parallel_kernel
def drop_points(heights, cell_top, block_top, top, pitch, x, y, outline, out):  # type: ignore[no-untyped-def]
    """Fill `out` with the tip heights at points (x, y), mm from node [0, 0]."""
    for chunk in prange((x.size + CHUNK - 1) // CHUNK):
        i, j = -1, -1
        for k in range(chunk * CHUNK, min((chunk + 1) * CHUNK, x.size)):
            out[k], i, j = _drop_point(
                heights, cell_top, block_top, top, pitch, x[k], y[k], i, j, outline
            )


def tops(heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Highest corner of every cell, and of every block of BLOCK x BLOCK cells."""
    rows = np.maximum(heights[:-1], heights[1:])
    cell = np.maximum(rows[:, :-1], rows[:, 1:])
    whole = [-(-n // BLOCK) for n in cell.shape]
    padded = np.full([n * BLOCK for n in whole], -np.inf)
    padded[: cell.shape[0], : cell.shape[1]] = cell
    block = padded.reshape(whole[0], BLOCK, whole[1], BLOCK).max(axis=(1, 3))
    return cell, np.ascontiguousarray(block)
