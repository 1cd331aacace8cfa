"""Lines along the strips that a cutter before could not reach, evenly spaced in space."""

from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, binary_erosion
from skimage.graph import MCP_Geometric
from skimage.measure import approximate_polygon, find_contours
from skimage.morphology import skeletonize

from relieffab.toolpath.envelope import nodes
from relieffab.toolpath.passes import Work
from relieffab.toolpath.pencil import chains
from relieffab.toolpath.waterline import length, to_panel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_SMOOTH = 0.1
_SMOOTH_MIDDLE = 0.3


def strips(work: Work, apart: float) -> list[Floats]:
    """Lay lines over all that stands, along its borders, and one along the middle.

    Distances are taken on the cutter-location surface, so that lines on steep ground
    are as close in space as those on level ground.

    Parameters
    ----------
    work : Work
    apart : float
        mm.

    Returns
    -------
    list of (k, 2) ndarray
        X and Y, mm.
    """
    places = nodes(work.relief.grid)
    low = work.ground.low_at_nodes
    above = work.top(places) - low
    there = above > work.least
    if not there.any():
        return []
    away = from_border(there, low, work.relief.grid.pitch)
    found = []
    for level in apart * (np.arange(ceil(float(away.max()) / apart)) + 0.5):
        found += [approximate_polygon(line, _SMOOTH) for line in find_contours(away, level)]
    beyond = np.mod(away / apart - 0.5, 1.0)
    thin = skeletonize(there)
    middle = thin & binary_dilation(thin & (beyond > 0.5), np.ones((5, 5), bool))
    found += [approximate_polygon(line, _SMOOTH_MIDDLE) for line in chains(middle)]
    lines = [to_panel(line, places) for line in found]
    return [line for line in lines if length(line) >= work.relief.grid.pitch]


def from_border(there: Bools, low: Floats, pitch: float) -> Floats:
    """Distance of each node picked from the nearest one that is not, over a surface, mm.

    Parameters
    ----------
    there : (n, m) ndarray of bool
    low : (n, m) ndarray
        Heights of the surface, mm.
    pitch : float
    """
    down, across = np.gradient(low, pitch)
    cost = np.where(there, pitch * np.sqrt(1.0 + down**2 + across**2), -1.0)
    # The way begins half a step outside: at the border's own nodes.
    border = there & ~binary_erosion(there)
    starts = np.argwhere(border)
    away, _ = MCP_Geometric(cost, fully_connected=True).find_costs(starts)
    out: Floats = np.where(there, away + 0.5 * np.abs(cost), 0.0)
    return out
