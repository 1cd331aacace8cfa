"""Relief: the height field that everything after it is made from."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid

Floats = NDArray[np.float64]


def pixel_slopes(heights: Floats, pitch: float) -> Floats:
    """Find the slopes of pixels from their four corner nodes (Wang 2011, Sect. 5).

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm.
    pitch : float
        Side of a pixel, mm.

    Returns
    -------
    (2, rows, cols) ndarray
        dh/dx and dh/dy.
    """
    a, b, c, d = heights[:-1, :-1], heights[:-1, 1:], heights[1:, :-1], heights[1:, 1:]
    return np.stack([b + d - a - c, a + b - c - d]) / (2 * pitch)


def nodes_of(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Nodes that any pixel of the figure touches.

    Parameters
    ----------
    mask : (rows, cols) ndarray of bool

    Returns
    -------
    (rows + 1, cols + 1) ndarray of bool
    """
    touched = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), bool)
    for rows in (slice(None, -1), slice(1, None)):
        for cols in (slice(None, -1), slice(1, None)):
            touched[rows, cols] |= mask
    return touched


def sunk_pixels(heights: Floats, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels of the figure, and those beside it that are cut all the same: a pecked ground's.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        Above the stock's face at nodes, mm, 0 where nothing is cut.
    mask : (rows, cols) ndarray of bool

    Returns
    -------
    (rows, cols) ndarray of bool
        All that touch a node that is below 0 and no pixel of the figure's, besides the mask.
    """
    lone = (heights < 0) & ~nodes_of(mask)
    return mask | lone[:-1, :-1] | lone[:-1, 1:] | lone[1:, :-1] | lone[1:, 1:]


def inner_nodes(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Nodes whose four pixels are all in the mask, (rows + 1, cols + 1)."""
    whole = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), bool)
    whole[1:-1, 1:-1] = mask[:-1, :-1] & mask[:-1, 1:] & mask[1:, :-1] & mask[1:, 1:]
    return whole


def to_nodes(pixels: Floats, weight: Floats) -> Floats:
    """Weighted means of the up to four pixels around each node.

    Parameters
    ----------
    pixels, weight : (rows, cols) ndarray

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        0 where no pixel has weight.
    """
    total, mass = np.zeros((2, pixels.shape[0] + 1, pixels.shape[1] + 1))
    for i in (slice(None, -1), slice(1, None)):
        for j in (slice(None, -1), slice(1, None)):
            total[i, j] += pixels * weight
            mass[i, j] += weight
    return np.divide(total, mass, out=np.zeros_like(total), where=mass > 0)


@dataclass(frozen=True, eq=False)
class Relief:
    """A sunken relief; arrays are read-only.

    Between nodes the surface is two flat triangles a pixel, split along the
    diagonal from its far left to its near right corner (node [i, j] to node
    [i + 1, j + 1]).  Panel, toolpaths and verification all mean that surface.

    Parameters
    ----------
    grid : Grid
        The pixels' place on the panel.
    heights : (rows + 1, cols + 1) ndarray
        At nodes, mm; 0 is the panel's face, negative into it.
    mask : (rows, cols) ndarray of bool
        Pixels of the figure; every other node is at 0, but for a pecked ground's.
    depth : float
        Lower bound of the heights, positive, mm.
    """

    grid: Grid
    heights: Floats
    mask: NDArray[np.bool_]
    depth: float

    def __post_init__(self) -> None:
        for name, want in (("heights", self.grid.node_shape), ("mask", self.grid.shape)):
            array = getattr(self, name)
            if array.shape != want:
                raise InputError(
                    "the relief does not fit its grid",
                    expected=f"{name} of shape {want}",
                    found=f"{array.shape}",
                )
        if not np.isfinite(self.heights).all():
            raise InputError("the relief holds NaN or infinite heights")
        low, high = self.heights.min(), self.heights.max()
        if low < -self.depth or high > 0:
            raise InputError(
                "the relief breaks its bounds",
                expected=f"heights from {-self.depth:g} to 0 mm",
                found=f"{low:g} to {high:g} mm",
            )
        self.heights.flags.writeable = False
        self.mask.flags.writeable = False

    def height_at(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Height of the triangulated surface under points of the panel.

        Parameters
        ----------
        x, y : array_like
            Panel coordinates, mm.

        Returns
        -------
        ndarray
            Heights, mm; 0 beyond the grid.
        """
        row, col = self.grid.to_index(np.asarray(x, float), np.asarray(y, float))
        rows, cols = self.grid.shape
        inside = (row >= 0) & (row <= rows) & (col >= 0) & (col <= cols)
        i = np.clip(np.floor(row), 0, rows - 1).astype(int)
        j = np.clip(np.floor(col), 0, cols - 1).astype(int)
        u, v = row - i, col - j
        h = self.heights
        a, d = h[i, j], h[i + 1, j + 1]
        lower = a + (h[i + 1, j] - a) * u + (d - h[i + 1, j]) * v
        upper = a + (d - h[i, j + 1]) * u + (h[i, j + 1] - a) * v
        return np.where(inside, np.where(u >= v, lower, upper), 0.0)
