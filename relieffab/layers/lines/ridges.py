"""Ridges and valleys of a surface, and apparent ridges of what is seen of it.

Y. Ohtake, A. Belyaev and H.-P. Seidel, "Ridge-valley lines on meshes via implicit
surface fitting", SIGGRAPH 2004; T. Judd, F. Durand and E. Adelson, "Apparent
ridges for line drawing", SIGGRAPH 2007.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.contours import fading
from relieffab.layers.lines.slopes import slope, slope_of_directed
from relieffab.layers.lines.surface import Surface
from relieffab.layers.lines.zeros import zero_set

Floats = NDArray[np.float64]

LEAST_BENDING = 0.1
"""Curvature worth a ridge, in 1/fs; its square, in 1/fs^2, an apparent one."""
MOST_ASLANT = 0.05
"""Least n.v that foreshortening is reckoned with."""


def _strongest(surface: Surface, sign: float) -> Chains:
    """Where k1, of one sign, is largest along its own direction: its derivative C0 = 0."""
    e1 = surface.bend.directions[0]
    change = surface.bend.derivative[0]
    k1 = sign * surface.bend.principal[0]
    falls = sign * slope_of_directed(surface, change, e1) < 0

    def strength(carried: Floats) -> Floats:
        bending, peak = carried
        return np.where(peak > 0.5, fading(bending, LEAST_BENDING), 0.0)

    carried = np.stack([k1 * surface.size, falls.astype(np.float64)])
    return zero_set(surface, change, carried, strength, along=e1)


def ridges(surface: Surface) -> Chains:
    """Lines along which a convex surface bends most."""
    return _strongest(surface, 1.0)


def valleys(surface: Surface) -> Chains:
    """Lines along which a concave surface bends most."""
    return _strongest(surface, -1.0)


def seen_bending(surface: Surface) -> tuple[Floats, Floats]:
    """Most that the normal turns per mm on the picture, and which way on the surface.

    With P the projection along the view, that foreshortens by n.v along the
    view's tangential part, the normal turns by S P^-1 per mm seen (Judd 2007,
    sec. 3): the larger singular value, and P^-1 of its right vector.

    Returns
    -------
    bending : (v,) ndarray
        1/mm.
    along : (v, 3) ndarray
        One mm on the picture; of no given sense.
    """
    u, w = surface.in_principal_frame()
    sine = np.maximum(np.hypot(u, w), 1e-9)
    u, w = u / sine, w / sine
    stretch = 1 / np.clip(np.abs(surface.facing), MOST_ASLANT, 1.0) - 1
    unseen = np.stack([1 + stretch * u * u, stretch * u * w, 1 + stretch * w * w])  # P^-1
    k1, k2 = surface.bend.principal
    a, b = k1 * unseen[0], k1 * unseen[1]
    c, d = k2 * unseen[1], k2 * unseen[2]
    e, m, g = a * a + c * c, a * b + c * d, b * b + d * d  # (S P^-1)^T (S P^-1)
    half = np.hypot((e - g) / 2, m)
    turn = np.arctan2(m, (e - g) / 2) / 2
    x, y = np.cos(turn), np.sin(turn)
    e1, e2 = surface.bend.directions
    along = (unseen[0] * x + unseen[1] * y)[:, None] * e1
    along += (unseen[1] * x + unseen[2] * y)[:, None] * e2
    return np.sqrt((e + g) / 2 + half), along


def apparent_ridges(surface: Surface) -> Chains:
    """Lines along which the surface seems to bend most, as seen."""
    bending, along = seen_bending(surface)
    change = slope(surface, bending, along)
    falls = slope_of_directed(surface, change, along) < 0

    def strength(carried: Floats) -> Floats:
        facing, square, peak = carried
        shows = surface.may_show(facing) & (peak > 0.5)
        return np.where(shows, fading(square, LEAST_BENDING), 0.0)

    carried = np.stack([surface.facing, (bending * surface.size) ** 2, falls.astype(np.float64)])
    return zero_set(surface, change, carried, strength, along=along)
