"""Edges inside a figure behind which it may hide part of itself, told by its normals alone."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SIGNS = ((0.5, 45.0, 0.2), (0.25, 8.0, 0.08))
"""n.v of the side that turns away, at most; the turn to the other side, degrees, and how much less
that one leans the same way, at least: any of these is a sign."""
LEAN = 0.3
"""Of the side that turns away, towards the other one, at least."""
STAIRS = np.pi / 4
"""Length of a line against that of the pixels' edges along it, in the mean of all ways."""


def rims_of(normals: Floats, mask: Bools) -> tuple[Bools, Bools]:
    """Find where a surface turns away from the viewer and another goes on behind it.

    The step from one to the other is in no normal.

    Parameters
    ----------
    normals : (rows, cols, 3) ndarray
        Unit vectors that face the viewer.
    mask : (rows, cols) ndarray of bool
        The figure.

    Returns
    -------
    across : (rows, cols - 1) ndarray of bool
        Between a pixel and its right neighbour.
    down : (rows - 1, cols) ndarray of bool
        Between a pixel and its lower one.
    """
    turned = normals.swapaxes(0, 1) * [1.0, -1.0, 1.0]  # so that down is the way of larger Y
    across = _rims(normals, mask, 0)
    return across, _rims(turned, mask.T, 1).T


def _rims(normals: Floats, mask: Bools, way: int) -> Bools:
    """Find them along the rows, which run the way of X (0) or Y (1)."""
    before, after = normals[:, :-1], normals[:, 1:]
    cosine = (before * after).sum(axis=2)
    back = before[..., way] - after[..., way]
    found = np.zeros(cosine.shape, bool)
    for facing, turn, less in SIGNS:
        away = (before[..., 2] < facing) & (before[..., way] > LEAN)
        away |= (after[..., 2] < facing) & (after[..., way] < -LEAN)
        found |= away & (cosine < np.cos(np.radians(turn))) & (back > less)
    return np.asarray(found & mask[:, :-1] & mask[:, 1:], bool)


def rim_length(normals: Floats, mask: Bools, pitch: float) -> float:
    """Tell how long these edges are together, mm."""
    return float(STAIRS * pitch * sum(int(rims.sum()) for rims in rims_of(normals, mask)))
