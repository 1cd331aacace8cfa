"""Fewer points: longer chords, above the surface and within a tolerance of it.

The funnel of slopes after Imai and Iri, "An optimal algorithm for approximating a
piecewise linear function" (J. Inform. Process. 9, 1986), with vertices at samples.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.trace import Trace

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_STEEPEST = 10.0
_ASIDE = 1e-5  # mm


@kernel
def _funnel(along, z, slack, fixed, keep, out):  # type: ignore[no-untyped-def]
    anchor, value = 0, z[0]
    keep[0], out[0] = True, value
    low, high = -np.inf, np.inf
    k = 1
    while k < z.size:
        if along[k] <= along[anchor]:
            keep[k], out[k] = True, z[k]
            anchor, value, low, high = k, z[k], -np.inf, np.inf
            k += 1
            continue
        step = along[k] - along[anchor]
        new_low = max(low, (z[k] - value) / step)
        new_high = min(high, (z[k] + slack[k] - value) / step)
        if new_low > new_high:
            anchor_step = along[k - 1] - along[anchor]
            value += low * anchor_step
            anchor = k - 1
            keep[anchor], out[anchor] = True, value
            low, high = -np.inf, np.inf
            continue
        low, high = new_low, new_high
        if fixed[k]:
            value += low * step
            anchor = k
            keep[k], out[k] = True, value
            low, high = -np.inf, np.inf
        k += 1


def _thinned(
    xy: Floats, z: Floats, joined: Bools, corner: Bools, tolerance: float
) -> tuple[Bools, Floats]:
    """Choose which samples stay, and how high; those at corners and ends stay where they are."""
    steps = np.where(joined, np.hypot(*np.diff(xy, axis=0).T), 0.0)
    slope = np.abs(np.diff(z)) / np.maximum(steps, 1e-9)
    slope = np.where(joined, slope, 0.0)
    gentler = np.minimum(np.append(slope, slope[-1]), np.insert(slope, 0, slope[0]))
    slack = tolerance * np.hypot(1.0, np.minimum(gentler, _STEEPEST))
    last = np.append(~joined, True)
    first = np.insert(~joined, 0, True)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    keep, out = np.zeros(len(z), bool), np.zeros(len(z))
    _funnel(along, z, slack, corner | last | first, keep, out)
    return keep, out


def simplify(trace: Trace, tolerance: float) -> Trace:
    """Drop samples; the rest may rise, never sink.

    Parameters
    ----------
    trace : Trace
    tolerance : float
        Largest distance to the line given, measured square to it, mm.

    Returns
    -------
    Trace
        Its chords lie on or above every sample given.
    """
    if len(trace) < 2:
        return trace
    keep, out = _thinned(trace.xy, trace.z, trace.joined, trace.corner, tolerance)
    return replace(trace, z=out).pick(keep)


def thin(path: Toolpath, tolerance: float) -> Toolpath:
    """Drop points of a whole toolpath; the rest may rise, never sink.

    Only moves at a feed that go straight on, seen from above, are joined; what they
    become goes at the least of their feeds.

    Parameters
    ----------
    path : Toolpath
    tolerance : float
        Largest distance to the path given, measured square to it, mm.

    Returns
    -------
    Toolpath
        Nowhere below the one given, but for `_ASIDE` sideways.
    """
    points, feed = path.points, path.feed
    if len(points) < 3 or tolerance <= 0:
        return path
    xy, z = points[:, :2], points[:, 2]
    steps = np.diff(xy, axis=0)
    joined = np.isfinite(feed[1:]) & (np.hypot(*steps.T) > 0)
    keep, out = _thinned(xy, z, joined, _turns(steps), tolerance)
    kept = np.flatnonzero(keep)
    # Of the moves from one kept point to the next, the slowest says how fast.
    slowest = np.minimum.reduceat(feed, np.append(0, kept[:-1] + 1))
    return replace(path, points=np.column_stack([xy[kept], out[kept]]), feed=slowest)


def _turns(steps: Floats) -> Bools:
    """Mark points where a line on the panel does not go straight on."""
    a, b = steps[:-1], steps[1:]
    lengths = np.hypot(*a.T), np.hypot(*b.T)
    cross = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    chord = np.maximum(np.hypot(*(a + b).T), 1e-12)
    ahead = np.einsum("ij,ij->i", a, b) > 0
    # The middle point's distance from the line between its neighbours, and no drift of many.
    straight = ahead & (cross / chord < _ASIDE) & (cross < 1e-6 * lengths[0] * lengths[1])
    return np.concatenate([[True], ~straight, [True]])
