"""Seams: what is left where the parts of a panel meet that was cut at several positions."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.positions import Position

Singles = NDArray[np.float32]


@dataclass(frozen=True)
class Seam:
    """The figure where two windows overlap, and half the widest cutter beyond.

    Parameters
    ----------
    between : tuple of int
        Numbers of the positions.
    error_mm : float
        99th percentile of the distance from the relief, up or down, straight.
    within_tolerance : float
        Share of its nodes within the tolerance.
    """

    between: tuple[int, int]
    error_mm: float
    within_tolerance: float


def seams_of(
    positions: Sequence[Position],
    cutters: Sequence[Cutter],
    grid: Grid,
    deviation: Singles,
    tolerance: float,
) -> tuple[Seam, ...]:
    """Measure each seam that the figure reaches.

    Parameters
    ----------
    positions : sequence of Position
        In their order; each as often as one likes.
    cutters : sequence of Cutter
    grid : Grid
        A lattice.
    deviation : (rows + 1, cols + 1) ndarray
        Of what is left from the relief, mm; NaN off the figure.
    tolerance : float
        mm.
    """
    found = []
    ordered = list(dict.fromkeys(positions))
    reach = max(cutter.radius for cutter in cutters)
    x, y = grid.node_axes()
    for one, other in pairwise(ordered):
        low, high = one.overlap(other)
        across = (x >= low[0] - reach) & (x <= high[0] + reach)
        down = (y >= low[1] - reach) & (y <= high[1] + reach)
        strip = np.abs(deviation[np.ix_(down, across)])
        strip = strip[~np.isnan(strip)]
        if strip.size:
            worst = float(np.percentile(strip, 99))
            within = float((strip <= tolerance).mean())
            found.append(Seam((one.number, other.number), worst, within))
    return tuple(found)


def seam_findings(seams: Sequence[Seam], tolerance: float, least: float) -> list[str]:
    """List the seams of which less than a share lies within the tolerance."""
    return [
        f"only {seam.within_tolerance:.1%} of the seam between positions {seam.between[0]} and "
        f"{seam.between[1]} is within {tolerance:g} mm of the relief"
        for seam in seams
        if seam.within_tolerance < least
    ]
