"""Depth contours: where a relief lies a whole number of steps below the face."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.model import Relief

Floats = NDArray[np.float64]

TOLERANCE = 0.03  # mm by which a contour is simplified: a fifth of a hair line
SHORTEST = 2.0  # mm round; less is a speck nobody carves by


@dataclass(frozen=True, eq=False)
class Contour:
    """A closed line of one depth.

    Parameters
    ----------
    points : (n, 2) ndarray
        X and Y on the panel, mm; the first point is not repeated.
    level : int
        How many steps below the face, from 1.
    depth : float
        mm below the face.
    """

    points: Floats
    level: int
    depth: float

    @property
    def length(self) -> float:
        """Round it, mm."""
        return float(np.hypot(*(np.roll(self.points, -1, axis=0) - self.points).T).sum())


def depth_contours(relief: Relief, step: float) -> list[Contour]:
    """Find the lines at depths of `step`, 2 `step` and so on, above the deepest.

    Parameters
    ----------
    relief : Relief
    step : float
        mm.

    Returns
    -------
    list of Contour
        All closed: where the relief runs out of its grid it is cut off at the edge.
    """
    from skimage.measure import approximate_polygon, find_contours

    around = np.pad(relief.heights, 1)
    found = []
    for level in range(1, int(np.ceil(relief.depth / step - 1e-9))):
        for line in find_contours(around, -level * step):
            line = approximate_polygon(line, TOLERANCE / relief.grid.pitch)  # noqa: PLW2901
            x, y = relief.grid.to_xy(line[:-1, 0] - 1, line[:-1, 1] - 1)
            contour = Contour(np.stack([x, y], axis=1), level, level * step)
            if contour.length >= SHORTEST:
                found.append(contour)
    return found


def depth_text(depth: float) -> str:
    """Write a depth as labels do, mm.

    Examples
    --------
    >>> depth_text(0.6000001), depth_text(1.25), depth_text(2.0)
    ('0.6', '1.25', '2')
    """
    return f"{depth:.2f}".rstrip("0").rstrip(".")
