"""Lines one pixel wide to polylines on the panel."""

import numpy as np
from numpy.typing import NDArray
from skimage.morphology import skeletonize

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains, join, resample

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


def _links(thin: Bools) -> NDArray[np.int64]:
    """Pairs of neighbouring pixels, (n, 2): diagonal ones only where no third joins them."""
    number = np.arange(thin.size).reshape(thin.shape)
    here, right, below, beyond = (
        (rows, cols) for rows in (slice(-1), slice(1, None)) for cols in (slice(-1), slice(1, None))
    )
    every = slice(None)
    straight = (((every, slice(-1)), (every, slice(1, None))), ((slice(-1),), (slice(1, None),)))
    pairs = [
        np.stack([number[a][both], number[b][both]], axis=1)
        for a, b in straight
        for both in (thin[a] & thin[b],)
    ]
    for a, b, c, d in ((here, beyond, right, below), (below, right, here, beyond)):
        both = thin[a] & thin[b] & ~thin[c] & ~thin[d]
        pairs.append(np.stack([number[a][both], number[b][both]], axis=1))
    return np.concatenate(pairs)


def chains_of(lines: Bools, strength: Floats, across: Floats, grid: Grid) -> Chains:
    """Follow lines of pixels, and sample them evenly.

    Parameters
    ----------
    lines : (rows, cols) ndarray of bool
        Thinned to one pixel first (Zhang and Suen 1984).
    strength : (rows, cols) ndarray
        0 to 1.
    across : (2, rows, cols) ndarray
        X and Y of the way across the line; any, where it does not matter.
    grid : Grid

    Returns
    -------
    Chains
        Through pixel centres, a pitch apart.
    """
    thin = skeletonize(lines)
    order, begin = join(_links(thin))
    row, col = np.divmod(order, thin.shape[1])
    x, y = grid.to_xy(row + 0.5, col + 0.5)
    level = np.zeros(len(order))
    points = np.stack([x, y, level], axis=1).astype(np.float64)
    normals = np.stack([across[0].ravel()[order], across[1].ravel()[order], level], axis=1)
    chains = Chains(points, strength.ravel()[order].astype(np.float64), normals, level, begin)
    return resample(chains, grid.pitch)
