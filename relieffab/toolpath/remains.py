"""What a cutter leaves standing: the stock's height at the relief's nodes."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.outline import height_at, outline_of, radius_at

Floats = NDArray[np.float64]


@kernel
def _carve(stock, x, y, z, pitch, outline):  # type: ignore[no-untyped-def]
    rows, cols = stock.shape
    for k in range(x.size):
        reach = radius_at(outline, -z[k])
        low = max(int(np.ceil((y[k] - reach) / pitch)), 0)
        high = min(int(np.floor((y[k] + reach) / pitch)), rows - 1)
        for i in range(low, high + 1):
            dy = i * pitch - y[k]
            half = sqrt(max(reach * reach - dy * dy, 0.0))
            left = max(int(np.ceil((x[k] - half) / pitch)), 0)
            right = min(int(np.floor((x[k] + half) / pitch)), cols - 1)
            for j in range(left, right + 1):
                dx = j * pitch - x[k]
                r = min(sqrt(dx * dx + dy * dy), reach)
                height = z[k] + height_at(outline, r)
                stock[i, j] = min(stock[i, j], height)


def after(stock: Floats, grid: Grid, cutter: Cutter, tips: Floats) -> Floats:
    """Carve the stock with the cutter standing at each of many places.

    Parameters
    ----------
    stock : (rows + 1, cols + 1) ndarray
        Heights at the grid's nodes, mm, none above 0; not modified.
    grid : Grid
    cutter : Cutter
    tips : (n, 3) ndarray
        Positions of the tip, panel mm.

    Returns
    -------
    ndarray
        What is left, an upper bound of it between the places given.
    """
    left = np.array(stock, dtype=np.float64)
    row, col = grid.to_index(tips[:, 0], tips[:, 1])
    below = np.ascontiguousarray(tips[:, 2])
    sunk = below < 0
    pitch = grid.pitch
    _carve(left, col[sunk] * pitch, row[sunk] * pitch, below[sunk], pitch, outline_of(cutter))
    return left
