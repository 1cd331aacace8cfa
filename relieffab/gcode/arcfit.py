"""Arcs in place of chords, where a level run of them lies on a circle."""

from math import tau

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

TOLERANCE = 0.002
"""How far an arc may lie from the chords it stands for, mm: with what rounding takes, still less
than what planning keeps clear."""

FEWEST = 4
"""Chords, below which an arc's longer line saves nothing."""

_WIDEST = 1e6  # steps of radius: flatter arcs are straight lines
_SWEEP = 0.9 * tau


@kernel
def _circle(a, b, c):  # type: ignore[no-untyped-def]
    """Centre through three points, in whole steps; radius 0 where they lie on a line."""
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    cross = 2.0 * (ux * vy - uy * vx)
    if cross == 0.0:
        return 0.0, 0.0, 0.0
    u2, v2 = ux * ux + uy * uy, vx * vx + vy * vy
    x = np.rint((vy * u2 - uy * v2) / cross)
    y = np.rint((ux * v2 - vx * u2) / cross)
    return a[0] + x, a[1] + y, np.hypot(x, y)


@kernel
def _fits(points, i, j, tolerance):  # type: ignore[no-untyped-def]
    """Say which way an arc turns that stands for moves i to j, 0 if none does; its centre."""
    x, y, radius = _circle(points[i], points[(i + j) // 2], points[j])
    if radius < 10 * tolerance or radius > _WIDEST:
        return 0, x, y
    turn, sweep = 0, 0.0
    end_radius = np.hypot(points[j, 0] - x, points[j, 1] - y)
    for k in range(i, j):
        ax, ay = points[k, 0] - x, points[k, 1] - y
        bx, by = points[k + 1, 0] - x, points[k + 1, 1] - y
        angle = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
        side = 1 if angle > 0 else -1
        if angle == 0.0 or turn == -side:
            return 0, x, y
        turn = side
        sweep += abs(angle)
        # The arc's radius changes evenly from start to end, by what rounding did to it.
        off = max(abs(np.hypot(bx, by) - radius), abs(np.hypot(bx, by) - end_radius))
        if off + radius * (1.0 - np.cos(0.5 * angle)) > tolerance:
            return 0, x, y
    return (turn if sweep < _SWEEP else 0), x, y


@kernel
def _longest(points, i, last, tolerance):  # type: ignore[no-untyped-def]
    """Find the longest arc from i on, to `last` at most: its end, turn and centre."""
    # A short arc's centre hangs on the rounding of three points: long ones are tried first.
    j = last
    while j >= i + FEWEST:
        way, x, y = _fits(points, i, j, tolerance)
        if way != 0:
            break
        j = i + (j - i) * 7 // 8
    best, turn, cx, cy = i, 0, 0.0, 0.0
    misses = 0
    while i + FEWEST <= j <= last and misses < 4:
        way, x, y = _fits(points, i, j, tolerance)
        if way != 0:
            best, turn, cx, cy, misses = j, way, x, y, 0
        else:
            misses += 1
        j += 1
    return best, turn, cx, cy


@kernel
def fit(points: Floats, feed: Floats, tolerance: float, turn: Ints, centre: Floats) -> None:
    """Find arcs, each as long as it can be, from the first move on.

    Parameters
    ----------
    points : (n, 3) ndarray
        Positions in steps of a written coordinate.
    feed : (n,) ndarray
        Of the move to each point; infinite for a rapid.
    tolerance : float
        Steps.
    turn : (n,) ndarray of int, out
        0 for a straight move, 1 for an arc counter-clockwise that ends at the point,
        -1 for one clockwise, 2 where an arc took the point in.
    centre : (n, 2) ndarray, out
        Of the arc that ends at the point, steps.
    """
    n = len(points)
    turn[:] = 0
    i = 0
    while i + FEWEST < n:
        last = i
        while (
            last + 1 < n
            and feed[last + 1] == feed[i + 1]
            and np.isfinite(feed[last + 1])
            and points[last + 1, 2] == points[i, 2]
        ):
            last += 1
        best, way, x, y = _longest(points, i, last, tolerance)
        if best > i:
            turn[i + 1 : best] = 2
            turn[best], centre[best, 0], centre[best, 1] = way, x, y
            i = best
        else:
            i += 1
