"""Contours moved to where the picture's depth really steps."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.visibility import STEP, in_pixels

Floats = NDArray[np.float64]

REACH = 0.5
"""How far to look, as a share of the local triangles' size."""


@kernel
def _nearest_steps(points, across, reach, depth, jump, out, found):  # type: ignore[no-untyped-def]
    """Find how far along its normal each point's nearest fall of depth lies, in pixels.

    Half a pixel at a time, away from the point on both sides; what lies further along
    the normal must be the lower one.  0 where none is found within reach.
    """
    rows, cols = depth.shape
    for k in range(len(points)):
        out[k], found[k] = 0.0, False
        best = reach[k] + 0.5
        for side in (-1.0, 1.0):
            before = np.inf
            for step in range(int(2 * reach[k]) + 3):
                far = side * 0.5 * step
                i = int(np.rint(points[k, 0] + far * across[k, 0]))
                j = int(np.rint(points[k, 1] + far * across[k, 1]))
                here = -1e30
                if 0 <= i < rows and 0 <= j < cols:
                    here = depth[i, j]
                if step > 0 and side * (before - here) > jump and abs(far) - 0.25 < best:
                    best = abs(far) - 0.25
                    out[k], found[k] = far - side * 0.25, True
                before = here


def snap(chains: Chains, depth: Floats, grid: Grid) -> tuple[Chains, NDArray[np.bool_]]:
    """Move contours along their normals to the nearest step of the depth image.

    The zero set of n.v is that of a smooth surface; the mesh that is seen turns
    away along its edges, up to half a triangle off.  Where triangles are finer
    than pixels nothing moves.

    Parameters
    ----------
    chains : Chains
    depth : (rows, cols) ndarray
        mm, larger is nearer, -inf where nothing is seen.
    grid : Grid

    Returns
    -------
    moved : Chains
    real : (n,) ndarray of bool
        False where triangles are coarse and no step lies near: a contour of the
        normals only, such as the apex of a cone casts.
    """
    reach = REACH * chains.slack / grid.pitch
    points, across = in_pixels(chains, grid)
    filled = np.where(np.isfinite(depth), depth, -1e30)
    shift, found = np.empty(len(points)), np.empty(len(points), bool)
    _nearest_steps(points, across, reach, filled, STEP * grid.pitch, shift, found)
    coarse = reach > 1.0
    shift = np.where(coarse, shift, 0.0) * grid.pitch
    moved = chains.points.copy()
    moved[:, 0] += shift * across[:, 1]
    moved[:, 1] -= shift * across[:, 0]
    return replace(chains, points=moved), found | ~coarse
