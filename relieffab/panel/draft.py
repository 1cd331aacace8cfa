"""Whether a cast comes free: the draft of everything that is sunk."""

from dataclasses import dataclass

import numpy as np

from relieffab.panel.model import Floats, Sinking
from relieffab.panel.sinking import margins, sink
from relieffab.relief.model import Relief
from relieffab.stock import Stock

# Steeper against the face than this is a wall, degrees.
WALL = 60.0
ROUNDING = 1e-6


@dataclass(frozen=True)
class Draft:
    """The draft of a relief: the angle of its surfaces against the way out.

    Parameters
    ----------
    asked : float
        Degrees.
    least : float
        The least there is, degrees; 90 is level.
    where : tuple of float or None
        (X, Y) on the panel of the least, mm; None where nothing is sunk.
    share : float
        Of the sunk surface's area, how much has less than was asked.
    walls : float
        Of the area of walls, likewise.
    """

    asked: float
    least: float
    where: tuple[float, float] | None
    share: float
    walls: float

    @property
    def ok(self) -> bool:
        """Whether a cast comes free."""
        return self.least >= self.asked - ROUNDING


def _triangles(sinking: Sinking) -> tuple[Floats, Floats, Floats]:
    """Draft in degrees, area in mm², and middle (n, 2), mm, of every sunk triangle."""
    h, pitch = sinking.heights, sinking.grid.pitch
    a, b, c, d = h[:-1, :-1], h[:-1, 1:], h[1:, :-1], h[1:, 1:]
    below = h < 0
    diagonal = below[:-1, :-1] | below[1:, 1:]
    near, far = diagonal | below[1:, :-1], diagonal | below[:-1, 1:]
    slopes, middles = [], []
    # The near left and the far right half of a pixel, and where in it their middles lie.
    for kept, across, along, down in (
        (near, d - c, a - c, 2 / 3),
        (far, b - a, b - d, 1 / 3),
    ):
        slopes.append(np.hypot(across[kept], along[kept]) / pitch)
        row, col = np.nonzero(kept)
        middles.append(np.stack(sinking.grid.to_xy(row + down, col + 1 - down), axis=1))
    slope = np.concatenate(slopes)
    area = pitch**2 / 2 * np.hypot(1.0, slope)
    return 90 - np.degrees(np.arctan(slope)), area, np.concatenate(middles)


def _ends(sinking: Sinking, stock: Stock) -> tuple[Floats, Floats, Floats]:
    """Find the upright walls in which a relief ends at its grid's border, likewise."""
    grid, h = sinking.grid, sinking.heights
    far, near, left, right = (margin > ROUNDING for margin in margins(grid, stock))
    rows, cols = np.arange(grid.rows) + 0.5, np.arange(grid.cols) + 0.5
    sides = [
        (far, h[0], 0.0, cols),
        (near, h[-1], float(grid.rows), cols),
        (left, h[:, 0], rows, 0.0),
        (right, h[:, -1], rows, float(grid.cols)),
    ]
    areas, middles = [np.empty(0)], [np.empty((0, 2))]
    for stands, heights, row, col in sides:
        area = -(heights[1:] + heights[:-1]) / 2 * grid.pitch
        if stands:
            xy = np.stack(np.broadcast_arrays(*grid.to_xy(row, col)), axis=1)
            areas.append(area[area > 0])
            middles.append(xy[area > 0])
    area = np.concatenate(areas)
    return np.zeros(len(area)), area, np.concatenate(middles)


def check_draft(relief: Relief, stock: Stock, draft: float = 3.0) -> Draft:
    """Measure the draft of a relief, triangle by triangle.

    Parameters
    ----------
    relief : Relief
    stock : Stock
    draft : float, optional
        That it should have everywhere, degrees.

    Returns
    -------
    Draft

    Raises
    ------
    InputError
        If the stock cannot hold the relief.
    """
    sinking = sink(relief, stock)
    parts = zip(_triangles(sinking), _ends(sinking, stock), strict=True)
    angle, area, middle = (np.concatenate(part) for part in parts)
    if len(angle) == 0:
        return Draft(draft, 90.0, None, 0.0, 0.0)
    worst = int(angle.argmin())
    short = angle < draft - ROUNDING
    wall = angle < 90 - WALL
    return Draft(
        draft,
        float(angle[worst]),
        (float(middle[worst, 0]), float(middle[worst, 1])),
        float(area[short].sum() / area.sum()),
        float(area[short & wall].sum() / area[wall].sum()) if wall.any() else 0.0,
    )
