"""Rows along X across whatever still stands above the relief."""

from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, maximum_filter

from relieffab.grid import Grid
from relieffab.toolpath.trace import Trace

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


def standing(relief: Floats, stock: Floats, least: float, reach: float) -> Bools:
    """Find the pixels where a cutter's axis may have something to cut.

    Parameters
    ----------
    relief, stock : (rows + 1, cols + 1) ndarray
        Heights at nodes, mm.
    least : float
        What may stay, mm.
    reach : float
        How far from its axis the cutter cuts, nodes.

    Returns
    -------
    (rows, cols) ndarray of bool
        Pixels inside the figure, near enough to something that stands.
    """
    above = stock - relief > least
    wide = maximum_filter(above, size=2 * ceil(reach) + 1)
    near = wide[:-1, :-1] | wide[1:, :-1] | wide[:-1, 1:] | wide[1:, 1:]
    sunk = relief < 0
    inside = sunk[:-1, :-1] | sunk[1:, :-1] | sunk[:-1, 1:] | sunk[1:, 1:]
    return binary_dilation(inside) & near


def rows(grid: Grid, where: Bools, stepover: float, step: float) -> Trace:
    """Lay rows over the pixels given.

    Parameters
    ----------
    grid : Grid
    where : (rows, cols) ndarray of bool
    stepover, step : float
        Distance of rows, and of samples along them at most, mm.

    Returns
    -------
    Trace
        One run for each row's crossing of the pixels; z is 0 yet.
    """
    if not where.any():
        return Trace(np.zeros((0, 2)), np.zeros(0), np.zeros(0, np.intp), np.zeros(0, bool))
    used_rows, used_cols = np.flatnonzero(where.any(1)), np.flatnonzero(where.any(0))
    low, high = used_rows[0], used_rows[-1] + 1
    left, right = used_cols[0], used_cols[-1] + 1
    count = max(ceil((high - low) * grid.pitch / stepover), 1)
    row = low + (np.arange(count) + 0.5) * (high - low) / count
    pieces = max(ceil((right - left) * grid.pitch / step), 2)
    col = left + np.arange(pieces + 1) * (right - left) / pieces
    i = np.minimum(row.astype(int), grid.rows - 1)
    j = np.minimum(col.astype(int), grid.cols - 1)
    picked = where[np.ix_(i, j)]
    run = np.cumsum(np.diff(picked, axis=1, prepend=False).ravel() & picked.ravel(), dtype=np.intp)
    chosen = picked.ravel()
    x, y = grid.to_xy(np.repeat(row, len(col)), np.tile(col, len(row)))
    xy = np.column_stack([x, y])[chosen]
    return Trace(xy, np.zeros(len(xy)), run[chosen], np.zeros(len(xy), bool))
