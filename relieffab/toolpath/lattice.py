"""Compiled cutter-location surface over rows of places, at any angle.

Not every place looks for what the cutter would touch there: every facet, edge and
vertex of the surface looks for the places from which it would be touched.  A plane
of slope s touches a cutter at one distance from its axis, so a facet's places are the
facet moved by that much; those of an edge or a vertex lie between those of the facets
around it, since a cutter and a surface that touch without crossing have a slope in
common there (separation of convex sets: Rockafellar, "Convex Analysis", 1970,
section 11).  A piece is asked about a few places too many, never about too few, and
the largest answer is the height.

Inside, lengths are in mm from the first place; x along a row of places, y across.
"""

from math import ceil, floor, inf, sqrt

import numpy as np

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.toolpath.drop import drop_on_edge
from relieffab.toolpath.outline import R1, height_at, touch, touch_last

_INSIDE = 1e-7
_LEVEL = 1e-12
_SLACK = 1e-9


@kernel
def _facets(heights, i, low, high, pitch, frame, outline, out):  # type: ignore[no-untyped-def]
    """Fill out[side, j]: slope along x and y, way to the contact, height at the first place."""
    cos, sin, ox, oy = frame[0], frame[1], frame[2], frame[3]
    for j in range(low, high):
        a, b, c, d = heights[i, j], heights[i, j + 1], heights[i + 1, j], heights[i + 1, j + 1]
        px, py = j * pitch - ox, i * pitch - oy
        x, y = px * cos + py * sin, py * cos - px * sin
        for side in range(2):
            gx = (d - c) / pitch if side == 0 else (b - a) / pitch
            gy = (c - a) / pitch if side == 0 else (d - b) / pitch
            tx, ty = gx * cos + gy * sin, gy * cos - gx * sin
            slope = sqrt(gx * gx + gy * gy)
            wx, wy, fall = 0.0, 0.0, 0.0
            if slope > 0.0:
                r = touch(outline, slope)
                wx, wy, fall = r * tx / slope, r * ty / slope, height_at(outline, r)
            out[side, j, 0], out[side, j, 1], out[side, j, 2], out[side, j, 3] = tx, ty, wx, wy
            out[side, j, 4] = a + tx * (wx - x) + ty * (wy - y) - fall


@kernel
def _reach(outline, x0, x1, y0, y1, least, most):  # type: ignore[no-untyped-def]
    """Box of the ways to the contact for slopes in a box, their size from least to most."""
    far = touch_last(outline, most)
    near = touch(outline, least) / most if most > 0.0 else 0.0
    wide = far / least if least > _LEVEL else 1e30
    return (
        max(min(x0 * near, x0 * wide), -far), min(max(x1 * near, x1 * wide), far),
        max(min(y0 * near, y0 * wide), -far), min(max(y1 * near, y1 * wide), far),
    )  # fmt: skip


@kernel
def _raise_by_facet(out, lines, facet, side, i, j, x, y, pitch, frame):  # type: ignore[no-untyped-def]
    cos, sin, ox, oy, step, over = frame
    wx, wy = facet[2], facet[3]
    px, py = pitch * cos, pitch * sin
    # From its first corner the facet spans the diagonal and one side of its pixel.
    ex, ey = (py, px) if side == 0 else (px, -py)
    dx, dy = px + py, px - py
    x, y = x - wx, y - wy
    first = max(ceil((y + min(0.0, ey, dy)) / over - _SLACK), lines[0])
    last = min(floor((y + max(0.0, ey, dy)) / over + _SLACK), lines[1] - 1)
    left = max(ceil((x + min(0.0, ex, dx)) / step - _SLACK), 0)
    right = min(floor((x + max(0.0, ex, dx)) / step + _SLACK), out.shape[1] - 1)
    for k in range(first, last + 1):
        for m in range(left, right + 1):
            cx, cy = m * step + wx, k * over + wy
            v = (cx * cos - cy * sin + ox) / pitch - j
            u = (cx * sin + cy * cos + oy) / pitch - i
            above = u - v if side == 0 else v - u
            if above >= -_INSIDE and min(u, v) >= -_INSIDE and max(u, v) <= 1.0 + _INSIDE:
                z = facet[4] + facet[0] * m * step + facet[1] * k * over
                out[k, m] = max(out[k, m], z)


