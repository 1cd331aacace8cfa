"""A relief at its place on a panel, scaled where a whole number of pixels has to go round."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil

from relieffab.grid import Grid
from relieffab.relief.model import Relief

ROUNDING = 1e-6
"""Pixels, or mm, that are no difference between two places."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A relief at a place.

    Parameters
    ----------
    relief : Relief
    at : tuple of float
        Where the X0 Y0 of its own panel comes to lie on the new one, mm.
    name : str
        As a message would name it.
    """

    relief: Relief
    at: tuple[float, float]
    name: str

    @property
    def grid(self) -> Grid:
        """Its grid on the new panel."""
        grid = self.relief.grid
        x, y = grid.origin
        return Grid(grid.rows, grid.cols, grid.pitch, (x + self.at[0], y + self.at[1]))


def fitted_round(parts: Sequence[Placed], around: float) -> tuple[list[Placed], float]:
    """Shrink reliefs so that a whole number of the finest one's pixels goes round.

    By less than a pixel in the way round; each is moved to the nearest pixel, so that the
    nodes of the finest, and of all of its pitch, are taken over as they are.

    Parameters
    ----------
    parts : sequence of Placed
    around : float
        mm.

    Returns
    -------
    list of Placed
    float
        The scale, 1 or a little less.
    """
    finest = min((part.grid.pitch for part in parts), default=around)
    pitch = around / ceil(around / finest - ROUNDING)
    scale = pitch / finest
    fitted = []
    for part in parts:
        small = replace(part, relief=scaled(part.relief, scale))
        low_x, low_y = small.grid.to_xy(small.grid.rows, 0)
        left, near = round(low_x / pitch) * pitch, ceil(low_y / pitch - 0.5) * pitch
        near = near if low_y < 0 else max(near, 0.0)
        at = (part.at[0] + left - low_x, part.at[1] + near - low_y)
        fitted.append(replace(small, at=at))
    return fitted, scale


def scaled(relief: Relief, scale: float) -> Relief:
    """Scale a relief in X and Y about the X0 Y0 of its own panel."""
    grid, (x, y) = relief.grid, relief.grid.origin
    own = Grid(grid.rows, grid.cols, scale * grid.pitch, (scale * x, scale * y))
    return replace(relief, grid=own)
