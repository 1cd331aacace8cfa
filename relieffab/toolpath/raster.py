"""Rows at any angle across whatever still stands above the relief."""

from dataclasses import dataclass
from math import ceil, cos, radians, sin

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_closing, binary_dilation, maximum_filter

from relieffab.grid import Grid
from relieffab.toolpath.envelope import Places
from relieffab.toolpath.passes import Work
from relieffab.toolpath.trace import Trace

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

BETWEEN = 2
"""Of two rows one more lies in between where the ground is steep across them."""

_BREAK = 0.3


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


def cover(grid: Grid, where: Bools, angle: float, stepover: float, step: float) -> Places:
    """Lay rows of places over pixels, evenly and no further apart than the stepover.

    Parameters
    ----------
    grid : Grid
    where : (rows, cols) ndarray of bool
        At least one pixel.
    angle : float
        Of the rows, from X towards Y, degrees.
    stepover, step : float
        Distance of rows, and of places along them at most, mm.
    """
    row, col = np.nonzero(where)
    x, y = grid.to_xy(row + 0.5, col + 0.5)
    c, s = cos(radians(angle)), sin(radians(angle))
    half = 0.5 * grid.pitch * (abs(c) + abs(s))
    along, across = x * c + y * s, x * s - y * c
    first, last = across.min() - half, across.max() + half
    left, right = along.min() - half, along.max() + half
    rows = max(ceil((last - first) / stepover - 1e-9), 1)
    pieces = max(ceil((right - left) / step), 2)
    over = (last - first) / rows
    begin = first + 0.5 * over
    start = (left * c + begin * s, left * s - begin * c)
    return Places(start, angle, (right - left) / pieces, over, rows, pieces + 1)


def over_pixels(grid: Grid, where: Bools, places: Places) -> Bools:
    """(rows, count) whether each place lies over one of the pixels given."""
    row, col = grid.to_index(*places.xy())
    i, j = np.floor(row).astype(int), np.floor(col).astype(int)
    inside = (i >= 0) & (i < grid.rows) & (j >= 0) & (j < grid.cols)
    return inside & where[i.clip(0, grid.rows - 1), j.clip(0, grid.cols - 1)]


def trace_of(places: Places, picked: Bools, low: Floats, top: Floats) -> Trace:
    """Make runs of the places picked; z and top are known already."""
    run = np.cumsum(np.diff(picked, axis=1, prepend=False).ravel() & picked.ravel(), dtype=np.intp)
    chosen = picked.ravel()
    x, y = (axis.ravel()[chosen] for axis in places.xy())
    corner = np.zeros(len(x), bool)
    return Trace(np.column_stack([x, y]), low[picked], run[chosen], corner, top[picked])


def rows(work: Work, where: Bools, angle: float, stepover: float) -> Trace:
    """Lay rows a stepover apart over the pixels given, where there is something to cut.

    Returns
    -------
    Trace
        A run for each row's crossing of them, at its cutter locations.
    """
    if not where.any():
        return _nothing()
    places = cover(work.relief.grid, where, angle, stepover, work.step)
    low, top = work.ground.low(places), work.top(places)
    picked = over_pixels(work.relief.grid, where, places) & (top - low > work.least)
    return trace_of(places, _joined(picked, places), low, top)


@dataclass(frozen=True, eq=False)
class Graded:
    """Rows as close as the ground across them asks, and where it asks for too much.

    Parameters
    ----------
    rows : Trace
    steep : (rows, cols) ndarray of bool
        Pixels where that is not enough.
    """

    rows: Trace
    steep: Bools


def graded_rows(work: Work, where: Bools, angle: float, apart: float) -> Graded:
    """Lay rows so that the cutter's ways over neighbouring ones stay close in space.

    On ground that slopes across the rows the cutter's centre moves further from row to
    row than the stepover.  Rows follow the slope that is usual, and where it is steeper
    one more lies between two.

    Parameters
    ----------
    work : Work
    where : (rows, cols) ndarray of bool
    angle : float
        degrees.
    apart : float
        Largest distance between neighbouring ways of the tip, in space, mm.
    """
    grid = work.relief.grid
    if not where.any():
        return Graded(_nothing(), np.zeros(grid.shape, bool))
    wide = cover(grid, where, angle, apart, 2 * work.step)
    gaps = _gaps(work.ground.low(wide), wide.stepover)
    over = over_pixels(grid, where, wide)
    seen = gaps[over[1:] & over[:-1]]
    usual = float(np.median(seen)) if seen.size else wide.stepover
    base = cover(grid, where, angle, max(apart * wide.stepover / usual, apart / 2), work.step)
    fine = Places(base.start, angle, base.step, base.stepover / BETWEEN,
                  BETWEEN * (base.rows - 1) + 1, base.count)  # fmt: skip
    low, top = work.ground.low(fine), work.top(fine)
    gaps = np.pad(_gaps(low[::BETWEEN], base.stepover), ((0, 1), (0, 0)), constant_values=0.0)
    asked = np.ceil(gaps / apart - 0.02)
    steep = asked > BETWEEN
    needed = np.zeros(low.shape, bool)
    needed[::BETWEEN] = True
    for between in range(1, BETWEEN):
        needed[between::BETWEEN] = ((asked > 1) & ~steep)[:-1]
    picked = needed & over_pixels(grid, where, fine) & (top - low > work.least)
    trace = trace_of(fine, _joined(picked, fine), low, top)
    return Graded(trace, _pixels(grid, base, steep))


def _gaps(low: Floats, stepover: float) -> Floats:
    """Distance in space from each place to the one on the next row, mm."""
    return np.hypot(stepover, np.diff(low, axis=0))


def _joined(picked: Bools, places: Places) -> Bools:
    """Close breaks along rows that are shorter than a retract is worth."""
    width = ceil(_BREAK / places.step)
    wide = np.pad(picked, ((0, 0), (width, width)))
    closed: Bools = binary_closing(wide, np.ones((1, width), bool))[:, width:-width]
    return closed | picked


def _pixels(grid: Grid, places: Places, picked: Bools) -> Bools:
    """Mark the pixels of places, and those between them and the next row's."""
    out = np.zeros(grid.shape, bool)
    x, y = (axis[picked] for axis in places.xy())
    turn = radians(places.angle)
    for share in np.arange(0.0, 1.01, min(0.5 * grid.pitch / places.stepover, 1.0)):
        way = share * places.stepover
        row, col = grid.to_index(x + way * sin(turn), y - way * cos(turn))
        i = np.floor(row).astype(int).clip(0, grid.rows - 1)
        j = np.floor(col).astype(int).clip(0, grid.cols - 1)
        out[i, j] = True
    return out


def _nothing() -> Trace:
    return Trace(
        np.zeros((0, 2)), np.zeros(0), np.zeros(0, np.intp), np.zeros(0, bool), np.zeros(0)
    )
