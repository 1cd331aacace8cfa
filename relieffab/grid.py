"""Where pixels and nodes lie on the panel: the only place that turns rows into Y."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Grid:
    """A lattice of square pixels on the panel.

    Pixels are image-like: row 0 is the far edge (largest Y), column 0 the left
    one.  Nodes sit on the pixels' corners, one more of them each way.

    Parameters
    ----------
    rows, cols : int
        Pixels down and across.
    pitch : float
        Side of a pixel, mm.
    origin : tuple of float
        (X, Y) of node [0, 0], the far left corner, in panel coordinates, mm.
    """

    rows: int
    cols: int
    pitch: float
    origin: tuple[float, float]

    def __post_init__(self) -> None:
        if self.rows < 1 or self.cols < 1:
            raise InputError(
                "the grid has no pixels",
                expected="1 x 1 or more",
                found=f"{self.cols} x {self.rows}",
            )
        if not (np.isfinite(self.pitch) and self.pitch > 0):
            raise InputError(
                "the pitch is not a length", expected="more than 0 mm", found=f"{self.pitch} mm"
            )

    @classmethod
    def on_panel(cls, size: tuple[float, float], resolution: tuple[int, int]) -> "Grid":
        """Cover a panel with square pixels, centred where the shapes differ.

        Parameters
        ----------
        size : tuple of float
            Panel's X and Y, mm.
        resolution : tuple of int
            Most pixels across and down.
        """
        pitch = max(size[0] / resolution[0], size[1] / resolution[1])
        cols = max(1, int(size[0] / pitch + 1e-9))
        rows = max(1, int(size[1] / pitch + 1e-9))
        x0 = (size[0] - cols * pitch) / 2
        y0 = size[1] - (size[1] - rows * pitch) / 2
        return cls(rows, cols, pitch, (x0, y0))

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of pixels."""
        return self.rows, self.cols

    @property
    def node_shape(self) -> tuple[int, int]:
        """Rows and columns of nodes."""
        return self.rows + 1, self.cols + 1

    def to_xy(self, row: Any, col: Any) -> tuple[Any, Any]:
        """Turn fractional node indices into panel X and Y, mm.

        Node (i, j) is at (i, j); the centre of pixel (i, j) at (i + 0.5, j + 0.5).
        """
        return self.origin[0] + col * self.pitch, self.origin[1] - row * self.pitch

    def to_index(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Turn panel X and Y (mm) into fractional node (row, column)."""
        return (self.origin[1] - y) / self.pitch, (x - self.origin[0]) / self.pitch

    def node_axes(self) -> tuple[Floats, Floats]:
        """X of every node column (ascending) and Y of every node row (descending), mm."""
        x, _ = self.to_xy(0.0, np.arange(self.cols + 1.0))
        _, y = self.to_xy(np.arange(self.rows + 1.0), 0.0)
        return x, y
