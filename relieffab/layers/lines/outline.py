"""The figure's outer outline, taken from the pixels it covers."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from skimage import measure

from relieffab.grid import Grid

Floats = NDArray[np.float64]


def outlines(mask: NDArray[np.bool_], grid: Grid, *, blur: float = 1.0) -> list[Floats]:
    """Trace the edge of the figure finer than its pixels.

    Parameters
    ----------
    mask : (rows, cols) ndarray of bool
        The figure at pixel centres.
    grid : Grid
    blur : float
        Deviation of the Gaussian that takes the stairs off, pixels.

    Returns
    -------
    list of (n, 2) ndarray
        Closed polylines, X and Y in mm, the first point not repeated: one round
        each body of the figure and one round each hole in it.
    """
    if not mask.any():
        return []
    border = 4
    used = [np.flatnonzero(mask.any(axis=1 - axis))[[0, -1]] for axis in range(2)]
    (top, bottom), (left, right) = used
    figure = mask[top : bottom + 1, left : right + 1].astype(np.float32)
    cover = ndimage.gaussian_filter(np.pad(figure, border), blur)
    lines = []
    for line in measure.find_contours(cover, 0.5):
        x, y = grid.to_xy(line[:, 0] + top - border + 0.5, line[:, 1] + left - border + 0.5)
        lines.append(np.stack([x, y], axis=1)[:-1])
    return lines
