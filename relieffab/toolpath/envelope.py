"""The cutter-location surface: the lowest a cutter's tip may go without gouging.

For a cutter of profile c(r) over a surface h it is max over s of
h(s) - c(|s - (x, y)|), exact for the triangles that `Relief.height_at` means.
"""

from dataclasses import dataclass
from math import ceil, cos, floor, radians, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.toolpath import drop, polar
from relieffab.toolpath.lattice import drop_lattice
from relieffab.toolpath.outline import R1, outline_of, smooth_below

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Terrain:
    """A height field made ready for cutters to be dropped on it.

    Parameters
    ----------
    grid : Grid
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm, none above 0; the face at 0 continues beyond the grid.
    cell_top, block_top : ndarray
        Highest corner of each cell, and of each block of cells.
    radius : float
        Of a round stock's face, whose axis lies along X, mm; 0 where it is flat.
    """

    grid: Grid
    heights: Floats
    cell_top: Floats
    block_top: Floats
    radius: float = 0.0

    @classmethod
    def over(cls, grid: Grid, heights: Floats, radius: float = 0.0) -> "Terrain":
        """Prepare heights on a grid's nodes."""
        field = np.ascontiguousarray(heights, dtype=np.float64)
        return cls(grid, field, *drop.tops(field), radius)

    @classmethod
    def of(cls, relief: Relief, radius: float = 0.0) -> "Terrain":
        """Prepare a relief."""
        return cls.over(relief.grid, relief.heights, radius)

    def within(self, low: tuple[float, float], high: tuple[float, float], more: float) -> "Terrain":
        """Keep what lies between two corners or up to `more` beyond, mm; round it the face."""
        grid = self.grid
        top, left = grid.to_index(low[0] - more, high[1] + more)
        bottom, right = grid.to_index(high[0] + more, low[1] - more)
        i, j = max(0, floor(top)), max(0, floor(left))
        rows, cols = min(grid.rows, ceil(bottom)) - i, min(grid.cols, ceil(right)) - j
        part = Grid(rows, cols, grid.pitch, grid.to_xy(float(i), float(j)))
        return Terrain.over(part, self.heights[i : i + rows + 1, j : j + cols + 1], self.radius)


def tip_heights(
    terrain: Terrain, cutter: Cutter, x: ArrayLike, y: ArrayLike, *, allowance: float = 0.0
) -> Floats:
    """Drop a cutter on the terrain at points of the panel; its shank clears it, too.

    Parameters
    ----------
    terrain : Terrain
    cutter : Cutter
    x, y : array_like
        Panel coordinates of the cutter's axis, mm; of one shape.
    allowance : float
        Distance the cutter keeps from the surface, in every direction, mm.

    Returns
    -------
    ndarray
        Heights of the tip, mm.
    """
    row, col = terrain.grid.to_index(np.asarray(x, float), np.asarray(y, float))
    pitch = terrain.grid.pitch
    row, col = np.broadcast_arrays(row, col)
    if terrain.radius:
        tips = _round_tips(terrain, cutter, np.ravel(col), np.ravel(row), allowance)
        return tips.reshape(row.shape)
    top = float(terrain.block_top.max())
    tips = np.full(row.shape, -np.inf)
    for outline, up in _bodies(terrain, cutter, allowance):
        out = np.empty(row.shape)
        drop.drop_points(
            terrain.heights,
            terrain.cell_top,
            terrain.block_top,
            top,
            pitch,
            np.ravel(col) * pitch,
            np.ravel(row) * pitch,
            outline,
            out.reshape(-1),
        )
        np.maximum(tips, out - up, out=tips)
    return tips


def _round_tips(
    terrain: Terrain, cutter: Cutter, col: Floats, row: Floats, allowance: float
) -> Floats:
    """Drop a cutter on a round stock, at fractional nodes."""
    h, pitch, radius = terrain.heights, terrain.grid.pitch, terrain.radius
    low = float(h.min())
    kept = allowance + polar.bend_error(h, pitch, radius)
    tips = np.full(len(row), -np.inf)
    for outline, up in _bodies(terrain, cutter, kept):
        out = np.empty(len(row))
        x, y = col * pitch, row * pitch
        polar.drop_round(h, terrain.cell_top, low, pitch, radius, x, y, outline, out)
        np.maximum(tips, out - up, out=tips)
    return tips


def _bodies(terrain: Terrain, cutter: Cutter, allowance: float) -> list[tuple[Floats, float]]:
    """List the outlines that must clear the terrain, and how far each is above the tip."""
    bodies = [(outline_of(cutter, allowance), -allowance)]
    if cutter.shank_radius > cutter.radius and -terrain.heights.min() > cutter.flute_length:
        shank = np.array([[0.0, cutter.shank_radius + allowance, 0.0, 0.0, 0.0, 0.0, 0.0]])
        bodies.append((shank, cutter.flute_length - allowance))
    return bodies


@dataclass(frozen=True)
class Places:
    """Rows of places on the panel, evenly spaced.

    Parameters
    ----------
    start : tuple of float
        X and Y of the first place, mm.
    angle : float
        Of the rows, from X towards Y, degrees; each row lies to the right of the one
        before, as seen along it.
    step, stepover : float
        Distance of places along a row, and of rows, mm.
    rows, count : int
        Number of rows, and of places on each.
    """

    start: tuple[float, float]
    angle: float
    step: float
    stepover: float
    rows: int
    count: int

    def xy(self) -> tuple[Floats, Floats]:
        """(rows, count) X and Y of the places, mm."""
        turn = radians(self.angle)
        along, across = np.arange(self.count) * self.step, np.arange(self.rows) * self.stepover
        x = self.start[0] + along * cos(turn) + across[:, None] * sin(turn)
        y = self.start[1] + along * sin(turn) - across[:, None] * cos(turn)
        return x, y


def nodes(grid: Grid) -> Places:
    """Take a grid's nodes as places."""
    return Places(grid.origin, 0.0, grid.pitch, grid.pitch, grid.rows + 1, grid.cols + 1)


def tip_surface(
    terrain: Terrain, cutter: Cutter, places: Places, *, allowance: float = 0.0
) -> Floats:
    """Drop a cutter on the terrain at rows of places, many times faster than at points.

    Parameters
    ----------
    terrain : Terrain
    cutter : Cutter
    places : Places
    allowance : float
        Distance the cutter keeps from the surface, in every direction, mm.

    Returns
    -------
    (places.rows, places.count) ndarray
        Heights of the tip, mm: those of `tip_heights`.
    """
    if terrain.radius:
        return tip_heights(terrain, cutter, *places.xy(), allowance=allowance)
    row, col = terrain.grid.to_index(*places.start)
    pitch, turn = terrain.grid.pitch, radians(places.angle)
    # Rows of the grid go down where Y goes up.
    frame = (cos(turn), -sin(turn), col * pitch, row * pitch, places.step, places.stepover)
    tips = np.full((places.rows, places.count), -np.inf)
    for outline, up in _bodies(terrain, cutter, allowance):
        out = np.empty_like(tips)
        band = max(int(8 * outline[-1, R1] / places.stepover), 64)
        drop_lattice(terrain.heights, pitch, frame, outline, smooth_below(outline), band, out)
        out -= up
        np.maximum(tips, out, out=tips)
    return tips
