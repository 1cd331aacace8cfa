"""The order in which runs are cut: each next the nearest, then with fewer long ways between.

The ways are shortened by turning stretches of the order round (2-opt: Croes, "A method
for solving traveling-salesman problems", Oper. Res. 6, 1958) and by moving stretches
elsewhere (Or-opt).
"""

from collections.abc import Sequence
from math import inf

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]

_LONG = 1.0  # mm: only ways longer than this are shortened
_AHEAD = 8  # long ways between the two ends of a stretch that is moved, at most
_EFFORT = 20_000_000  # ways looked at: under a second, and many times what reliefs ask for
_GAIN = 1e-9


@kernel
def _nearest_order(ends, x, y, order, turned):  # type: ignore[no-untyped-def]
    count = ends.shape[0]
    left = np.arange(count)
    for place in range(count):
        best, chosen, flip = np.inf, 0, False
        for k in range(count - place):
            run = left[k]
            for side in range(2):
                dx, dy = ends[run, side, 0] - x, ends[run, side, 1] - y
                distance = dx * dx + dy * dy
                if distance < best:
                    best, chosen, flip = distance, k, side == 1
        run = left[chosen]
        left[chosen] = left[count - place - 1]
        order[place], turned[place] = run, flip
        side = 0 if flip else 1
        x, y = ends[run, side, 0], ends[run, side, 1]


@kernel
def _cost(tour, i, a, j, b, reach, share):  # type: ignore[no-untyped-def]
    """Cost of the way from end `a` of run i to end `b` of run j; none beyond the last."""
    if j == tour.shape[0]:
        return 0.0
    away = np.hypot(tour[i, a, 0] - tour[j, b, 0], tour[i, a, 1] - tour[j, b, 1])
    return away if away <= reach else reach + share * (away - reach)


@kernel
def _turn(tour, order, turned, start, stop):  # type: ignore[no-untyped-def]
    """Turn the runs from start to before stop round."""
    tour[start:stop] = tour[start:stop][::-1, ::-1].copy()
    order[start:stop] = order[start:stop][::-1].copy()
    turned[start:stop] = ~turned[start:stop][::-1]


@kernel
def _turn_stretch(tour, order, turned, e, reach, share):  # type: ignore[no-untyped-def]
    """Turn round what lies between the way to run e and some other way, if that gains."""
    for f in range(1, tour.shape[0] + 1):
        p, q = min(e, f), max(e, f)
        if p == q:
            continue
        before = _cost(tour, p - 1, 1, p, 0, reach, share) + _cost(
            tour, q - 1, 1, q, 0, reach, share
        )
        after = _cost(tour, p - 1, 1, q - 1, 1, reach, share) + _cost(
            tour, p, 0, q, 0, reach, share
        )
        if after < before - _GAIN:
            _turn(tour, order, turned, p, q)
            return True
    return False


@kernel
def _move_stretch(tour, order, turned, e, g, reach, share):  # type: ignore[no-untyped-def]
    """Move the runs from e to before g into some other way, if that gains."""
    count = tour.shape[0]
    before = _cost(tour, e - 1, 1, e, 0, reach, share) + _cost(tour, g - 1, 1, g, 0, reach, share)
    saved = before - _cost(tour, e - 1, 1, g, 0, reach, share)
    for f in range(1, count + 1):
        if e <= f <= g:
            continue
        here = _cost(tour, f - 1, 1, f, 0, reach, share)
        for back in range(2):
            there = _cost(tour, f - 1, 1, g - 1 if back else e, back, reach, share)
            there += _cost(tour, e if back else g - 1, 1 - back, f, 0, reach, share)
            if there - here >= saved - _GAIN:
                continue
            if not back:
                _turn(tour, order, turned, e, g)
            if f > g:
                _turn(tour, order, turned, g, f)
                _turn(tour, order, turned, e, f)
            else:
                _turn(tour, order, turned, f, e)
                _turn(tour, order, turned, f, g)
            return True
    return False


@kernel
def _improve(tour, order, turned, reach, share):  # type: ignore[no-untyped-def]
    """Shorten the long ways until none can be; row 0 of the tour stays where it is."""
    count, effort, better = tour.shape[0], 0, True
    while better:
        better = False
        for e in range(1, count):
            if _cost(tour, e - 1, 1, e, 0, reach, share) <= _LONG:
                continue
            if effort > _EFFORT:
                return
            effort += count
            found = _turn_stretch(tour, order, turned, e, reach, share)
            g, seen = e + 1, 0
            while not found and g <= count and seen < _AHEAD:
                if g == count or _cost(tour, g - 1, 1, g, 0, reach, share) > _LONG:
                    seen += 1
                    effort += count
                    found = _move_stretch(tour, order, turned, e, g, reach, share)
                g += 1
            better |= found


def arrange(
    runs: Sequence[Floats], start: Floats, *, reach: float = inf, share: float = 1.0
) -> tuple[list[int], list[bool]]:
    """Order runs so that the ways between them cost little.

    Parameters
    ----------
    runs : sequence of (k, 2 or 3) ndarray
    start : ndarray
        Where the cutter comes from.
    reach : float
        Longest way that goes without a retract, mm.
    share : float
        Cost of a mm beyond that, which goes at a rapid, where a mm before costs 1.

    Returns
    -------
    list of int, list of bool
        Which run comes when, and whether it is cut backwards.
    """
    if len(runs) == 0:
        return [], []
    ends = np.array([[run[0, :2], run[-1, :2]] for run in runs], dtype=np.float64)
    order, turned = np.zeros(len(runs), np.int64), np.zeros(len(runs), np.bool_)
    _nearest_order(ends, float(start[0]), float(start[1]), order, turned)
    # The start is a run of no length that comes first.
    tour = np.concatenate([np.broadcast_to(start[:2], (1, 2, 2)), ends[order]])
    tour[1:][turned] = tour[1:][turned][:, ::-1]
    order, turned = np.append(-1, order), np.append(False, turned)
    _improve(tour, order, turned, reach, share)
    return order[1:].tolist(), turned[1:].tolist()
