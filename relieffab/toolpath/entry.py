"""Entries that slope: down along a run, or round a circle where the run is too short."""

from math import pi

import numpy as np
from numpy.typing import NDArray

from relieffab.toolpath.passes import Pass, at_depth

Floats = NDArray[np.float64]

SLOPE = 0.15
"""Of an entry: what is cut off its way to and fro is never more than the way is long."""

_SHORTEST = 0.3
_GENTLE = 0.075  # mm: less than this is not worth a slope
_WIDEST = 0.4  # of the cutter's radius: a helix leaves no post in its middle
_NARROWEST = 0.1
_ROUND = 24  # corners of a circle


def entry(part: Pass, run: Floats, ceiling: float) -> Floats:
    """Slope down to the start of a run.

    Parameters
    ----------
    part : Pass
        Which the run is of.
    run : (k, 3) ndarray
    ceiling : float
        Height of the stock at the run's start: where the slope begins, mm.

    Returns
    -------
    (m, 3) ndarray
        Ends where the run starts, nowhere below the pass; empty where the run itself is
        gentle, or neither slope nor helix has room.
    """
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(run[:, :2], axis=0).T))])
    way = _way(run, along, ceiling)
    if (ceiling - SLOPE * along <= run[:, 2] + _GENTLE)[along <= way].all():
        return run[:0]
    if along[-1] >= _SHORTEST:
        return _ramp(run, along, way, ceiling)
    circle = _circle(part, run[0])
    return _helix(circle, ceiling) if len(circle) else run[:0]


def _way(run: Floats, along: Floats, ceiling: float) -> float:
    """Length of a slope down to the run, mm."""
    z = run[:, 2]
    deepest = z[along * SLOPE <= ceiling - z.min()].min(initial=ceiling)
    return float(ceiling - deepest) / SLOPE


def _ramp(run: Floats, along: Floats, way: float, ceiling: float) -> Floats:
    """Slope down along a run, to and fro if need be, and come back to its start."""
    legs = int(np.ceil(way / along[-1]))
    stop = way / legs
    part = np.append(along[along < stop - 1e-9], stop)
    leg = np.column_stack([np.interp(part, along, run[:, axis]) for axis in range(3)])
    points = []
    for number in range(legs):
        forward = number % 2 == 0
        path, travelled = (leg, part) if forward else (leg[::-1], stop - part[::-1])
        height = np.maximum(path[:, 2], ceiling - SLOPE * (number * stop + travelled))
        points.append(np.column_stack([path[:, :2], height]))
    if legs % 2 == 1:
        points.append(leg[::-1])
    return np.concatenate(points)


def _circle(part: Pass, start: Floats) -> Floats:
    """Find the widest circle through a run's start on which the pass is no higher there.

    It stays where the pass's runs are: beyond may be another position's window.
    """
    reach = np.concatenate([run[:, :2] for run in part.runs])
    low, high = reach.min(axis=0), reach.max(axis=0)
    turn = np.linspace(0.0, 2 * pi, _ROUND + 1)
    radius = _WIDEST * part.work.cutter.radius
    while radius >= _NARROWEST:
        for to in turn[:-1:3]:
            middle = start[:2] - radius * np.array([np.cos(to), np.sin(to)])
            ring = middle + radius * np.column_stack([np.cos(turn + to), np.sin(turn + to)])
            if (ring < low).any() or (ring > high).any():
                continue
            (way,) = at_depth(part, [ring])
            if way[:, 2].max() <= start[2] + _GENTLE:
                return way
        radius /= 2
    return np.zeros((0, 3))


def _helix(circle: Floats, ceiling: float) -> Floats:
    """Go round and down a circle until it has been gone round at its own height."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(circle[:, :2], axis=0).T))])
    turns = int(np.ceil((ceiling - circle[:, 2].min()) / (SLOPE * along[-1]))) + 1
    way = np.concatenate([circle[:1], np.tile(circle[1:], (turns, 1))])
    travelled = np.append(0.0, (along[-1] * np.arange(turns)[:, None] + along[1:]).ravel())
    way[:, 2] = np.maximum(way[:, 2], ceiling - SLOPE * travelled)
    return way
