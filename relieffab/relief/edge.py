"""The figure's edge: walls with a draft."""

from math import radians, tan

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SHARPEST = 8.0  # of the depth, that a wall falls in a pixel: all of it in two thirds of one
STAIR = 0.2  # pixels, more than a straight edge's staircase adds after the lesser smoothing


def inward_distance(mask: Bools) -> Floats:
    """Distance of nodes to the figure's edge, positive inside, in pixels.

    The mask's staircase is smoothed away, so that the edge runs between nodes.  That takes
    most from crests, which are all that a thin stroke has: they are smoothed less.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
    """
    padded = np.pad(mask, 1)
    inside = ndimage.distance_transform_edt(padded)
    outside = ndimage.distance_transform_edt(~padded)
    signed = np.where(padded, inside - 0.5, 0.5 - outside)
    smooth, crests = (_at_nodes(ndimage.gaussian_filter(signed, sigma)) for sigma in (2.0, 1.0))
    return np.maximum(smooth, crests - STAIR)


def _at_nodes(field: Floats) -> Floats:
    """Mean of the four padded pixels round each node."""
    return (field[:-1, :-1] + field[:-1, 1:] + field[1:, :-1] + field[1:, 1:]) / 4


def steepness(pitch: float, angle: float, depth: float) -> float:
    """Slope of a wall at an angle in degrees, at most what pixels can show."""
    return min(tan(radians(angle)), SHARPEST * depth / pitch)


def wall(mask: Bools, pitch: float, angle: float, depth: float) -> Floats:
    """Lowest heights that leave a drafted wall at the figure's edge.

    Parameters
    ----------
    mask : (rows, cols) ndarray of bool
    pitch : float
        mm.
    angle : float
        Of the wall against the panel's face, degrees; 90 for a free one, as steep as
        pixels can be.
    depth : float
        Of the relief, mm.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        mm, 0 at the edge and outside.  The upper corner is eased over two pixels,
        so that a slanted edge does not show the lattice's steps.
    """
    inside = np.maximum(inward_distance(mask), 0.0)
    eased = np.where(inside < 2.0, inside**2 / 4.0, inside - 1.0)
    return -steepness(pitch, angle, depth) * pitch * eased
