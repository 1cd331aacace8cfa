"""A cutter's tip that follows a line, and what it leaves of the nodes beside it."""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.relief.reach import Profile

Floats = NDArray[np.float64]


@kernel
def sweep(row, col, deep, table, reach, pitch, out):  # type: ignore[no-untyped-def]
    """Lower nodes under a tip that follows a polyline in nodes' rows and columns.

    Parameters
    ----------
    row, col : (k,) ndarray
    deep : (k,) ndarray
        The tip's depth, mm.
    table : (n,) ndarray
        Heights of the tip's profile from its axis to the reach, mm.
    reach, pitch : float
        mm.
    out : (rows, cols) ndarray
        Heights of nodes, mm; modified.
    """
    n, m = out.shape
    wide = reach / pitch
    for k in range(len(row) - 1):
        across, down = col[k + 1] - col[k], row[k + 1] - row[k]
        square = across * across + down * down
        top = max(int(min(row[k], row[k + 1]) - wide), 0)
        low = min(int(max(row[k], row[k + 1]) + wide) + 2, n)
        left = max(int(min(col[k], col[k + 1]) - wide), 0)
        right = min(int(max(col[k], col[k + 1]) + wide) + 2, m)
        for i in range(top, low):
            for j in range(left, right):
                y, x = i - row[k], j - col[k]
                s = (x * across + y * down) / square if square > 0.0 else 0.0
                s = min(max(s, 0.0), 1.0)
                y, x = y - s * down, x - s * across
                place = np.sqrt(x * x + y * y) * pitch / reach * (len(table) - 1)
                if place < len(table) - 1:
                    a = int(place)
                    height = table[a] + (place - a) * (table[a + 1] - table[a])
                    depth = deep[k] + s * (deep[k + 1] - deep[k])
                    out[i, j] = min(out[i, j], height - depth)


def reach_of(profile: Profile, depth: float) -> float:
    """Distance from the axis at which a cutter so deep leaves the surface, mm."""
    reach = 1e-3
    while profile(np.array([reach]))[0] < depth and reach < 1e3:
        reach *= 1.1
    return reach
