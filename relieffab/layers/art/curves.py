"""Curves to polylines within a tolerance."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.art.art import Ring

Floats = NDArray[np.float64]

FINE = 5e-5
"""Tolerance against the larger side of all there is: 0.006 mm on 120 mm."""


def bezier(control: Floats, tolerance: float) -> Floats:
    """Sample a Bézier curve so finely that its chords are off by no more than a tolerance.

    A chord over a share h of the parameter is off by at most h²/8 of the largest
    second derivative, which differences of the control points bound.

    Parameters
    ----------
    control : (2, 3 or 4, 2) ndarray
        Control points.
    tolerance : float

    Returns
    -------
    (n, 2) ndarray
        From the first control point to the last.
    """
    degree = len(control) - 1
    pieces = 1
    if degree > 1:
        bend = np.hypot(*np.diff(control, 2, axis=0).T).max() * degree * (degree - 1)
        pieces = max(1, int(np.ceil(np.sqrt(bend / (8.0 * tolerance)))))
    t = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    points = [np.broadcast_to(p, (len(t), 2)) for p in control]
    while len(points) > 1:  # de Casteljau
        points = [(1 - t) * a + t * b for a, b in pairwise(points)]
    return np.array(points[0])


def ring(curves: Sequence[Floats], tolerance: float, *, closed: bool) -> Ring | None:
    """Join the curves of one contour; None if it is a point.

    Parameters
    ----------
    curves : sequence of (2, 3 or 4, 2) ndarray
        Control points, each beginning where the last ended.
    tolerance : float
    closed : bool
    """
    parts = [curves[0][:1], *(bezier(curve, tolerance)[1:] for curve in curves)]
    points = np.concatenate(parts)
    moved = np.append(True, (np.diff(points, axis=0) != 0).any(axis=1))
    points = points[moved]
    if closed and len(points) > 1 and (points[0] == points[-1]).all():
        points = points[:-1]
    return Ring(points, closed) if len(points) > 1 else None
