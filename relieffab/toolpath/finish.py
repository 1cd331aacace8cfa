"""Finishing: rows close enough that the ridges between them stay below a height."""

from math import sqrt

from relieffab.cutter import Cutter
from relieffab.toolpath.passes import Work
from relieffab.toolpath.raster import rows, standing
from relieffab.toolpath.trace import Trace

SCALLOP = 0.01
"""Height of the ridges between rows on flat ground, mm."""

_NARROWEST, _WIDEST = 0.08, 0.5


def scallop_stepover(cutter: Cutter, scallop: float = SCALLOP) -> float:
    """Choose the stepover that leaves ridges of a height on flat ground.

    For a ball of radius R they are s²/(8R).  A cutter without an arc leaves
    steps on slopes instead: it gets a tenth of its flat's width.

    Returns
    -------
    float
        From 0.08 to 0.5 mm.
    """
    by_ridge = sqrt(8 * cutter.tip_radius * scallop)
    by_flat = 0.2 * cutter.flat_radius
    return min(max(by_ridge, by_flat, _NARROWEST), _WIDEST)


def finish_rows(work: Work, stepover: float) -> Trace:
    """Lay rows over all that stands above the relief by more than `work.least`.

    Parameters
    ----------
    work : Work
    stepover : float
        mm.
    """
    grid = work.relief.grid
    deepest = -float(work.relief.heights.min())
    taper = deepest / work.cutter.flank
    reach = min(work.cutter.arc_end + taper, work.cutter.radius) / grid.pitch
    where = standing(work.relief.heights, work.stock.heights, work.least, reach)
    return rows(grid, where, stepover, work.step)
