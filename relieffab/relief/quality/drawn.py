"""Where the lines of the drawing run inside the figure, and where the surface beside them is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.model import Layers, Stroke
from relieffab.relief.quality.pair import Pair

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FAINT = 0.1  # ink or strength up to which no line counts as drawn
ON = 1.0  # pixels from a line that are on it
OFF = (4.0, 8.0)  # pixels from a line that are the surface beside it


def _along(stroke: Stroke, step: float) -> Floats:
    """Points in the middle of even pieces of a stroke about `step` mm long, (n, 3).

    X, Y and strength.
    """
    table = np.column_stack([stroke.points, stroke.strength])
    if stroke.closed:
        table = np.vstack([table, table[:1]])
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(table[:, :2], axis=0).T))])
    pieces = round(arc[-1] / step)
    at = (np.arange(pieces) + 0.5) / max(pieces, 1) * arc[-1]
    return np.stack([np.interp(at, arc, column) for column in table.T], axis=1)


def centre_points(layers: Layers) -> Floats:
    """Points along the dark lines of the drawing, one for each pixel's side of length.

    Taken from the strokes; where there are none, the middle of the ink, thinned to
    a pixel's width.

    Returns
    -------
    (n, 2) ndarray
        Row and column in node indices, fractional.
    """
    dark = [stroke for stroke in layers.strokes if not stroke.light]
    if not dark:
        from skimage.morphology import skeletonize

        return np.argwhere(skeletonize(layers.lines > FAINT)).astype(np.float64) + 0.5
    x, y, strength = np.concatenate([_along(stroke, layers.pitch) for stroke in dark]).T
    row, col = layers.grid.to_index(x, y)
    points = np.column_stack([row, col])
    within = ((points >= 0) & (points < layers.grid.shape)).all(axis=1)
    return points[within & (strength > FAINT)]  # type: ignore[no-any-return]


@dataclass(frozen=True, eq=False)
class Drawn:
    """The drawn lines that run through Ms.

    Outlines do not: they are where the figure ends, not a groove in it.

    Parameters
    ----------
    points : (n, 2) ndarray
        Along them, a pixel's side apart; row and column in node indices.
    on : (rows, cols) ndarray of bool
        Pixels of Ms within 1 pixel of them.
    off : (rows, cols) ndarray of bool
        Pixels of Ms 4 to 8 pixels from the nearest of them, and no nearer than 4
        to any other line of the drawing.
    """

    points: Floats
    on: Bools
    off: Bools


def drawn(pair: Pair) -> Drawn:
    """Find the lines inside the figure and the surface beside them."""
    points = centre_points(pair.layers)
    cells = points.astype(np.int64)
    inside = pair.inner[cells[:, 0], cells[:, 1]]
    away = [_distance(cells[chosen], pair.inner.shape) for chosen in (inside, ~inside)]
    on = pair.inner & (away[0] <= ON)
    off = pair.inner & (away[0] >= OFF[0]) & (away[0] <= OFF[1]) & (away[1] >= OFF[0])
    return Drawn(points[inside], on, off)


def _distance(cells: NDArray[np.int64], shape: tuple[int, int]) -> Floats:
    """Distance of every pixel to the nearest of some, infinite if there are none."""
    if not len(cells):
        return np.full(shape, np.inf)
    free = np.ones(shape, bool)
    free[cells[:, 0], cells[:, 1]] = False
    return ndimage.distance_transform_edt(free)  # type: ignore[no-any-return]
