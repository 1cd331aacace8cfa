"""The z-buffer: which triangle lies under every pixel centre, and how near."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.grid import Grid

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Raster:
    """What an orthographic view sees at each pixel centre.

    Parameters
    ----------
    depth : (rows, cols) ndarray
        mm, larger is nearer; -inf where nothing is seen.
    triangle : (rows, cols) ndarray of int32
        Index of the nearest triangle; -1 where nothing is seen.
    """

    depth: Floats
    triangle: Ints

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Where something is seen."""
        return self.triangle >= 0


@kernel
def _fill(col, row, z, faces, depth, triangle):  # type: ignore[no-untyped-def]
    """Scan-convert triangles given in pixel coordinates, nearest wins.

    A pixel is inside where all three edge functions have the triangle's sign; a
    centre exactly on an edge counts for both sides of it, so that no shared edge
    shows a gap.  Equal depths go to the first triangle.
    """
    rows, cols = depth.shape
    for t in range(len(faces)):
        a, b, c = faces[t, 0], faces[t, 1], faces[t, 2]
        xa, ya, xb, yb, xc, yc = col[a], row[a], col[b], row[b], col[c], row[c]
        area = (xb - xa) * (yc - ya) - (xc - xa) * (yb - ya)
        if area == 0.0:
            continue
        # Pixel centres sit on whole numbers here.
        i0 = max(0, int(np.ceil(min(ya, yb, yc))))
        i1 = min(rows - 1, int(np.floor(max(ya, yb, yc))))
        j0 = max(0, int(np.ceil(min(xa, xb, xc))))
        j1 = min(cols - 1, int(np.floor(max(xa, xb, xc))))
        sign = 1.0 if area > 0.0 else -1.0
        for i in range(i0, i1 + 1):
            for j in range(j0, j1 + 1):
                wa = sign * ((xb - j) * (yc - i) - (xc - j) * (yb - i))
                wb = sign * ((xc - j) * (ya - i) - (xa - j) * (yc - i))
                wc = sign * ((xa - j) * (yb - i) - (xb - j) * (ya - i))
                total = wa + wb + wc
                if wa >= 0.0 and wb >= 0.0 and wc >= 0.0 and total > 0.0:
                    near = (wa * z[a] + wb * z[b] + wc * z[c]) / total
                    if near > depth[i, j]:
                        depth[i, j] = near
                        triangle[i, j] = t


def rasterise(vertices: Floats, faces: NDArray[np.integer], grid: Grid) -> Raster:
    """Look straight down at a mesh, sampled exactly at the pixel centres.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        On the panel, mm, Z towards the viewer.
    faces : (f, 3) ndarray of int
    grid : Grid

    Returns
    -------
    Raster
        In double precision; both sides of a triangle are seen.
    """
    vertices = np.asarray(vertices, dtype=np.float64)
    row, col = grid.to_index(vertices[:, 0], vertices[:, 1])
    depth = np.full(grid.shape, -np.inf)
    triangle = np.full(grid.shape, -1, np.int32)
    faces = np.ascontiguousarray(faces, dtype=np.int64)
    z = np.ascontiguousarray(vertices[:, 2])
    _fill(col - 0.5, row - 0.5, z, faces, depth, triangle)
    return Raster(depth, triangle)


def interpolate(
    raster: Raster, vertices: Floats, faces: NDArray[np.integer], values: Floats, grid: Grid
) -> Floats:
    """Carry values from vertices to the pixels that see them.

    Parameters
    ----------
    raster : Raster
        Of the same mesh on the same grid.
    vertices : (v, 3) ndarray
        On the panel, mm.
    faces : (f, 3) ndarray of int
    values : (v, n) ndarray
        At vertices.
    grid : Grid

    Returns
    -------
    ndarray (rows, cols, n)
        Barycentric means; 0 where nothing is seen.
    """
    seen = raster.mask
    i, j = np.nonzero(seen)
    corners = faces[raster.triangle[seen]]
    x, y = grid.to_xy(i + 0.5, j + 0.5)
    a, b, c = (vertices[corners[:, k], :2] for k in range(3))
    u, v, p = b - a, c - a, np.stack([x, y], axis=1) - a
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    wb = (p[:, 0] * v[:, 1] - p[:, 1] * v[:, 0]) / area
    wc = (u[:, 0] * p[:, 1] - u[:, 1] * p[:, 0]) / area
    weights = np.stack([1 - wb - wc, wb, wc], axis=1)
    out = np.zeros((*grid.shape, values.shape[1]))
    out[seen] = np.einsum("pk,pkn->pn", weights, values[corners])
    return out
