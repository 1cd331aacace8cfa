"""A relief on a curved board as a router sees it from above: what it can reach, and no undercut.

Bent over the board, a point that lies at X u and the height h on the flat panel comes to
(R + h) sin(u / R) beside the middle and (R + h) cos(u / R) - R above its face.  Walls that
lean over are filled in below their upper edge.
"""

from collections.abc import Iterator
from math import asin, ceil, floor

import numpy as np
from numpy.typing import NDArray

from relieffab.bend import Bend
from relieffab.grid import Grid
from relieffab.relief.model import Floats, Relief
from relieffab.stock import Stock

Ints = NDArray[np.intp]

ROUNDING = 1e-9
PER_PIXEL = 2  # samples along a row


def bend_of(stock: Stock) -> Bend:
    """Say how the flat panel lies over a curved board."""
    radius = stock.curve
    return Bend(radius, radius * asin(stock.width / 2 / radius))


def bent_points(points: Floats, relief: Relief, stock: Stock, rise: float = 0.0) -> Floats:
    """Lay points of the flat panel on the relief of a curved board, as seen from above.

    Parameters
    ----------
    points : (n, 2) ndarray
        mm.
    relief : Relief
        On the flat panel.
    stock : Stock
        A curved board.
    rise : float, optional
        How far above the relief, square to the board's face, mm: a round tip's middle stands
        its radius above what it cuts, and nearer to the board's middle than that.

    Returns
    -------
    (n, 2) ndarray
        mm.
    """
    x, y = points.T
    lifted = np.column_stack([x, y, relief.height_at(x, y) + rise])
    across = bend_of(stock).bent(lifted)[:, 0] + stock.width / 2
    return np.column_stack([across, y])


def seen_from_above(relief: Relief, stock: Stock) -> Relief:
    """Give the highest of a bent relief over every place of its board.

    Parameters
    ----------
    relief : Relief
        On the flat panel that is bent over the board.
    stock : Stock
        A curved board.

    Returns
    -------
    Relief
        As wide and high as the board; where nothing is cut, its face.
    """
    cols = ceil(stock.width / relief.grid.pitch - ROUNDING)
    pitch = stock.width / cols
    rows = floor(stock.height / pitch + ROUNDING)
    grid = Grid(rows, cols, pitch, (0.0, rows * pitch))
    x, y = grid.node_axes()
    along = _samples(relief.grid, 2 * bend_of(stock).middle)
    heights = np.full(grid.node_shape, -np.inf)
    across, up = _rows(relief, stock, along, y)
    for row, k, j in _covered(across, pitch, 0.0, cols):
        start, end = across[row, k], across[row, k + 1]
        wide = end - start
        share = np.divide(j * pitch - start, wide, out=np.zeros_like(wide), where=wide != 0)
        low, high = up[row, k], up[row, k + 1]
        np.maximum.at(heights, (row, j), low + np.clip(share, 0, 1) * (high - low))
    face = stock.face(x)
    # Between samples s apart their chord lies up to s² / 8 R cos(u / R) under an uncut face.
    sag = (relief.grid.pitch / PER_PIXEL) ** 2 / (4 * (stock.curve + face))
    cut = np.isfinite(heights) & (heights < face - sag)
    heights = np.where(cut, heights, face)
    mask = _figure(relief, grid, along, across)
    return Relief(grid, heights, mask, stock.lowest(relief.depth))


def _samples(grid: Grid, width: float) -> Floats:
    """Choose places along a row, nodes among them, from edge to edge of the flat panel."""
    step = grid.pitch / PER_PIXEL
    first = ceil(-grid.origin[0] / step + ROUNDING)
    last = floor((width - grid.origin[0]) / step - ROUNDING)
    inner = grid.origin[0] + np.arange(first, last + 1) * step
    return np.concatenate([[0.0], inner, [width]])


def _rows(relief: Relief, stock: Stock, along: Floats, y: Floats) -> tuple[Floats, Floats]:
    """(rows, samples) X on the board, and height over its middle, of every row's samples."""
    heights = relief.height_at(along[None, :], y[:, None])
    u, _ = np.broadcast_arrays(along, heights)
    flat = np.column_stack([u.ravel(), np.zeros(u.size), heights.ravel()])
    x, _, z = bend_of(stock).bent(flat).T
    return (x + stock.width / 2).reshape(u.shape), (z - stock.curve).reshape(u.shape)


def _covered(
    across: Floats, pitch: float, shift: float, most: int
) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Yield rows, samples and columns where the way from a sample to the next passes a column.

    Columns lie at (j + shift) pitch, j from 0 to `most`.
    """
    low = np.minimum(across[:, :-1], across[:, 1:])
    high = np.maximum(across[:, :-1], across[:, 1:])
    first = np.ceil(low / pitch - shift - ROUNDING).astype(int)
    last = np.floor(high / pitch - shift + ROUNDING).astype(int)
    for more in range(int((last - first).max()) + 1):
        j = first + more
        row, k = np.nonzero((j <= last) & (j >= 0) & (j <= most))
        yield row, k, j[row, k]


def _figure(relief: Relief, grid: Grid, along: Floats, across: Floats) -> NDArray[np.bool_]:
    """Mark the pixels over whose middle the figure lies."""
    middle = grid.node_axes()[1][:-1] - grid.pitch / 2
    row, col = relief.grid.to_index((along[:-1] + along[1:])[None, :] / 2, middle[:, None])
    rows, cols = relief.grid.shape
    inside = (row >= 0) & (row < rows) & (col >= 0) & (col < cols)
    i, j = (np.clip(k, 0, n - 1).astype(int) for k, n in ((row, rows), (col, cols)))
    figure = inside & relief.mask[i, j]
    mask = np.zeros(grid.shape, bool)
    between = (across[:-1] + across[1:]) / 2
    for rows_of, k, j_of in _covered(between, grid.pitch, 0.5, grid.cols - 1):
        mask[rows_of, j_of] |= figure[rows_of, k]
    return mask
