"""What a cutter leaves of a surface however long it works: the closing by its exact shape."""

from math import ceil

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.relief.reach import sunken_box
from relieffab.toolpath.envelope import Terrain, nodes, tip_surface

Floats = NDArray[np.float64]


def leaves(heights: Floats, pitch: float, cutter: Cutter) -> Floats:
    """Find what stands once a cutter has been everywhere it may go.

    The cutter is lowered onto the surface's triangles; turned upside down and lowered
    onto the surface of its own tips it shows the lowest it has been at each node.  Tips
    are known at nodes, and taken to lie on the triangles between.
    `relief.reach.closing` does the same with nodes alone, where steep ground is missed by
    up to half a pixel's rise.

    Parameters
    ----------
    heights : (rows, cols) ndarray
        At nodes, mm, none above 0; the panel's face at 0 goes on beyond them.
    pitch : float
        Distance of the nodes, mm.
    cutter : Cutter

    Returns
    -------
    (rows, cols) ndarray
        mm; nowhere below the heights nor above 0.
    """
    if not (heights < 0).any():
        return heights
    box = sunken_box(heights)
    # Beyond its border a terrain is level, tips are not: the border has to be out of reach.
    border = ceil(max(cutter.radius, cutter.shank_radius) / pitch) + 1
    wide = np.pad(heights[box], border)
    grid = Grid(wide.shape[0] - 1, wide.shape[1] - 1, pitch, (0.0, 0.0))
    tips = tip_surface(Terrain.over(grid, wide), cutter, nodes(grid))
    low = tips.min()
    turned = tip_surface(Terrain.over(grid, low - tips), cutter, nodes(grid))
    inner = (slice(border, -border),) * 2
    out = heights.copy()
    out[box] = np.clip((low - turned)[inner], heights[box], 0.0)
    return out
