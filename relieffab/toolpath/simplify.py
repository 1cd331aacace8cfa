"""Fewer points: longer chords, above the surface and within a tolerance of it.

The funnel of slopes after Imai and Iri, "An optimal algorithm for approximating a
piecewise linear function" (J. Inform. Process. 9, 1986), with vertices at samples.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.toolpath.trace import Trace

Floats = NDArray[np.float64]

_STEEPEST = 10.0


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
    joined = trace.joined
    steps = np.where(joined, trace.steps, 0.0)
    slope = np.abs(np.diff(trace.z)) / np.maximum(steps, 1e-9)
    slope = np.where(joined, slope, 0.0)
    gentler = np.minimum(np.append(slope, slope[-1]), np.insert(slope, 0, slope[0]))
    slack = tolerance * np.hypot(1.0, np.minimum(gentler, _STEEPEST))
    last = np.append(~joined, True)
    first = np.insert(~joined, 0, True)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    keep, out = np.zeros(len(trace), bool), np.zeros(len(trace))
    _funnel(along, trace.z, slack, trace.corner | last | first, keep, out)
    return replace(trace, z=out).pick(keep)
