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
    grid, pitch = relief.grid, relief.grid.pitch
    # Pixels whose centres are the nodes.
    x, y = grid.origin
    nodes = Grid(grid.rows + 1, grid.cols + 1, pitch, (x - pitch / 2, y + pitch / 2))
    seen = rasterise(panel.vertices, panel.faces, nodes)
    heights = np.where(seen.mask, seen.depth, 0.0)
    same = np.abs(heights - relief.heights) < SAME
    if same[seen.mask].all():
        return relief.heights
    found = np.where(same, relief.heights, heights)
    through = ~seen.mask
    nearest = ndimage.distance_transform_edt(through, return_distances=False, return_indices=True)
    return np.asarray(found[tuple(nearest)])
