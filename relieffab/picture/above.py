"""What a camera straight above a panel sees: the relief, and frame and holes beside it."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.grid import Grid
from relieffab.layers.raster import rasterise
from relieffab.picture.render import TriangleMesh
from relieffab.relief.model import Relief

Floats = NDArray[np.float64]

# mm by which a panel's triangles may be off the relief and still stand for it.
SAME = 0.25


def nodes_over(solid: TriangleMesh, nodes: Grid) -> tuple[Floats, NDArray[np.bool_]]:
    """Find the heights of a solid seen from above, mm, and where it is seen.

    Parameters
    ----------
    solid : TriangleMesh
    nodes : Grid
        Whose pixels' centres are asked for.
    """
    seen = rasterise(solid.vertices, solid.faces, nodes)
    return np.where(seen.mask, seen.depth, 0.0), seen.mask


def _continued(heights: Floats, seen: NDArray[np.bool_]) -> Floats:
    """Continue heights beyond where there are some by the nearest."""
    nearest = ndimage.distance_transform_edt(~seen, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(nearest)])


def solid_heights(solid: TriangleMesh, pitch: float) -> tuple[Grid, Floats]:
    """Cover a solid by a grid, and find its heights at the nodes, mm."""
    low, high = (getattr(solid.vertices, end)(axis=0) for end in ("min", "max"))
    size = (float(high[0] - low[0]), float(high[1] - low[1]))
    rows, cols = (max(1, round(side / pitch)) for side in (size[1], size[0]))
    grid = Grid(rows, cols, pitch, (float(low[0]), float(low[1]) + rows * pitch))
    return grid, _continued(*nodes_over(solid, _of_nodes(grid)))


def _of_nodes(grid: Grid) -> Grid:
    """Make the grid whose pixels' centres are a grid's nodes."""
    x, y = grid.origin
    half = grid.pitch / 2
    return Grid(grid.rows + 1, grid.cols + 1, grid.pitch, (x - half, y + half))


def heights_above(relief: Relief, panel: TriangleMesh) -> Floats:
    """Find the heights at nodes of a panel seen from above.

    Parameters
    ----------
    relief : Relief
    panel : TriangleMesh
        The solid it is sunk into.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        mm.  The relief's own, which are finer than the triangles, wherever those
        agree; beside the panel, and under its holes, the nearest of its heights.
    """
    heights, seen = nodes_over(panel, _of_nodes(relief.grid))
    same = np.abs(heights - relief.heights) < SAME
    if same[seen].all():
        return relief.heights
    return _continued(np.where(same, relief.heights, heights), seen)
