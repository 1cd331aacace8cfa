"""A pecked ground: round dimples at random, no two nearer than their spacing."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

UNEVEN = 0.15  # share by which their depths differ from the one asked for, at most


def pecks(
    room: Floats, apart: float, least: float, depth: float, chance: np.random.Generator
) -> list[tuple[Floats, Floats]]:
    """Scatter pecks over an area as a Poisson disk sample.

    Bridson, "Fast Poisson disk sampling in arbitrary dimensions" (SIGGRAPH sketches, 2007),
    as SciPy has it.

    Parameters
    ----------
    room : (n, m) ndarray
        Distance from what bounds the area, pixels; 0 beyond it.
    apart : float
        Least distance of two, pixels.
    least : float
        Least distance from the bounds, pixels.
    depth : float
        mm.
    chance : numpy.random.Generator

    Returns
    -------
    list of tuple of (1, 2) and (1,) ndarray
        Row and column, and depth in mm.
    """
    from scipy.stats import qmc

    sides = np.array(room.shape, float) - 1
    disk = qmc.PoissonDisk(2, radius=apart, l_bounds=(0, 0), u_bounds=tuple(sides), rng=chance)
    places = disk.fill_space()
    i, j = np.rint(places).astype(int).T
    places = places[room[i, j] >= least]
    deep = depth * chance.uniform(1 - UNEVEN, 1 + UNEVEN, len(places))
    return [(place[None], one[None]) for place, one in zip(places, deep, strict=True)]
