"""How much of the shading a line stands for: the valley of n.v that it lies in."""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.contours import fading
from relieffab.layers.lines.surface import Surface
from relieffab.layers.lines.visibility import STEP, in_pixels
from relieffab.layers.raster import Raster, interpolate

Floats = NDArray[np.float64]

LEAST = np.radians(5.0)
"""Tilt to both sides that is worth a line."""
FARTHEST = 10.0
"""How far the sides of a valley are followed, mm."""
FLAT_ON = np.pi / 2
"""What a side counts that is hidden before it has fallen, radians."""
SLIP = 0.25
"""How far off a line its valley's floor may lie, mm; two pixels at least."""
SOON = 2.0
"""How near a line a side must be hidden to count so, mm."""


@kernel
def _rises(points, across, angle, depth, slip, soon, reach, jump, out):  # type: ignore[no-untyped-def]
    """Follow the angle off the view on both sides of each point; write its lesser fall."""
    rows, cols = angle.shape
    for k in range(len(points)):
        r0, c0 = points[k]
        lesser = np.inf
        i, j = int(np.rint(r0)), int(np.rint(c0))
        inside = 0 <= i < rows and 0 <= j < cols
        if not inside or angle[i, j] < 0.0:
            out[k] = 0.0
            continue
        start, level = angle[i, j], depth[i, j]
        for side in (-1.0, 1.0):
            least, before, last = start, level, start
            for step in range(1, reach + 1):
                i = int(np.rint(r0 + side * step * across[k, 0]))
                j = int(np.rint(c0 + side * step * across[k, 1]))
                gone = not (0 <= i < rows and 0 <= j < cols) or angle[i, j] < 0.0
                if gone or abs(depth[i, j] - before) > jump:
                    if step <= soon and last <= least:  # cut off while it was still falling
                        least = start - FLAT_ON
                    break
                before, last = depth[i, j], angle[i, j]
                if step <= slip:
                    start = max(start, angle[i, j])
                if angle[i, j] > start:
                    break
                least = min(least, angle[i, j])
            lesser = min(lesser, start - least)
        out[k] = max(lesser, 0.0)


def view_angles(surface: Surface, raster: Raster, grid: Grid) -> Floats:
    """Angle between normal and view at each pixel, radians; -1 where nothing is seen.

    Parameters
    ----------
    surface : Surface
    raster : Raster
        Of the same faces on the grid.
    grid : Grid
    """
    seen, facing = surface.eye.project(surface.vertices), surface.facing[:, None]
    cosine = interpolate(raster, seen, surface.faces, facing, grid)[..., 0]
    return np.where(raster.mask, np.arccos(np.minimum(np.abs(cosine), 1.0)), -1.0)


def contrast(chains: Chains, angles: Floats, raster: Raster, grid: Grid) -> Floats:
    """Tell how deep a valley of n.v each point of a line lies in.

    A suggestive contour is where n.v is least along the view's tangential part,
    which on the picture runs along the normal.  From there the angle off the view
    falls on both sides, until it comes back: the lesser of the two falls is what
    the eye would lose if the line were left out.  It has no scale: a ripple counts
    by how far it tilts the surface, not by how sharply.

    Parameters
    ----------
    chains : Chains
    angles : (rows, cols) ndarray
        As `view_angles` gives them.
    raster : Raster
    grid : Grid

    Returns
    -------
    (n,) ndarray
        Radians.
    """
    points, across = in_pixels(chains, grid)
    out = np.empty(len(points))
    slip, soon, reach = (int(length / grid.pitch) for length in (SLIP, SOON, FARTHEST))
    _rises(points, across, angles, raster.depth, max(slip, 2), soon, reach, STEP * grid.pitch, out)
    return out


def contrast_strength(chains: Chains, surface: Surface, raster: Raster, grid: Grid) -> Floats:
    """Strength of lines from their contrast: (n,), 1/4 at the least worth a line."""
    if len(chains.points) == 0:
        return np.empty(0)
    angles = view_angles(surface, raster, grid)
    return fading(contrast(chains, angles, raster, grid), LEAST)
