"""Runs joined into one motion: order, entries, retracts and feeds.

No rapid ever goes below the face: the cutter comes down at a rapid to a small
clearance above it, and from there at its plunge feed.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.machine import Cutting, Machine
from relieffab.toolpath.entry import entry
from relieffab.toolpath.order import arrange
from relieffab.toolpath.passes import Pass, at_depth

Floats = NDArray[np.float64]

CLEARANCE = 0.5
"""Height above the face where a rapid down ends, mm."""

HOP = 0.5
"""Height above the face of short ways from cut to cut, mm."""

_SHORT = 30.0


@dataclass(frozen=True)
class Linking:
    """How runs are joined.

    Parameters
    ----------
    machine : Machine
    cutting : Cutting
    reach : float
        Farthest end-to-start distance crossed without a retract, mm.
    ramp : bool
        Whether entries slope down along the run.
    """

    machine: Machine
    cutting: Cutting
    reach: float
    ramp: bool = False


def link(parts: Iterable[Pass], linking: Linking) -> tuple[Floats, Floats]:
    """Join the runs of all passes.

    Returns
    -------
    (n, 3) ndarray
        Positions of the tip, mm; empty where there is nothing to cut.
    (n,) ndarray
        Feeds, mm/min, infinite for a rapid.
    """
    moves: list[tuple[Floats, bool]] = []
    safe = linking.machine.safe_height
    for part in parts:
        if not part.runs:
            continue
        runs, ceilings = _in_order(part, moves[-1][0][-1] if moves else np.zeros(3), linking)
        joins = _joins(part, runs, linking.reach)
        for k, run in enumerate(runs):
            if k in joins:
                moves.append((between(joins[k], moves[-1][0][-1], run[0]), False))
            else:
                moves.append((_approach(run, moves[-1][0][-1] if moves else None, safe), True))
                moves.append((entry(part, run, ceilings[k]) if linking.ramp else run[:0], False))
            moves.append((run, False))
    if not moves:
        return np.zeros((0, 3)), np.zeros(0)
    end = moves[-1][0][-1]
    moves.append((np.array([[end[0], end[1], safe]]), True))
    points = np.concatenate([piece for piece, _ in moves])
    rapid = np.repeat([fast for _, fast in moves], [len(piece) for piece, _ in moves])
    return points, _feeds(points, rapid, linking)


def _in_order(part: Pass, here: Floats, linking: Linking) -> tuple[list[Floats], list[float]]:
    """Turn a pass's runs the way they are cut, with the stock's height at their starts."""
    if part.fixed:
        return part.runs, [float(z) for z in part.ceiling[:, 0]]
    share = linking.cutting.feed / min(linking.machine.max_rate[:2])
    order, turned = arrange(part.runs, here, reach=linking.reach, share=share)
    pairs = list(zip(order, turned, strict=True))
    runs = [part.runs[k][::-1] if back else part.runs[k] for k, back in pairs]
    return runs, [float(part.ceiling[k, int(back)]) for k, back in pairs]


def _joins(part: Pass, runs: list[Floats], reach: float) -> dict[int, Floats]:
    """Find the moves from run to run that may stay down, by the later run's place."""
    near = [
        k for k in range(1, len(runs)) if np.hypot(*(runs[k][0, :2] - runs[k - 1][-1, :2])) <= reach
    ]
    pairs = [np.stack([runs[k - 1][-1, :2], runs[k][0, :2]]) for k in near]
    return dict(zip(near, at_depth(part, pairs), strict=True))


def between(way: Floats, start: Floats, end: Floats) -> Floats:
    """Leave out the ends of a way that the runs it joins have, too.

    Where a way was lifted off a jump in the ground, its ends are above theirs: the
    cutter rises there first, and comes down at the other end.
    """
    first = 0 if way[0, 2] > start[2] else 1
    last = len(way) if way[-1, 2] > end[2] else len(way) - 1
    return way[first:last]


def _approach(run: Floats, here: Floats | None, safe: float) -> Floats:
    """Retract from here, cross and come down above a run's start.

    Short ways stay within the figure, over a face known to be flat: a hop is enough.
    """
    x, y, z = run[0]
    if here is not None and np.hypot(x - here[0], y - here[1]) <= _SHORT:
        safe = min(safe, HOP)
    down = [[x, y, safe], [x, y, max(CLEARANCE, z)]]
    return np.array(down if here is None else [[here[0], here[1], safe], *down])


def _feeds(points: Floats, rapid: NDArray[np.bool_], linking: Linking) -> Floats:
    """Give every move the feed that its slope allows."""
    steps = np.diff(points, axis=0, prepend=points[:1])
    length = np.maximum(np.linalg.norm(steps, axis=1), 1e-9)
    rise = steps[:, 2]
    limit = np.where(rise < 0, linking.cutting.plunge, linking.machine.max_rate[2])
    allowed = limit * length / np.maximum(np.abs(rise), 1e-9)
    feed = np.minimum(linking.cutting.feed, allowed)
    even = np.maximum(np.floor(feed / 10 + 1e-9) * 10, np.minimum(feed, 10))
    return np.where(rapid, np.inf, even)
