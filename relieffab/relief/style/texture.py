"""Marks as the cutter leaves them: its tip swept along each, below the smooth surface."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.cutter import Cutter
from relieffab.relief.sweep import reach_of, sweep

Floats = NDArray[np.float64]
Stroke = tuple[Floats, Floats]

STEEPEST = 0.6  # of the tip's radius: so high above its lowest point it still touches a slope
BROAD = 2.5  # of a mark's depth: so high up a cone still cuts, on a slope of 0.6
EVEN = 4.0  # samples of a stroke, about pixels
GRAIN = 0.01  # mm
ENOUGH = 14  # nodes from the axis to where a tip ends: with fewer there are nodes put between
SAMPLES = 512  # of the tip's profile


def tip_table(cutter: Cutter, deepest: float) -> tuple[Floats, float]:
    """Sample as much of a cutter's profile as touches slopes under marks so deep, mm.

    Returns
    -------
    table : (n,) ndarray
        Heights above the tip at even distances from the axis, mm.
    reach : float
        The last of those distances, mm.
    """
    reach = min(
        reach_of(cutter.profile, BROAD * deepest + STEEPEST * cutter.tip_radius), cutter.radius
    )
    return cutter.profile(np.linspace(0.0, reach, SAMPLES)), reach


def finer(heights: Floats) -> Floats:
    """Put a node between any two."""
    rows, cols = (2 * n - 1 for n in heights.shape)
    fine = np.empty((rows, cols))
    fine[::2, ::2] = heights
    fine[1::2, ::2] = 0.5 * (heights[1:] + heights[:-1])
    fine[:, 1::2] = 0.5 * (fine[:, 2::2] + fine[:, :-1:2])
    return fine


def refined(heights: Floats, reach: float, pitch: float) -> tuple[Floats, int]:
    """Give nodes close enough for a tip that ends so far from its axis, mm.

    Returns
    -------
    heights : ndarray
        `finer`, or as they are.
    per : int
        Nodes to one there was, each way.
    """
    return (heights, 1) if reach > ENOUGH * pitch else (finer(heights), 2)


def _coarser(fine: Floats) -> Floats:
    """Take every other node, with the halves of its neighbours."""
    for axis in (0, 1):
        fine = ndimage.convolve1d(fine, [0.25, 0.5, 0.25], axis=axis, mode="nearest")
    return fine[::2, ::2]


def _steady(z: Floats) -> Floats:
    """Even out what crossing a lattice puts into a way over it, and no more.

    A stroke that drifts over columns of nodes would show each of them as a step.
    """
    around = int(4 * EVEN)
    longer = np.pad(z, around, mode="reflect", reflect_type="odd")
    even = ndimage.gaussian_filter1d(longer, EVEN)[around:-around]
    return np.clip(even, z - GRAIN, z + GRAIN)


def textured(
    smooth: Floats,
    tips: Floats,
    pitch: float,
    strokes: Sequence[Stroke],
    cutter: Cutter,
    depth: float,
) -> Floats:
    """Carve strokes into a surface.

    The cutter stands as deep as a stroke asks below the lowest place where it would
    only touch the smooth surface: so no mark is narrower than the cutter, and where it
    cannot reach there is none.  Nodes take the mean of the marks around them, which
    keeps oblique ones from becoming rows of dots.

    Parameters
    ----------
    smooth : (n, m) ndarray
        At nodes, mm, -depth to 0.
    tips : (n, m) ndarray
        The cutter's lowest places over it, from `reach.lowest_tips`, mm.
    pitch : float
        mm.
    strokes : sequence of tuple of (k, 2) and (k,) ndarray
        Rows and columns, and depths in mm.
    cutter : Cutter
    depth : float
        Bound of the relief, mm.

    Returns
    -------
    (n, m) ndarray
        mm; from -depth to the smooth surface.
    """
    if not strokes:
        return smooth
    deepest = max(float(deep.max()) for _, deep in strokes)
    table, reach = tip_table(cutter, deepest)
    fine, per = refined(smooth, reach, pitch)
    left = fine.copy()
    for places, deep in strokes:
        z = _steady(ndimage.map_coordinates(tips, places.T, order=1, mode="nearest")) - deep
        row, col = np.ascontiguousarray(per * places.T)
        sweep(row, col, np.minimum(-z, depth), table, reach, pitch / per, left)
    cut = fine - left if per == 1 else _coarser(fine - left)
    return np.clip(smooth - cut, -depth, smooth)
