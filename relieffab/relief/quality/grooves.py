"""Grooves under the lines: how deep they are and how wide."""

from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]

TURNS = 8  # directions in which a groove may lie across the line, over half a turn
BESIDE = 0.75  # mm from the line at which the surface beside it is taken: past a usual stroke
CLEAR = 3.0  # pixels that it is away at least
SLACK = (-1.0, 0.0, 1.0)  # pixels by which a groove may lie beside its line
FINE = 0.25  # pixels between samples where widths are taken


def section(heights: Floats, points: Floats, way: Floats, along: Floats) -> Floats:
    """Heights on straight sections through points, bilinear between nodes.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    points : (n, 2) ndarray
        Row and column in node indices, fractional.
    way : (n, 2) or (2,) ndarray
        Unit vectors.
    along : (k,) ndarray
        Where on the section, pixels from the point.

    Returns
    -------
    (n, k) ndarray
        mm.
    """
    at = points[:, None] + along[:, None] * np.atleast_2d(way)[:, None]
    return ndimage.map_coordinates(  # type: ignore[no-any-return]
        heights, np.moveaxis(at, -1, 0), order=1, mode="nearest"
    )


def beside(pitch: float) -> float:
    """How far from a line the surface beside it is taken, pixels.

    Parameters
    ----------
    pitch : float
        mm.
    """
    return max(BESIDE / pitch, CLEAR)


def below_sides(heights: Floats, points: Floats, way: Floats, along: Floats, side: float) -> Floats:
    """How far sections lie below the surface on either side of them.

    That surface, taken at `side` and at twice as far on either side, is carried on
    straight across; the lower of the two counts.  A slope is nowhere below it, nor
    is a step or the edge of a roof.

    Parameters
    ----------
    heights, points, way, along
        As `section` takes them.
    side : float
        Pixels.

    Returns
    -------
    (n, k) ndarray
        mm, negative above the surface.
    """
    far_left, left, right, far_right = section(
        heights, points, way, np.array([-2.0, -1.0, 1.0, 2.0]) * side
    ).T[:, :, None]
    from_left = left + (1.0 + along / side) * (left - far_left)
    from_right = right + (1.0 - along / side) * (right - far_right)
    return np.minimum(from_left, from_right) - section(heights, points, way, along)  # type: ignore[no-any-return]


def groove_depths(heights: Floats, points: Floats, side: float) -> tuple[Floats, Floats]:
    """How deep the surface is cut at points of a line.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    points : (n, 2) ndarray
        Row and column in node indices, fractional.
    side : float
        How far away the surface beside the line is taken, pixels.

    Returns
    -------
    depth : (n,) ndarray
        Below the surface on either side, the most within a pixel of the point and
        over eight directions, mm; 0 or less where there is no groove.
    way : (n, 2) ndarray
        The direction across the groove, rows and columns.
    """
    depth = np.full(len(points), -np.inf)
    way = np.zeros((len(points), 2))
    for turn in np.arange(TURNS) * pi / TURNS:
        here = np.array([sin(turn), cos(turn)])
        found = below_sides(heights, points, here, np.array(SLACK), side).max(axis=1)
        better = found > depth
        depth[better], way[better] = found[better], here
    return depth, way


def groove_widths(heights: Floats, points: Floats, way: Floats, side: float) -> Floats:
    """How wide grooves are at half their depth.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    points : (n, 2) ndarray
        Row and column in node indices, fractional; all in a groove.
    way : (n, 2) ndarray
        Across the grooves.
    side : float
        As for the depths.

    Returns
    -------
    (n,) ndarray
        Pixels, to a quarter; none more than twice `side`.
    """
    reach = np.arange(FINE, side, FINE)
    along = np.concatenate([-reach[::-1], [0.0], reach])
    below = below_sides(heights, points, way, along, side)
    near = np.abs(along) <= max(SLACK)
    deepest = np.argmax(np.where(near, below, -np.inf), axis=1)[:, None]
    shallow = below < np.take_along_axis(below, deepest, axis=1) / 2
    index, count = np.arange(len(along)), len(along)
    left = np.where(shallow & (index < deepest), index, -1).max(axis=1)
    right = np.where(shallow & (index > deepest), index, count).min(axis=1)
    return (right - left - 1) * FINE
