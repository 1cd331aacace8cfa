"""The deepest cut into a relief, square to its surface."""

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.relief.model import Relief

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

_NEAR = 0.0005 * 2.0 ** np.arange(0, 10, 0.25)  # mm
_WAYS = np.exp(0.25j * np.pi * np.arange(8))
_BATCH = 4096


def deepest_gouge(
    relief: Relief, grid: Grid, heights: Singles, deviation: Singles
) -> tuple[float, float, float]:
    """Find the cut furthest from the relief's surface among those below it.

    Straight down, a step of 1 um into a wall of 88.5 degrees would be 40 um, and at the
    edge of an upright one its whole height.  So a node's depth is its least distance from
    the surface, sought straight up and round it: an upper bound, within 1.3 times
    the truth on slopes, exact on level ground.

    Parameters
    ----------
    relief : Relief
    grid : Grid
        A lattice.
    heights, deviation : (rows + 1, cols + 1) ndarray
        What is left at its nodes, and by how much that is above the relief, mm.

    Returns
    -------
    tuple of float
        Depth, and X and Y on the panel, mm; depth 0 where there is none.
    """
    rows, cols = np.nonzero(deviation < -1e-6)  # single precision is no gouge
    order = np.argsort(deviation[rows, cols], kind="stable")
    best, place = 0.0, (0.0, 0.0)
    for start in range(0, len(order), _BATCH):
        batch = order[start : start + _BATCH]
        i, j = rows[batch], cols[batch]
        straight = -deviation[i, j].astype(float)
        if straight[0] <= best:
            break
        x, y = grid.to_xy(i.astype(float), j.astype(float))
        depth = np.minimum(straight, _around(relief, x, y, heights[i, j].astype(float)))
        worst = int(depth.argmax())
        if depth[worst] > best:
            best, place = float(depth[worst]), (float(x[worst]), float(y[worst]))
    return best, *place


def _around(relief: Relief, x: Floats, y: Floats, z: Floats) -> Floats:
    """Distance of points below a relief from its surface nearby, sideways and up, mm."""
    least = np.full(len(x), np.inf)
    for radius in _NEAR:
        for way in _WAYS:
            step = radius * way
            up = relief.height_at(x + step.real, y + step.imag) - z
            least = np.minimum(least, np.hypot(radius, np.maximum(up, 0.0)))
    return least
