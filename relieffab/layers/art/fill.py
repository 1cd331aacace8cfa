"""Which pixels lie inside a filled path."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


def winding(rings: Iterable[Floats], grid: Grid) -> NDArray[np.int64]:
    """Count how often rings go round each pixel centre, counter-clockwise ones as 1.

    Every edge that crosses a row of centres changes the count of all pixels to its
    right; so the counts are running sums along the rows.

    Parameters
    ----------
    rings : iterable of (n, 2) ndarray
        X and Y, mm; the last point joins the first.
    grid : Grid

    Returns
    -------
    (rows, cols) ndarray of int
    """
    change = np.zeros((grid.rows, grid.cols + 1), np.int64)
    for points in rings:
        row, col = grid.to_index(points[:, 0], points[:, 1])
        row, col = row - 0.5, col - 0.5
        after_row, after_col = np.roll(row, -1), np.roll(col, -1)
        # Rows crossed: those with low < i <= high, so that a corner counts once.
        low, high = np.minimum(row, after_row), np.maximum(row, after_row)
        first = np.clip(np.floor(low).astype(np.int64) + 1, 0, grid.rows)
        last = np.clip(np.floor(high).astype(np.int64), -1, grid.rows - 1)
        count = np.maximum(last - first + 1, 0)
        edge = np.repeat(np.arange(len(row)), count)
        i = first[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
        share = (i - row[edge]) / (after_row[edge] - row[edge])
        at = col[edge] + share * (after_col[edge] - col[edge])
        j = np.clip(np.ceil(at).astype(np.int64), 0, grid.cols)
        np.add.at(change, (i, j), np.where(after_row[edge] > row[edge], 1, -1))
    return np.cumsum(change, axis=1)[:, :-1]


def inside(rings: Iterable[Floats], rule: str, grid: Grid) -> Bools:
    """Pixels whose centres a path fills, by 'nonzero' or by 'evenodd'; (rows, cols)."""
    count = winding(rings, grid)
    return np.asarray(count % 2 != 0 if rule == "evenodd" else count != 0, bool)
