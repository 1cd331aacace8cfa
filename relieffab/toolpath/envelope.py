"""The cutter-location surface: the lowest a cutter's tip may go without gouging.

For a cutter of profile c(r) over a surface h it is max over s of
h(s) - c(|s - (x, y)|), exact for the triangles that `Relief.height_at` means.
"""

from dataclasses import dataclass
from math import cos, inf, radians, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.toolpath import drop

Floats = NDArray[np.float64]
Shape = tuple[float, float, float, float, float, float]


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
    """

    grid: Grid
    heights: Floats
    cell_top: Floats
    block_top: Floats

    @classmethod
    def over(cls, grid: Grid, heights: Floats) -> "Terrain":
        """Prepare heights on a grid's nodes."""
        field = np.ascontiguousarray(heights, dtype=np.float64)
        return cls(grid, field, *drop.tops(field))

    @classmethod
    def of(cls, relief: Relief) -> "Terrain":
        """Prepare a relief."""
        return cls.over(relief.grid, relief.heights)


def shape_of(cutter: Cutter, allowance: float = 0.0) -> Shape:
    """Describe a cutter, grown by an allowance on every side, as the kernels take it.

    The parallel curve of flat, arc and cone is again a flat, an arc and a cone.

    Returns
    -------
    tuple of float
        flat, arc, arc_end, arc_top, flank, radius: mm, and a slope.
    """
    half = radians(cutter.angle / 2) if cutter.flank < inf else 0.0
    arc = cutter.tip_radius + allowance
    return (
        cutter.flat_radius,
        arc,
        cutter.flat_radius + arc * cos(half),
        arc * (1 - sin(half)),
        cutter.flank,
        cutter.radius + allowance,
    )


def tip_heights(
    terrain: Terrain, cutter: Cutter, x: ArrayLike, y: ArrayLike, *, allowance: float = 0.0
) -> Floats:
    """Drop a cutter on the terrain at points of the panel.

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
    out = np.empty(row.shape)
    drop.drop_points(
        terrain.heights,
        terrain.cell_top,
        terrain.block_top,
        float(terrain.cell_top.max()),
        pitch,
        np.ravel(col) * pitch,
        np.ravel(row) * pitch,
        shape_of(cutter, allowance),
        out.reshape(-1),
    )
    return out + allowance
