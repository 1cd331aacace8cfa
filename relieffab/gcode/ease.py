"""Cuts that would take too much at once, taken in several goes: first higher, then as planned."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.gcode.moves import stepped
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.machine import cutting
from relieffab.toolpath.path import Toolpath

Floats = NDArray[np.float64]

_ROUNDS = 6


def eased(path: Toolpath, setup: Setup, slab: Slab) -> Toolpath:
    """Go over the places first where a pass would take more than the stepdown allows.

    Planning knows the stock from samples, and a corner that one level left stands in
    the way of the next.  Where a virtual stock shows such a bite, the cutter rises,
    goes along the same moves higher and back, as often as it takes, and then cuts as
    planned.
    Nothing is cut that was not to be cut.  What cannot be eased is left to the writer,
    which refuses it.

    Parameters
    ----------
    path : Toolpath
    setup : Setup
    slab : Slab
        The stock as the programs before leave it; not modified.

    Returns
    -------
    Toolpath
        The path itself where nothing was to be done.
    """
    limits = setup.limits(path.cutter)
    use = cutting(path.cutter, setup.material, setup.machine)
    for _ in range(_ROUNDS):
        # As it will be written: a node at the cutter's rim is cut or not by a rounded step.
        written = stepped(path.points, setup.stock, setup.post) / setup.post.scales
        bites = slab.copy().cut(setup.stock.to_panel(written), path.cutter)
        bad = (bites > limits.deepest_pass) & np.isfinite(path.feed)
        bad[0] = False
        if not bad.any():
            break
        path = _twice(path, bites, bad, use.stepdown, min(use.plunge, use.feed))
    return path


def _twice(
    path: Toolpath, bites: Floats, bad: NDArray[np.bool_], stepdown: float, feed: float
) -> Toolpath:
    """Insert higher ways there and back, a stepdown apart, before each group of bad moves."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], bad, [False]]).astype(int)))
    points, feeds, done = [], [], 0
    for first, end in edges.reshape(-1, 2):
        start, deepest = path.points[first - 1 : end], bites[first:end].max()
        ways = [path.points[:0]]
        for lift in np.arange(deepest - stepdown, 0.0, -stepdown):
            there = start + np.array([0.0, 0.0, lift])
            ways += [there, there[-2::-1]]
        extra = np.concatenate([*ways, start[:1]])
        points += [path.points[done:first], extra]
        feeds += [path.feed[done:first], np.full(len(extra), feed)]
        done = first
    points.append(path.points[done:])
    feeds.append(path.feed[done:])
    return replace(path, points=np.concatenate(points), feed=np.concatenate(feeds))
