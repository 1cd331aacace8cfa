"""Slab: a stock being cut virtually, one move after the other."""

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.sweep import BAND_ROWS, profile_numbers, profile_points, sweep
from relieffab.gcode.swing import swing
from relieffab.grid import Grid
from relieffab.progress import Progress, silent
from relieffab.stock import Stock

Floats = NDArray[np.float64]

CHUNK = 25_000  # moves between two words of progress


@dataclass(frozen=True, eq=False)
class Slab:
    """What is left of a stock so far.

    Parameters
    ----------
    grid : Grid
        The lattice.
    heights : (rows + 1, cols + 1) ndarray of float32
        Of what is left, at the lattice's nodes, mm; 0 is the untouched face.
        Lowered by `cut`.
    radius : float
        Of the face of a round stock whose axis lies along X, mm; 0 where it is flat.
    """

    grid: Grid
    heights: NDArray[np.float32]
    radius: float = 0.0

    @classmethod
    def whole(cls, grid: Grid, stock: Stock, *, refine: int = 1) -> "Slab":
        """Take an untouched stock, on a lattice made from a relief's grid."""
        box = np.array([[0.0, 0.0], [stock.width, stock.height]])
        return cls.over(lattice(grid, refine, box), stock)

    @classmethod
    def over(cls, grid: Grid, stock: Stock) -> "Slab":
        """Take an untouched stock on a lattice."""
        face = stock.face(grid.node_axes()[0]).astype(np.float32)
        return cls(grid, np.tile(face, (grid.rows + 1, 1)), stock.radius)

    def copy(self) -> "Slab":
        """Return a slab of its own that is cut as far."""
        return Slab(self.grid, self.heights.copy(), self.radius)

    def cut(self, points: Floats, cutter: Cutter, progress: Progress = silent) -> Floats:
        """Make the moves of a path.

        At each node the cutter's exact surface is followed along every move, so
        the result is exact there to single precision.

        Parameters
        ----------
        points : (n, 3) ndarray
            Positions of the tip, panel mm.
        cutter : Cutter
        progress : Progress
            Told of mm run.

        Returns
        -------
        (n,) ndarray
            The deepest bite, straight down, that the move to each point takes out
            of what it finds, mm; 0 where it cuts air.
        """
        x, y = self.grid.origin
        local = np.column_stack([points[:, 0] - x, y - points[:, 1], points[:, 2]])
        pitch, radius = self.grid.pitch, self.radius
        way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(local, axis=0), axis=1))])
        bands = -(-self.heights.shape[0] // BAND_ROWS)
        # Scattered, so that threads with a share of them each have as much to do.
        order = np.argsort(np.arange(bands) * 0.6180339887498949 % 1.0)
        shape, form = profile_numbers(cutter), profile_points(cutter)
        bites = np.zeros(len(points))
        for start in range(1, len(points), CHUNK):
            run = local[start - 1 : start + CHUNK]
            if radius:
                found = swing(self.heights, run, shape, form, pitch, radius, order)
            else:
                found = sweep(self.heights, run, shape, form, pitch, order)
            bites[start : start + CHUNK] = found[:, 1:].max(axis=0)
            progress("carving", float(way[min(start + CHUNK, len(way)) - 1]), float(way[-1]), "mm")
        return bites


def lattice(grid: Grid, refine: int, box: Floats) -> Grid:
    """Refine a grid, and grow it by whole pixels until it holds a box.

    Parameters
    ----------
    grid : Grid
    refine : int
        Lattice nodes a pixel.
    box : (2, 2) ndarray
        Least and greatest X and Y to hold, panel mm.
    """
    if refine < 1:
        raise InputError("the lattice cannot be coarser than the relief", found=f"refine {refine}")
    top, left = grid.to_index(box[0, 0], box[1, 1])
    bottom, right = grid.to_index(box[1, 0], box[0, 1])
    up, west = max(0, ceil(-top - 1e-9)), max(0, ceil(-left - 1e-9))
    down = max(0, ceil(bottom - grid.rows - 1e-9))
    east = max(0, ceil(right - grid.cols - 1e-9))
    origin = grid.to_xy(-float(up), -float(west))
    rows, cols = grid.rows + up + down, grid.cols + west + east
    return Grid(rows * refine, cols * refine, grid.pitch / refine, origin)
