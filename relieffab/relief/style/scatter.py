"""Places at random, no two nearer than a distance, and no room left for another."""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@kernel
def _accept(places, apart, shape, kept):  # type: ignore[no-untyped-def]
    """Keep each place that none kept before it is near to; a cell holds four at most."""
    cells = np.full((int(shape[0] / apart) + 3, int(shape[1] / apart) + 3, 4), -1)
    for k in range(len(places)):
        i, j = int(places[k, 0] / apart) + 1, int(places[k, 1] / apart) + 1
        free = True
        for a in range(i - 1, i + 2):
            for b in range(j - 1, j + 2):
                for n in range(4):
                    other = cells[a, b, n]
                    if other < 0:
                        break
                    down = places[other, 0] - places[k, 0]
                    across = places[other, 1] - places[k, 1]
                    if down * down + across * across < apart * apart:
                        free = False
        if free:
            kept[k] = True
            n = 0
            while cells[i, j, n] >= 0:
                n += 1
            cells[i, j, n] = k


def scatter(where: Bools, apart: float, chance: np.random.Generator) -> Floats:
    """Scatter places as a Poisson disk sample, by throwing one dart into every pixel.

    Cook, "Stochastic sampling in computer graphics" (ACM Trans. Graph. 5, 1986).

    Parameters
    ----------
    where : (n, m) ndarray of bool
        Nodes; a place lies within half a pixel of one.
    apart : float
        Least distance of two places, pixels.
    chance : numpy.random.Generator

    Returns
    -------
    (k, 2) ndarray
        Rows and columns, 0 to n - 1 and m - 1.
    """
    nodes = np.argwhere(where).astype(float)
    darts = chance.permutation(nodes + chance.uniform(-0.5, 0.5, nodes.shape))
    darts = np.clip(darts, 0.0, np.array(where.shape, float) - 1)
    kept = np.zeros(len(darts), bool)
    _accept(darts, float(apart), where.shape, kept)
    return darts[kept]
