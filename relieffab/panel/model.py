"""Panel: the finished solid, and the open surface it is cut with."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Sinking:
    """The part of a relief that lies below the panel's face; arrays are read-only.

    Parameters
    ----------
    grid : Grid
        The relief's own, or wider by a pixel at each side where the cut opens.
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm; 0 is the panel's face.  Each pixel is two triangles, and its
        diagonal goes from node [i, j] to [i + 1, j + 1].
    """

    grid: Grid
    heights: Floats

    def __post_init__(self) -> None:
        self.heights.flags.writeable = False

    @property
    def empty(self) -> bool:
        """Whether nothing lies below the face."""
        return not (self.heights < 0).any()


@dataclass(frozen=True, eq=False)
class Surface:
    """An open triangulated surface over a grid; arrays are read-only.

    Parameters
    ----------
    grid : Grid
    vertices : (v, 3) ndarray
        Column, minus row and height, all in pixels: nodes have whole numbers,
        so that they can be compared and sampled without rounding.
    faces : (f, 3) ndarray of int
        Counter-clockwise seen from above.
    """

    grid: Grid
    vertices: Floats
    faces: Ints

    def __post_init__(self) -> None:
        self.vertices.flags.writeable = False
        self.faces.flags.writeable = False

    def over_nodes(self) -> Floats:
        """Vertices as column, row and height in mm, (v, 3)."""
        return self.vertices * [1.0, -1.0, self.grid.pitch]  # type: ignore[no-any-return]

    def points(self) -> Floats:
        """Vertices on the panel, (v, 3), mm."""
        x, y = self.grid.to_xy(-self.vertices[:, 1], self.vertices[:, 0])
        return np.stack([x, y, self.vertices[:, 2] * self.grid.pitch], axis=1)


@dataclass(frozen=True, eq=False)
class Panel:
    """A slab with a relief sunk into it; arrays are read-only.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm, the face at Z0, the near left corner at X0 Y0.
    faces : (f, 3) ndarray of int
        Counter-clockwise seen from outside.
    watertight : bool
        Whether every edge is walked once each way.
    volume_mm3 : float
        Enclosed, mm³.
    max_error_mm : float
        Largest vertical distance to the relief at any point, mm.
    """

    vertices: Floats
    faces: Ints
    watertight: bool
    volume_mm3: float
    max_error_mm: float

    def __post_init__(self) -> None:
        for name in ("vertices", "faces"):
            array = getattr(self, name)
            if array.ndim != 2 or array.shape[1] != 3:
                raise InputError(
                    "the panel is not a triangle mesh",
                    expected=f"{name} of shape (n, 3)",
                    found=f"{array.shape}",
                )
            array.flags.writeable = False
