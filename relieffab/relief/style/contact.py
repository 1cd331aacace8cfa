"""Where a tip's axis stands so that it touches a slope at a place, and whether it does."""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from relieffab.cutter import Cutter
from relieffab.relief.reach import lowest_tips
from relieffab.relief.style.texture import tip_table

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


def guarded_tips(
    heights: Floats, clear: Bools, pitch: float, cutter: Cutter, deep: float
) -> Floats:
    """Find the lowest places from which a cutter can still go down by a mark's depth.

    On its way down it may touch clear ground alone, with as much of its tip as marks are
    made of (`tip_table`).  All else counts as higher by the depth.

    Parameters
    ----------
    heights : (n, m) ndarray
        Of the surface at nodes, mm, none above 0.
    clear : (n, m) ndarray of bool
        Nodes that marks may take.
    pitch : float
        mm.
    cutter : Cutter
    deep : float
        Of the marks, mm.

    Returns
    -------
    (n, m) ndarray
        mm.
    """
    _, reach = tip_table(cutter, deep)

    def profile(r: ArrayLike) -> Floats:
        return cutter.profile(r) - np.where(np.asarray(r) > reach, deep, 0.0)

    return lowest_tips(np.where(clear, heights - deep, heights), pitch, profile) + deep


def kept_up(
    heights: Floats, tips: Floats, places: Floats, axis: Floats, cutter: Cutter, pitch: float
) -> Floats:
    """Find how far above the places it is to touch a cutter is kept by something else.

    A wall beside a narrow floor holds it up, say: pressed on, it would mark the wall.

    Parameters
    ----------
    heights : (n, m) ndarray
        Of the surface at nodes, mm.
    tips : (n, m) ndarray
        Its lowest places: from `reach.lowest_tips`, or `guarded_tips`, mm.
    places, axis : (k, 2) ndarray
        Rows and columns, from `axes`.
    cutter : Cutter
    pitch : float
        mm.

    Returns
    -------
    (k,) ndarray
        mm; 0 where it touches, to the lattice's grain.
    """
    tip, ground = (
        ndimage.map_coordinates(image, at.T, order=1, mode="nearest")
        for image, at in ((tips, axis), (heights, places))
    )
    return tip + cutter.profile(np.hypot(*(axis - places).T) * pitch) - ground  # type: ignore[no-any-return]
