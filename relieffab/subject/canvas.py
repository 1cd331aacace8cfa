"""A slab of space that solids are drawn into part by part, then meshed."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError
from relieffab.subject.sdf import Field, Point, union

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]

# Wherever nothing has been drawn: farther than any blend reaches, mm.
FAR = 4.0
# Cells are taller than wide: what is seen from above changes faster across than up.
UPRIGHT = 1.4


class Canvas:
    """Signed distances on a grid over a slab standing on Z = 0.

    Of a symmetrical one only X >= 0 is drawn; the mesh is mirrored.  Each part is
    worked out within its own bounding box, so the cost follows what is drawn and not
    the slab's size.

    Parameters
    ----------
    size : tuple of float
        Full X, full Y (both centred on 0) and height, mm.
    cell : float
        Side of a grid cell, mm.
    mirrored : bool
        Whether it is symmetrical about X = 0.
    """

    def __init__(
        self, size: tuple[float, float, float], cell: float, *, mirrored: bool = True
    ) -> None:
        if not 0.1 <= cell <= 5.0:
            raise InputError(
                "the grid's cell is out of range", expected="0.1 to 5 mm", found=f"{cell} mm"
            )
        self.cell, self._mirrored = cell, mirrored
        across, along, up = (
            int(np.ceil(length / side))
            for length, side in zip(size, (cell, cell, cell * UPRIGHT), strict=True)
        )
        half, rows = across // 2 + 2, along // 2 + 2
        self._axes = (
            np.arange(0 if mirrored else -half, half + 1, dtype=np.float32) * np.float32(cell),
            np.arange(-rows, rows + 1, dtype=np.float32) * np.float32(cell),
            np.arange(-1, up + 2, dtype=np.float32) * np.float32(cell * UPRIGHT),
        )
        self._field = np.full([len(axis) for axis in self._axes], FAR, np.float32)

    def draw(
        self,
        part: Callable[[Point], Field],
        low: ArrayLike,
        high: ArrayLike,
        *,
        blend: float = 0.0,
    ) -> None:
        """Join a part to what is there.

        Parameters
        ----------
        part : callable
            Takes a `Point` of open float32 grids, gives signed distances, mm.
        low, high : (3,) array_like
            Corners of the part's bounding box, mm; a margin is added here.
        blend : float
            Radius of the seam, mm.
        """
        margin = 3 * self.cell + blend
        box = tuple(
            slice(*np.searchsorted(axis, (a - margin, b + margin)))
            for axis, a, b in zip(self._axes, np.asarray(low), np.asarray(high), strict=True)
        )
        if any(s.stop <= s.start for s in box):
            return
        x, y, z = (axis[s] for axis, s in zip(self._axes, box, strict=True))
        distance = part(Point(x[:, None, None], y[None, :, None], z[None, None, :]))
        self._field[box] = union(self._field[box], distance.astype(np.float32, copy=False), blend)

    def mesh(self) -> Mesh:
        """Triangulate the surface, cut flat at Z = 0: closed, outward, whole.

        Marching cubes (Lewiner 2003, as scikit-image has it).  Distances are kept
        off zero at the nodes, so that no triangle collapses.

        Returns
        -------
        vertices : (v, 3) ndarray
            mm.
        faces : (f, 3) ndarray of int64
            Counter-clockwise seen from outside.
        """
        from skimage.measure import marching_cubes

        field = self._field
        if self._mirrored:
            field = np.concatenate([field[:0:-1], field])
        for axis in range(3):
            field = _soften(field, axis)
        field = np.maximum(field, -self._axes[2])
        least = np.float32(1e-3 * self.cell)
        field[np.abs(field) < least] = least
        spacing = (self.cell, self.cell, self.cell * UPRIGHT)
        vertices, faces, _, _ = marching_cubes(
            field, 0.0, spacing=spacing, gradient_direction="descent"
        )
        x, y, z = self._axes
        start = np.array([-x[-1], y[0], z[0]], dtype=np.float64)
        return vertices.astype(np.float64) + start, faces.astype(np.int64)


def _soften(field: Field, axis: int) -> Field:
    """Average with both neighbours, 1/4 1/2 1/4: what the grid cannot carry goes.

    Without it every crease that crosses the grid at a slant would come out as a saw.
    """
    f = np.moveaxis(field, axis, 0)
    out = f.copy()
    out[1:-1] += f[:-2] * np.float32(0.5)
    out[1:-1] += f[2:] * np.float32(0.5)
    out[1:-1] *= np.float32(0.5)
    return np.moveaxis(out, 0, axis)