@kernel
def _raise_by_edge(out, lines, one, other, ax, ay, az, bx, by, bz, step, over, outline):  # type: ignore[no-untyped-def]
    gx, gy, hx, hy = one[0], one[1], other[0], other[1]
    dx, dy = hx - gx, hy - gy
    share = -(gx * dx + gy * dy) / (dx * dx + dy * dy)
    share = min(max(share, 0.0), 1.0)
    least = sqrt((gx + share * dx) ** 2 + (gy + share * dy) ** 2)
    most = sqrt(max(gx * gx + gy * gy, hx * hx + hy * hy))
    x0, x1, y0, y1 = _reach(
        outline, min(gx, hx), max(gx, hx), min(gy, hy), max(gy, hy), least, most
    )
    first = max(ceil((min(ay, by) - y1) / over - _SLACK), lines[0])
    last = min(floor((max(ay, by) - y0) / over + _SLACK), lines[1] - 1)
    left = max(ceil((min(ax, bx) - x1) / step - _SLACK), 0)
    right = min(floor((max(ax, bx) - x0) / step + _SLACK), out.shape[1] - 1)
    for k in range(first, last + 1):
        cy = k * over
        for m in range(left, right + 1):
            cx = m * step
            out[k, m] = drop_on_edge(out[k, m], ax - cx, ay - cy, az, bx - cx, by - cy, bz, outline)


@kernel
def _raise_by_vertex(out, lines, six, x, y, z, step, over, outline):  # type: ignore[no-untyped-def]
    gx0, gx1, gy0, gy1, most = inf, -inf, inf, -inf, 0.0
    for n in range(6):
        gx, gy = six[n, 0], six[n, 1]
        gx0, gx1, gy0, gy1 = min(gx0, gx), max(gx1, gx), min(gy0, gy), max(gy1, gy)
        most = max(most, gx * gx + gy * gy)
    nx, ny = max(gx0, -gx1, 0.0), max(gy0, -gy1, 0.0)
    x0, x1, y0, y1 = _reach(outline, gx0, gx1, gy0, gy1, sqrt(nx * nx + ny * ny), sqrt(most))
    radius = outline[-1, R1]
    first = max(ceil((y - y1) / over - _SLACK), lines[0])
    last = min(floor((y - y0) / over + _SLACK), lines[1] - 1)
    left = max(ceil((x - x1) / step - _SLACK), 0)
    right = min(floor((x - x0) / step + _SLACK), out.shape[1] - 1)
    for k in range(first, last + 1):
        dy = k * over - y
        for m in range(left, right + 1):
            dx = m * step - x
            square = dx * dx + dy * dy
            if z > out[k, m] and square <= radius * radius:
                rest = z - height_at(outline, sqrt(square))
                out[k, m] = max(out[k, m], rest)


@kernel
def _columns(i, lines, pitch, frame, margin, cols):  # type: ignore[no-untyped-def]
    """Which pixels of row i may be touched from a band of places."""
    cos, sin, ox, oy, over = frame[0], frame[1], frame[2], frame[3], frame[5]
    low, high = lines[0] * over - margin, (lines[1] - 1) * over + margin
    base = (i * pitch - oy) * cos + ox * sin
    if abs(sin) * cols * pitch < 1e-9:
        return (0, cols) if low <= base <= high else (0, 0)
    one, other = (base - low) / (sin * pitch), (base - high) / (sin * pitch)
    start, stop = floor(min(one, other)) - 1, ceil(max(one, other)) + 1
    return max(start, 0), max(min(stop, cols), 0)


