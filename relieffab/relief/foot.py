"""What a tip leaves of a floor inside its wall: the foot between them is an arc."""

from math import hypot

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.edge import steepness
from relieffab.relief.reach import ball, closing
from relieffab.relief.targets import Carving

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

LEAST = 0.5  # pixels: radius of an arc whose nodes lie on both sides of it


def stand(floor: Floats, edge: Floats, slope: float, radius: float) -> Floats:
    """Put a wall around a floor, with an arc at its foot that touches both.

    Parameters
    ----------
    floor : (n, m) ndarray
        mm, none above 0.
    edge : (n, m) ndarray
        Of the wall, mm: 0 at the figure's edge.
    slope : float
        Of the wall.
    radius : float
        Of the arc, more than 0, mm.

    Returns
    -------
    (n, m) ndarray
        mm; nowhere below either nor above 0.
    """
    upright = 1.0 / hypot(1.0, slope)  # the wall's unit normal
    level = slope * upright
    middle = (radius - (floor + radius) * upright) / level
    back = np.clip(middle + edge / slope, 0.0, radius * level)
    arc = floor + radius - np.sqrt(radius**2 - back**2)
    rounded = np.where(back < radius * level, arc, edge)
    return np.minimum(np.maximum(rounded, np.maximum(floor, edge)), 0.0)


def carved(heights: Floats, figure: Bools, edge: Floats, pitch: float, carving: Carving) -> Floats:
    """Wall a floor in, and fill what the tip does not reach.

    Floor and wall are filled each for itself, where neither has slopes that a tip on
    the lattice's nodes would miss by up to half a pixel: closed together, the foot of
    a slanted wall becomes a row of dots.

    Parameters
    ----------
    heights : (n, m) ndarray
        mm, none above 0 in the figure.
    figure : (n, m) ndarray of bool
    edge : (n, m) ndarray
        Lowest heights that leave a wall, from `edge.wall`, mm.
    pitch : float
        mm.
    carving : Carving

    Returns
    -------
    (n, m) ndarray
        mm; nowhere below heights or edge in the figure, 0 outside.
    """
    tip = ball(carving.fillet)
    floor = closing(np.where(figure, heights, heights[figure].min()), pitch, tip)
    slope = steepness(pitch, carving.wall_angle, carving.depth)
    return stand(
        np.where(figure, np.minimum(floor, 0.0), 0.0),
        np.minimum(closing(edge, pitch, tip), 0.0),
        slope,
        max(carving.fillet, LEAST * pitch),
    )
