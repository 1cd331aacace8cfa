"""Where a round tip's axis stands so that it touches a slope at a place."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

EVEN = 0.25  # mm over which normals are evened out


def leaning(heights: Floats, pitch: float, clear: Bools) -> Floats:
    """Find how far a surface's unit normals lean, from nodes that no wall or line is beside.

    Parameters
    ----------
    heights : (n, m) ndarray
        At nodes, mm.
    pitch : float
        mm.
    clear : (n, m) ndarray of bool
        Nodes of smooth ground.

    Returns
    -------
    (2, n, m) ndarray
        The normals' parts along rows and columns' axes, evened out within clear ground.
    """
    inner = ndimage.binary_erosion(clear, np.ones((3, 3)))
    down, across = np.gradient(heights, pitch)
    weight = ndimage.gaussian_filter(inner.astype(float), EVEN / pitch)
    slopes = [
        ndimage.gaussian_filter(np.where(inner, part, 0.0), EVEN / pitch) / np.maximum(weight, 1e-6)
        for part in (down, across)
    ]
    upright = np.sqrt(1.0 + slopes[0] ** 2 + slopes[1] ** 2)
    return -np.stack(slopes) / upright


def axes(places: Floats, lean: Floats, radius: float) -> Floats:
    """Move places that a tip is to touch to where its axis then stands.

    A ball of radius R that touches a surface at p, where its normal is n, has its
    middle at p + R n.  Strokes set by the axis instead would lie closer together on round
    forms, and further apart in hollow ones.

    Parameters
    ----------
    places : (k, 2) ndarray
        Rows and columns.
    lean : (2, n, m) ndarray
        From `leaning`.
    radius : float
        Of the tip, pixels.

    Returns
    -------
    (k, 2) ndarray
    """
    moved = [ndimage.map_coordinates(part, places.T, order=1, mode="nearest") for part in lean]
    return places + radius * np.stack(moved, axis=1)