@kernel
def _raise_row(out, lines, heights, i, low, high, before, here, pitch, frame, outline, smooth):  # type: ignore[no-untyped-def]
    """Raise the places that touch the facets of row i of pixels, or what bounds them."""
    cos, sin, ox, oy, step, over = frame
    sx, sy = pitch * cos, -pitch * sin
    tx, ty = pitch * sin, pitch * cos
    six = np.empty((6, 2))
    for j in range(low, high):
        px, py = j * pitch - ox, i * pitch - oy
        x, y = px * cos + py * sin, py * cos - px * sin
        a = heights[i, j]
        for side in range(2):
            _raise_by_facet(out, lines, here[side, j], side, i, j, x, y, pitch, frame)
        # An edge is touched only where it is a ridge: in a valley its facets are.
        zero, one = here[0, j], here[1, j]
        if (zero[0] - one[0]) * (sx - tx) + (zero[1] - one[1]) * (sy - ty) > _LEVEL:
            d = heights[i + 1, j + 1]
            _raise_by_edge(
                out, lines, zero, one, x, y, a, x + sx + tx, y + sy + ty, d, step, over, outline
            )
        if i > 0:
            up = before[0, j]
            if (up[0] - one[0]) * tx + (up[1] - one[1]) * ty > _LEVEL:
                b = heights[i, j + 1]
                _raise_by_edge(out, lines, up, one, x, y, a, x + sx, y + sy, b, step, over, outline)
        if j > 0:
            left = here[1, j - 1]
            if (left[0] - zero[0]) * sx + (left[1] - zero[1]) * sy > _LEVEL:
                c = heights[i + 1, j]
                _raise_by_edge(
                    out, lines, left, zero, x, y, a, x + tx, y + ty, c, step, over, outline
                )
        if i > 0 and j > 0:
            most, bend = 0.0, 0.0
            for n in range(6):
                up_there = n < 3
                side = (0, 1, 0, 1, 0, 1)[n]
                col = j - 1 if n in (0, 1, 3) else j
                facet = before[side, col] if up_there else here[side, col]
                six[n, 0], six[n, 1] = facet[0], facet[1]
                most = max(most, facet[0] * facet[0] + facet[1] * facet[1])
                bend = max(bend, abs(facet[0] - zero[0]) + abs(facet[1] - zero[1]))
            touched = bend > _LEVEL
            if touched and most < smooth * smooth:
                # Where the outline has no corner, a vertex is touched only if it is
                # no lower than the middle of its neighbours on either side.
                touched = (
                    heights[i, j - 1] + heights[i, j + 1] <= 2.0 * a + _LEVEL
                    and heights[i - 1, j] + heights[i + 1, j] <= 2.0 * a + _LEVEL
                    and heights[i - 1, j - 1] + heights[i + 1, j + 1] <= 2.0 * a + _LEVEL
                )
            if touched:
                _raise_by_vertex(out, lines, six, x, y, a, step, over, outline)


@kernel
def _start(out, lines, shape, pitch, frame, outline):  # type: ignore[no-untyped-def]
    """Begin with what the face around the surface allows."""
    cos, sin, ox, oy, step, over = frame
    width, height, radius = shape[1] * pitch, shape[0] * pitch, outline[-1, R1]
    for k in range(lines[0], lines[1]):
        for m in range(out.shape[1]):
            cx, cy = ox + m * step * cos - k * over * sin, oy + m * step * sin + k * over * cos
            border = min(cx, width - cx, cy, height - cy)
            if border <= 0.0:
                out[k, m] = 0.0
            elif border <= radius:
                out[k, m] = -height_at(outline, border)
            else:
                out[k, m] = -inf


@parallel_kernel
def drop_lattice(heights, pitch, frame, outline, smooth, band, out):  # type: ignore[no-untyped-def]
    """Fill `out` with tip heights, row by row of places.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    pitch : float
    frame : tuple of float
        Cosine and sine of the rows' angle (from x towards y), x and y of the first
        place from node [0, 0], distance of places along a row and of rows, mm.
    outline : (pieces, 7) ndarray
    smooth : float
        Slope up to which the outline has no corner.
    band : int
        Rows of places a thread takes at a time.
    out : (k, m) ndarray
    """
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    margin = outline[-1, R1] + 2.0 * pitch
    for part in prange((out.shape[0] + band - 1) // band):
        lines = (part * band, min(part * band + band, out.shape[0]))
        _start(out, lines, (rows, cols), pitch, frame, outline)
        before, here = np.zeros((2, cols, 5)), np.zeros((2, cols, 5))
        for i in range(rows):
            low, high = _columns(i, lines, pitch, frame, margin, cols)
            after_low, after_high = _columns(i + 1, lines, pitch, frame, margin, cols)
            first, last = low, high
            if after_high > after_low:
                first = min(low, after_low) if high > low else after_low
                last = max(high, after_high)
            before, here = here, before
            if last > first:
                _facets(heights, i, max(first - 1, 0), last, pitch, frame, outline, here)
            if high > low:
                _raise_row(
                    out, lines, heights, i, low, high, before, here, pitch, frame, outline, smooth
                )
