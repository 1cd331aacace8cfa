"""Which parts of a line can be seen, and what lies beyond them."""

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

STEP = 6.0
"""Slope from pixel to pixel that parts one surface from another, mm/mm."""
STEEPEST = 4.0
"""Slope beyond which a pixel's depth is taken to lie no further off, mm/mm."""


def look_up(image: Floats, x: Floats, y: Floats, grid: Grid, outside: float) -> Floats:
    """Read an image at the pixels under points; `outside` where there is none."""
    row, col = (np.floor(index).astype(np.int64) for index in grid.to_index(x, y))
    inside = (row >= 0) & (row < grid.rows) & (col >= 0) & (col < grid.cols)
    values = image[np.clip(row, 0, grid.rows - 1), np.clip(col, 0, grid.cols - 1)]
    return np.where(inside, values, outside)


def in_pixels(chains: Chains, grid: Grid) -> tuple[Floats, Floats]:
    """Points and the directions their normals point to, as seen, in rows and columns.

    Returns
    -------
    points : (n, 2) ndarray
        Row and column; pixel centres are at whole numbers.
    outward : (n, 2) ndarray
        Unit; 0 where the normal points straight to the viewer.
    """
    row, col = grid.to_index(chains.points[:, 0], chains.points[:, 1])
    outward = np.stack([-chains.normals[:, 1], chains.normals[:, 0]], axis=1)
    length = np.hypot(outward[:, 0], outward[:, 1])[:, None]
    return np.stack([row - 0.5, col - 0.5], axis=1), outward / np.maximum(length, 1e-9)


def visible(chains: Chains, depth: Floats, grid: Grid) -> Flags:
    """Tell which points lie at the depth that is seen, or nearer.

    A line can lie up to a triangle away from where the drawn surface turns, and
    a pixel's depth is that of its centre.  So the depth seen is the farthest of
    3 x 3 pixels, and a point passes if it is no deeper than that by more than a
    pixel on the local slope and the local triangles seen from the side.

    Parameters
    ----------
    chains : Chains
    depth : (rows, cols) ndarray
        mm, larger is nearer, -inf where nothing is seen.
    grid : Grid

    Returns
    -------
    (n,) ndarray of bool
    """
    x, y, z = chains.points.T
    sine = np.hypot(chains.normals[:, 0], chains.normals[:, 1])
    slope = np.minimum(sine / np.maximum(np.abs(chains.normals[:, 2]), 1e-9), STEEPEST)
    tolerance = grid.pitch * (0.5 + slope) + 1.5 * chains.slack * sine
    seen = np.zeros(len(z), bool)
    for down in (-1, 0, 1):
        for across in (-1, 0, 1):
            at = look_up(depth, x + across * grid.pitch, y + down * grid.pitch, grid, -np.inf)
            seen |= at <= z + tolerance
    return seen


def borders_background(chains: Chains, mask: Flags, grid: Grid, *, reach: float) -> Flags:
    """Tell which points of a contour have nothing of the figure beyond them.

    Parameters
    ----------
    chains : Chains
        Contours: the surface ends there in the direction of its normal.
    mask : (rows, cols) ndarray of bool
        The figure.
    grid : Grid
    reach : float
        How far beyond to look, mm, besides a quarter of the local triangles.

    Returns
    -------
    (n,) ndarray of bool
    """
    outward = chains.normals[:, :2]
    length = np.maximum(np.hypot(outward[:, 0], outward[:, 1]), 1e-9)
    beyond = ((reach + 0.25 * chains.slack) / length)[:, None] * outward + chains.points[:, :2]
    return look_up(mask.astype(float), beyond[:, 0], beyond[:, 1], grid, 0.0) < 0.5
