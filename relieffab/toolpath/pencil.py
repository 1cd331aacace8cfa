"""Pencil: along the creases where a cutter rests on two walls at once."""

import numpy as np
from numpy.typing import NDArray
from skimage.measure import approximate_polygon
from skimage.morphology import skeletonize

from relieffab.toolpath.envelope import nodes, tip_heights
from relieffab.toolpath.passes import Work
from relieffab.toolpath.waterline import length, to_panel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Pixel = tuple[int, int]

KINK = 0.3
"""Change of slope from node to node that is a crease and no bend."""

_SHORTEST = 1.0
_SMOOTH = 0.7
_WAYS = ((0, 1), (1, 0), (1, 1), (1, -1))


def creases(work: Work) -> list[Floats]:
    """Find the valleys of the cutter-location surface that have an edge.

    Where a cutter touches one place its location changes smoothly with it; where the
    contact leaps from one wall to another the surface has a kink, open upwards.

    Returns
    -------
    list of (k, 2) ndarray
        X and Y, mm.
    """
    places = nodes(work.relief.grid)
    low = work.ground.low_at_nodes
    kinked = kinks(low) > KINK * work.relief.grid.pitch
    x, y = places.xy()
    top = tip_heights(work.stock, work.cutter, x[kinked], y[kinked])
    kinked[kinked] = top - low[kinked] > work.least
    lines = [to_panel(approximate_polygon(line, _SMOOTH), places) for line in chains(kinked)]
    return [line for line in lines if length(line) >= _SHORTEST]


def kinks(low: Floats) -> Floats:
    """Largest second difference at each node over the four ways through it, per step."""
    wide = np.pad(low, 1, mode="edge")
    rows, cols = low.shape
    worst = np.zeros(low.shape)
    for i, j in _WAYS:
        one = wide[1 + i : 1 + i + rows, 1 + j : 1 + j + cols]
        other = wide[1 - i : 1 - i + rows, 1 - j : 1 - j + cols]
        np.maximum(worst, (one + other - 2 * low) / np.hypot(i, j), out=worst)
    return worst


def chains(picked: Bools) -> list[Floats]:
    """Thin pixels to lines and follow them from end to end.

    Returns
    -------
    list of (k, 2) ndarray
        Rows and columns; a line ends where others meet it.
    """
    left: set[Pixel] = {(int(i), int(j)) for i, j in np.argwhere(skeletonize(picked))}

    def near(pixel: Pixel) -> list[Pixel]:
        i, j = pixel
        sides = [(i, j + 1), (i + 1, j), (i, j - 1), (i - 1, j)]
        corners = [(i + 1, j + 1), (i + 1, j - 1), (i - 1, j - 1), (i - 1, j + 1)]
        return [other for other in sides + corners if other in left]

    lines = []
    for start in sorted(left, key=lambda pixel: (len(near(pixel)) != 1, pixel)):
        if start not in left:
            continue
        line = [start]
        left.discard(start)
        while beside := near(line[-1]):
            line.append(beside[0])
            left.discard(beside[0])
        if len(line) > 1:
            lines.append(np.array(line, dtype=np.float64))
    return lines
