"""Greedy triangulation of a height field within a bound (Garland and Heckbert 1995).

The difference between a triangle and the relief is linear on each piece of their
overlay.  Its largest value therefore lies at a node within the triangle or where an
edge crosses one of the lattice's: all are looked at, so that the bound holds at
every point, not at samples only.

What is level at 0 is the panel's face, and stays it: there the bound is ten
thousand times closer, or triangles would lean from the far corners of the face
into the relief, shallow but wide.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.panel.lattice import insert, two_triangles

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FINER = 0.7  # each round's bound, of the last one's
GRAIN = 1e-9  # mm: rounding, which no bound can be below
STRICT = 1e4  # how much closer the bound is where the relief is at 0


@kernel
def _ceil(a, b):  # type: ignore[no-untyped-def]
    return -((-a) // b)


@kernel
def _worst_node(heights, strict, a, b, c):  # type: ignore[no-untyped-def]
    """Largest distance of the nodes within a triangle from it, and that node.

    Where the relief is at 0, distances count `strict` times.
    """
    width = heights.shape[1]
    ax, ay = a % width, a // width
    bx, by, cx, cy = b % width - ax, b // width - ay, c % width - ax, c // width - ay
    area = bx * cy - by * cx
    rise, run = heights[b // width, b % width], heights[c // width, c % width]
    top = heights[ay, ax]
    sx = ((rise - top) * cy - (run - top) * by) / area
    sy = ((run - top) * bx - (rise - top) * cx) / area
    worst, where = 0.0, -1
    for y in range(min(0, by, cy), max(0, by, cy) + 1):
        first, last = min(0, bx, cx), max(0, bx, cx)
        for px, py, dx, dy in ((0, 0, bx, by), (bx, by, cx - bx, cy - by), (cx, cy, -cx, -cy)):
            # Columns where the node is not to the left of this edge.
            level = dx * (y - py) + dy * px
            if dy > 0:
                last = min(last, level // dy)
            elif dy < 0:
                first = max(first, _ceil(-level, -dy))
        row, base = heights[ay + y], top + sy * y
        for x in range(first, last + 1):
            gap = abs(row[ax + x] - base - sx * x)
            if row[ax + x] == 0.0:
                gap *= strict
            if gap > worst:
                worst, where = gap, (ay + y) * width + ax + x
    return worst, where


@kernel
def _between(heights, i, j, f, across, down):  # type: ignore[no-untyped-def]
    """Height a share f along the lattice edge from node [i, j], and its nearer and further node."""
    h = (1.0 - f) * heights[i, j] + f * heights[i + down, j + across]
    one = i * heights.shape[1] + j
    two = one + down * heights.shape[1] + across
    return (h, one, two) if f < 0.5 else (h, two, one)


@kernel
def _worst_crossing(heights, strict, used, a, b):  # type: ignore[no-untyped-def]
    """Largest distance from the relief along an edge where it crosses the lattice's.

    The node that comes with it is the nearer one not used yet: one at least is not.
    """
    width = heights.shape[1]
    ax, ay, bx, by = a % width, a // width, b % width, b // width
    top, rise = heights[ay, ax], heights[by, bx] - heights[ay, ax]
    worst, where = 0.0, -1
    for across, down in ((1, 0), (0, 1), (1, 1)):
        start = ay if down == 0 else ax if across == 0 else ax - ay
        end = by if down == 0 else bx if across == 0 else bx - by
        way = 1 if end > start else -1
        for step in range(1, abs(end - start)):
            s, line = step / abs(end - start), start + way * step
            if across:
                x = ax + s * (bx - ax)
                j = min(int(x), width - 2)
                i = j - line if down else line
                if i > len(heights) - 1 - down:
                    i, j = i - 1, j - 1
                h, near, far = _between(heights, i, j, x - j, across, down)
            else:
                y = ay + s * (by - ay)
                i = min(int(y), len(heights) - 2)
                h, near, far = _between(heights, i, line, y - i, across, down)
            gap = abs(h - top - s * rise)
            if h == 0.0:
                gap *= strict
            if gap > worst and not (used[near] and used[far]):
                worst, where = gap, far if used[near] else near
    return worst, where


class Work(NamedTuple):
    """What growing remembers, and room to work in.

    Parameters
    ----------
    corners, mates : (3 t,) ndarray of int
        The triangulation, with room for all triangles that there can be.
    error : (t,) ndarray
        Of each triangle, mm.
    best : (t,) ndarray of int
        The node that would mend it.
    used : (n m,) ndarray of bool
        Nodes that are corners.
    waiting : (t,) ndarray of bool
        Triangles in the queue.
    queue, edges, fresh : (t + 8,) ndarray of int
    """

    corners: Any
    mates: Any
    error: Any
    best: Any
    used: Any
    waiting: Any
    queue: Any
    edges: Any
    fresh: Any


@kernel
def _judge(heights, strict, work, t):  # type: ignore[no-untyped-def]
    """Find how far triangle t is from the relief, and the node that would mend it."""
    a, b, c = work.corners[3 * t], work.corners[3 * t + 1], work.corners[3 * t + 2]
    worst, where = _worst_node(heights, strict, a, b, c)
    for p, q in ((a, b), (b, c), (c, a)):
        # From either side the same, to the last bit.
        gap, node = _worst_crossing(heights, strict, work.used, min(p, q), max(p, q))
        if gap > worst:
            worst, where = gap, node
    work.error[t], work.best[t] = worst, where


@kernel
def _refine(heights, bound, strict, work, total):  # type: ignore[no-untyped-def]
    """Insert the worst node of each triangle out of bound, until none is."""
    error, best, used, waiting = work.error, work.best, work.used, work.waiting
    queue, fresh, count = work.queue, work.fresh, 0
    for t in range(total):
        if error[t] > bound:
            queue[count], waiting[t] = t, True
            count += 1
    while count:
        count -= 1
        t = queue[count]
        waiting[t], changed, fresh[0] = False, 1, t
        if error[t] > bound and not used[best[t]]:
            used[best[t]] = True
            total, changed = insert(
                work.corners, work.mates, total, t, best[t], work.edges, fresh, heights.shape[1]
            )
        for k in range(changed):
            s = fresh[k]
            _judge(heights, strict, work, s)
            if error[s] > bound and not waiting[s]:
                queue[count], waiting[s] = s, True
                count += 1
    return total


@kernel
def _grow(heights, bounds, work):  # type: ignore[no-untyped-def]
    """Triangulate within one bound after the other; returns how many triangles it took."""
    rows, width = heights.shape
    two_triangles(work.corners, work.mates, rows, width)
    for corner in (0, width - 1, rows * width - 1, (rows - 1) * width):
        work.used[corner] = True
    total = 2
    for t in range(total):
        _judge(heights, 1.0, work, t)
    for bound in bounds:
        total = _refine(heights, bound, 1.0, work, total)
    for t in range(total):
        _judge(heights, STRICT, work, t)
    return _refine(heights, bounds[-1], STRICT, work, total)


def grow(heights: Floats, bound: float) -> Ints:
    """Cover a height field with few triangles between its nodes.

    Parameters
    ----------
    heights : (n, m) ndarray
        mm.
    bound : float
        Largest vertical distance, at nodes and between them, mm; where the relief
        is at 0, a ten thousandth of it.

    Returns
    -------
    (t, 3) ndarray of int
        Node numbers, row by row, turning from columns to rows.
    """
    rows, width = heights.shape
    most = 2 * (rows - 1) * (width - 1)
    bounds = [max(bound, GRAIN)]
    while bounds[-1] < np.ptp(heights):
        bounds.append(bounds[-1] / FINER)
    corners, mates = np.empty((2, 3 * most), np.int64)
    queue, edges, fresh = np.empty((3, most + 8), np.int64)
    used, waiting = np.zeros(rows * width, np.bool_), np.zeros(most, np.bool_)
    error, best = np.empty(most), np.empty(most, np.int64)
    work = Work(corners, mates, error, best, used, waiting, queue, edges, fresh)
    total = _grow(heights, np.array(bounds[::-1]), work)
    return corners[: 3 * total].reshape(-1, 3)
