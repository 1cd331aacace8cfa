"""Finishing: rows close enough that the ridges between them stay below a height."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.toolpath.passes import Work
from relieffab.toolpath.raster import Graded, graded_rows, rows, standing

Bools = NDArray[np.bool_]

SCALLOP = 0.01
"""Height of the ridges between rows, mm."""

_NARROWEST = 0.02
_FLATTEST = 0.08


def scallop_stepover(cutter: Cutter, scallop: float = SCALLOP) -> float:
    """Choose the distance of ways that leaves ridges of a height.

    For a ball of radius R, ways a chord s apart in space leave ridges of height h
    where (s/2)² = h (2R - h), however the ground slopes.  A cutter without an arc
    leaves steps on slopes instead: it gets a tenth of its flat's width.

    Returns
    -------
    float
        mm, at least 0.02.
    """
    height = min(scallop, cutter.tip_radius)
    by_ridge = 2 * sqrt(height * (2 * cutter.tip_radius - height))
    if cutter.shape in ("flat", "vee", "form"):
        by_ridge = max(0.2 * cutter.flat_radius, _FLATTEST)
    return max(by_ridge, _NARROWEST)


def to_finish(work: Work) -> Bools:
    """(rows, cols) pixels over which the cutter may take more than `work.least` away."""
    deepest = -float(work.relief.heights.min())
    cutter = work.cutter
    reach = cutter.radius
    if cutter.shape == "tapered ball":
        reach = min(cutter.arc_end + deepest / cutter.flank, cutter.radius)
    pitch = work.relief.grid.pitch
    return standing(work.relief.heights, work.stock.heights, work.least, reach / pitch)


def finish_rows(work: Work, angle: float, stepover: float | None, scallop: float) -> Graded:
    """Lay rows over all that stands above the relief by more than `work.least`.

    Parameters
    ----------
    work : Work
    angle : float
        Of the rows, from X towards Y, degrees.
    stepover : float, optional
        Between rows, mm; else they lie as close as the scallop height asks.
    scallop : float
        mm.
    """
    where = to_finish(work)
    if stepover is not None:
        return Graded(rows(work, where, angle, stepover), np.zeros_like(where))
    return graded_rows(work, where, angle, scallop_stepover(work.cutter, scallop))
