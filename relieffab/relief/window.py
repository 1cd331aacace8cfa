"""The part of a grid that holds the figure."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.model import Layers

Floats = NDArray[np.float64]

BORDER = 3  # pixels of background kept round the figure


@dataclass(frozen=True)
class Window:
    """A part of a grid, which may reach beyond it.

    Parameters
    ----------
    top, left, rows, cols : int
        In pixels of the whole grid.
    """

    top: int
    left: int
    rows: int
    cols: int

    def take(self, whole: NDArray[Any], *, nodes: bool = True) -> NDArray[Any]:
        """Cut the window out, with zeros beyond the grid; a view if it is all inside."""
        more = int(nodes)
        if self.inside(whole.shape, more):
            return whole[
                self.top : self.top + self.rows + more, self.left : self.left + self.cols + more
            ]
        out = np.zeros((self.rows + more, self.cols + more, *whole.shape[2:]), whole.dtype)
        mine, theirs = self._overlap(whole.shape, more)
        out[mine] = whole[theirs]
        return out

    def inside(self, shape: tuple[int, ...], more: int) -> bool:
        """Whether it lies within an array."""
        return (
            min(self.top, self.left) >= 0
            and self.top + self.rows + more <= shape[0]
            and self.left + self.cols + more <= shape[1]
        )

    def put(self, part: NDArray[Any], shape: tuple[int, int]) -> NDArray[Any]:
        """Lay node values back into zeros of the whole grid's shape."""
        out = np.zeros(shape, part.dtype)
        mine, theirs = self._overlap(shape, 1)
        out[theirs] = part[mine]
        return out

    def _overlap(
        self, shape: tuple[int, ...], more: int
    ) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
        mine, theirs = [], []
        for start, size, whole in zip(
            (self.top, self.left), (self.rows + more, self.cols + more), shape[:2], strict=True
        ):
            low, high = max(start, 0), min(start + size, whole)
            theirs.append(slice(low, high))
            mine.append(slice(low - start, high - start))
        return (mine[0], mine[1]), (theirs[0], theirs[1])


def figure_size(layers: Layers) -> tuple[float, float]:
    """Height and width of the figure on the panel, mm."""
    rows, cols = (np.nonzero(layers.mask.any(axis=axis))[0] for axis in (1, 0))
    return layers.pitch * float(np.ptp(rows) + 1), layers.pitch * float(np.ptp(cols) + 1)


def cropped(layers: Layers) -> tuple[Layers, Window]:
    """Cut out the figure with a border of background."""
    rows, cols = (np.nonzero(layers.mask.any(axis=axis))[0] for axis in (1, 0))
    top, left = int(rows[0]) - BORDER, int(cols[0]) - BORDER
    window = Window(top, left, int(rows[-1]) + 1 + BORDER - top, int(cols[-1]) + 1 + BORDER - left)
    normals = window.take(layers.normals, nodes=False)
    if not window.inside(layers.grid.shape, 0):
        normals[~window.take(layers.mask, nodes=False)] = (0.0, 0.0, 1.0)
    figure = Layers(
        grid=Grid(window.rows, window.cols, layers.pitch, layers.grid.to_xy(top, left)),
        depth=window.take(layers.depth, nodes=False),
        normals=normals,
        mask=window.take(layers.mask, nodes=False),
        lights=layers.lights,
        shading=np.moveaxis(window.take(np.moveaxis(layers.shading, 0, 2), nodes=False), 2, 0),
        lines=window.take(layers.lines, nodes=False),
        strokes=layers.strokes,
    )
    return figure, window
