"""Roughing: most of the stock, in levels, with an allowance left for finishing."""

import numpy as np

from relieffab.cutter import Cutter
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.passes import Work
from relieffab.toolpath.raster import rows, standing
from relieffab.toolpath.trace import Trace

STEPOVER = 0.4
"""Of the cutter's diameter."""

_TOLERANCE = 0.02
_LEAST = 0.1


def rough_work(relief: Terrain, cutter: Cutter, stepdown: float, allowance: float) -> Work:
    """Set a roughing cutter before the whole slab.

    Parameters
    ----------
    relief : Terrain
    cutter : Cutter
    stepdown, allowance : float
        mm.
    """
    slab = Terrain.over(relief.grid, np.zeros(relief.grid.node_shape))
    step = min(relief.grid.pitch, allowance)
    return Work(relief, slab, cutter, stepdown, allowance, _TOLERANCE, _LEAST, step)


def rough_rows(work: Work) -> Trace:
    """Lay roughing rows over the figure."""
    grid = work.relief.grid
    reach = work.cutter.radius / grid.pitch
    where = standing(work.relief.heights, work.stock.heights, work.least, reach)
    return rows(grid, where, STEPOVER * work.cutter.diameter, work.step)
