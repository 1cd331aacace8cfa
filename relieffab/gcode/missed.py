"""Where a cutter could have gone, and did not: a row left out, a corner forgotten."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.cutter import Cutter
from relieffab.relief.model import Relief
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.remains import after

Floats = NDArray[np.float64]


def missed_patch(
    relief: Relief, excess: Floats, cutter: Cutter, tolerance: float, radius: float = 0.0
) -> float:
    """Measure the largest patch a cutter left standing though it could reach it.

    What a cutter can make of a relief is the relief closed by it: dropped at
    every node, what it leaves there.  A node counts as missed if it stands
    more than the tolerance above the relief and above that, square to the
    surface: between two rows on a steep wall a vertical measure finds what no
    hand would.

    Parameters
    ----------
    relief : Relief
    excess : (rows + 1, cols + 1) ndarray
        What is left above the relief at its nodes, mm; 0 or less where nobody
        asks.
    cutter : Cutter
    tolerance : float
        mm.
    radius : float, optional
        Of the face of a round stock, mm; 0 where it is flat.

    Returns
    -------
    float
        Area of the largest connected patch, mm².
    """
    upright = _flatness(relief)
    asked = excess * upright > tolerance
    if not asked.any():
        return 0.0
    missed = np.zeros_like(asked)
    unmade = excess[asked] - _residual(relief, asked, cutter, radius)
    missed[asked] = unmade * upright[asked] > tolerance
    patches, count = ndimage.label(missed, structure=np.ones((3, 3)))
    if not count:
        return 0.0
    return float(np.bincount(patches.ravel())[1:].max()) * relief.grid.pitch**2


def _flatness(relief: Relief) -> Floats:
    """Cosine of the steepest slope next to each node."""
    down, across = np.gradient(relief.heights, relief.grid.pitch)
    steepest = ndimage.maximum_filter(np.hypot(down, across), size=3)
    cosine: Floats = 1.0 / np.sqrt(1.0 + steepest**2)
    return cosine


def _residual(relief: Relief, asked: NDArray[np.bool_], cutter: Cutter, radius: float) -> Floats:
    """Least height above the relief the cutter can leave at the nodes asked for, mm."""
    pitch = relief.grid.pitch
    near = ndimage.distance_transform_edt(~asked) * pitch <= cutter.arc_end + pitch
    x, y = relief.grid.to_xy(*(k.astype(float) for k in np.nonzero(near)))
    tips = np.column_stack([x, y, tip_heights(Terrain.of(relief, radius), cutter, x, y)])
    closed = after(np.zeros(asked.shape), relief.grid, cutter, tips)
    return closed[asked] - relief.heights[asked]
