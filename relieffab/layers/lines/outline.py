"""The figure's outer outline, taken from the pixels it covers."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from skimage import measure

from relieffab.grid import Grid
from relieffab.layers.lines.trace import soften

Floats = NDArray[np.float64]

BLUR = 0.5
"""Deviation of the Gaussian that rounds the pixels' corners, pixels."""
SOFTNESS = 2.5
"""Deviation of the Gaussian along the line that takes the stairs off, pixels."""
FARTHEST = 0.45
"""How far it may move the line, pixels: stairs, but not a finger one pixel wide."""
STEP = 0.5
"""Between samples, pixels."""


def outlines(mask: NDArray[np.bool_], grid: Grid) -> list[Floats]:
    """Trace the edge of the figure finer than its pixels.

    Parameters
    ----------
    mask : (rows, cols) ndarray of bool
        The figure at pixel centres.
    grid : Grid

    Returns
    -------
    list of (n, 2) ndarray
        Closed polylines, X and Y in mm, the first point not repeated: one round
        each body of the figure and one round each hole in it, within half a pixel
        of the mask's own edge.
    """
    if not mask.any():
        return []
    border = 4
    used = [np.flatnonzero(mask.any(axis=1 - axis))[[0, -1]] for axis in range(2)]
    (top, bottom), (left, right) = used
    figure = mask[top : bottom + 1, left : right + 1].astype(np.float32)
    cover = ndimage.gaussian_filter(np.pad(figure, border), BLUR)
    lines = []
    for line in measure.find_contours(cover, 0.5):
        row, col = _calm(line).T
        x, y = grid.to_xy(row + top - border + 0.5, col + left - border + 0.5)
        lines.append(np.stack([x, y], axis=1))
    return lines


def _calm(line: Floats) -> Floats:
    """Sample a closed line (its first point repeated) evenly and smooth it within bounds."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0, arc[-1], max(int(arc[-1] / STEP), 4), endpoint=False)
    even = np.stack([np.interp(at, arc, column) for column in line.T], axis=1)
    moved = soften(even, SOFTNESS / STEP, closed=True) - even
    far = np.hypot(*moved.T)[:, None]
    return even + moved * np.minimum(1.0, FARTHEST / np.maximum(far, FARTHEST))
