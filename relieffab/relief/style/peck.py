"""A pecked ground: round dimples at random, no two nearer than their spacing."""

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.style.scatter import scatter

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

UNEVEN = 0.15  # share by which their depths differ from the one asked for, at most


def pecks(
    where: Bools, apart: float, depth: float, chance: np.random.Generator
) -> list[tuple[Floats, Floats]]:
    """Scatter pecks.

    Parameters
    ----------
    where : (n, m) ndarray of bool
        Nodes where a peck may have its middle.
    apart : float
        Least distance of two, pixels.
    depth : float
        mm.
    chance : numpy.random.Generator

    Returns
    -------
    list of tuple of (2, 2) and (2,) ndarray
        Row and column, twice, and depth in mm: strokes that end where they start.
    """
    places = scatter(where, apart, chance)
    deep = depth * chance.uniform(1 - UNEVEN, 1 + UNEVEN, len(places))
    return [
        (np.stack([place, place]), np.array([one, one]))
        for place, one in zip(places, deep, strict=True)
    ]
