"""A relief as it lies on the machine: turned under it, or on a curved board from above.

On a machine that turns it, its Y lies along X, its X round the axis.  Rows and columns
change places, which keeps every triangle what it is; seen from outside that is a mirror
image, and `Stock.to_work` mirrors it back.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from relieffab.grid import Grid
from relieffab.layers.model import Stroke
from relieffab.relief.above import bent_points, seen_from_above
from relieffab.relief.model import Floats, Relief
from relieffab.relief.style.model import Marks
from relieffab.stock import Stock


def laid(relief: Relief, stock: Stock) -> Relief:
    """Lay a relief on a round stock or a curved board; on a flat one it stays as it is.

    Parameters
    ----------
    relief : Relief
        On the flat panel.
    stock : Stock
        A round one is as wide as the panel is high, and as high as that is wide.
    """
    if stock.curve:
        return seen_from_above(relief, stock)
    return _swapped(relief, stock.width, stock.height) if stock.radius else relief


def upright(relief: Relief, stock: Stock) -> Relief:
    """Turn what lies on a round stock back; on others, all is seen from above already."""
    return _swapped(relief, stock.height, stock.width) if stock.radius else relief


def _swapped(relief: Relief, width: float, height: float) -> Relief:
    """Mirror a relief so that X grows against its Y, and Y against its X."""
    grid, (x, y) = relief.grid, relief.grid.origin
    swapped = Grid(grid.cols, grid.rows, grid.pitch, (width - y, height - x))
    return Relief(swapped, relief.heights.T.copy(), relief.mask.T.copy(), relief.depth)


def parted(stroke: Stroke, around: float) -> list[Stroke]:
    """Part a stroke where it crosses the seam of a panel that goes all the way round.

    Parameters
    ----------
    stroke : Stroke
        X from anywhere.
    around : float
        The way round, mm.

    Returns
    -------
    list of Stroke
        X within 0 and `around`; a stroke that crosses nothing stays one.
    """
    points, strength = stroke.points, stroke.strength
    if stroke.closed and len(_turns(points[:, 0], around)) > 1:
        points = np.concatenate([points, points[:1]])
        strength = np.append(strength, strength[0])
    parts = parted_line(np.column_stack([points, strength]), around)
    closed = stroke.closed and len(parts) == 1
    return [replace(stroke, points=p[:, :2], strength=p[:, 2], closed=closed) for p in parts]


def _turns(x: Floats, around: float) -> range:
    return range(int(np.floor(x.min() / around)), int(np.floor(x.max() / around)) + 1)


def parted_line(table: Floats, around: float) -> list[Floats]:
    """Part a polyline as `parted` does a stroke: X is the first column, others go along."""
    turns = _turns(table[:, 0], around)
    if len(turns) == 1:
        return [table - np.eye(1, table.shape[1]) * turns[0] * around]
    at = np.arange(len(table), dtype=float)
    cuts = [at]
    for turn in turns[1:]:
        left, right = table[:-1, 0] - turn * around, table[1:, 0] - turn * around
        crossed = np.flatnonzero(left * right < 0)
        cuts.append(crossed + left[crossed] / (left[crossed] - right[crossed]))
    every = np.unique(np.concatenate(cuts))
    x, *others = (np.interp(every, at, column) for column in table.T)
    own = np.floor((x[:-1] + x[1:]) / (2 * around))
    starts = np.concatenate([[0], np.flatnonzero(np.diff(own)) + 1, [len(own)]])
    return [
        np.column_stack([x[a : b + 1] - own[a] * around, *(c[a : b + 1] for c in others)])
        for a, b in pairwise(starts)
    ]


def laid_strokes(strokes: Sequence[Stroke], relief: Relief, stock: Stock) -> Sequence[Stroke]:
    """Lay strokes on a stock as `laid` lays the relief they are drawn on."""
    if stock.curve:
        return [replace(s, points=bent_points(s.points, relief, stock)) for s in strokes]
    if not stock.radius:
        return strokes
    corner = (stock.width, stock.height)
    return [replace(stroke, points=corner - stroke.points[:, ::-1]) for stroke in strokes]


def laid_marks(marks: Marks, relief: Relief, stock: Stock) -> Marks:
    """Lay marks on a stock as `laid` lays the relief that bears them."""
    if stock.curve:
        rise = marks.cutter.tip_radius
        bent = tuple(bent_points(line, relief, stock, rise) for line in marks.lines)
        return replace(marks, smooth=laid(marks.smooth, stock), lines=bent)
    if not stock.radius:
        return marks
    corner = (stock.width, stock.height)
    lines = tuple(corner - line[:, ::-1] for line in marks.lines)
    return replace(marks, smooth=laid(marks.smooth, stock), lines=lines)
