"""Multigrid for a mesh of any shapes: coarser levels are patches of its vertices.

Smoothed aggregation after Vanek, Mandel and Brezina, "Algebraic multigrid by
smoothed aggregation for second and fourth order elliptic problems", Computing
56, 1996.  All is symmetric, so that a cycle preconditions conjugate gradients.
Levels work in single precision, conjugate gradients in double.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from relieffab.compiled import kernel

Floats = NDArray[np.floating]
Ints = NDArray[np.integer]

STRONG = 0.08
"""Neighbours this close, of sqrt(a_ii a_jj), share a patch; half as much a level further."""
EASY = 1.75
"""Rows whose sizes sum to less, of their diagonal, are left to the sweeps: K < 3 M."""
REACH = 4 / 3
"""Of a step that takes the largest eigenvalue to 0; stable below 2."""


@dataclass(frozen=True)
class Level:
    """One operator, and the way to the next coarser one.

    Attributes
    ----------
    matrix : (n, n) sparse matrix
    scale : (n, 1) ndarray
        Of a sweep: REACH over the sum of each row's sizes, which bounds its eigenvalues;
        on the coarsest level, which only divides, 1 over the diagonal.
    up : (n, c) sparse matrix, optional
        From the coarser level to this one; none on the coarsest.
    down : (c, n) sparse matrix, optional
        Its transpose.
    """

    matrix: sparse.csr_matrix
    scale: Floats
    up: sparse.csr_matrix | None = None
    down: sparse.csr_matrix | None = None

    def sweep(self, x: Floats, right: Floats) -> Floats:
        """Improve x by a step of Jacobi's."""
        return x + self.scale * (right - self.matrix @ x)


def coarsen(matrix: sparse.csr_matrix) -> list[Level]:
    """Build the levels of an operator, finest first.

    Parameters
    ----------
    matrix : (n, n) sparse matrix
        Symmetric and positive definite; a constant is what its rows barely see,
        as in mass + stiffness.
    """
    levels: list[Level] = []
    while True:
        sizes = np.asarray(abs(matrix).sum(axis=1)).ravel()
        scale = REACH / sizes
        strong = _strong(matrix, sizes, STRONG / 2 ** len(levels))
        patch, count = _patches(strong.indptr, strong.indices)
        single = matrix.astype(np.float32)
        if count == 0:  # mass rules: the diagonal is nearly all there is
            return [*levels, Level(single, _column(1 / matrix.diagonal()))]
        up = _interpolation(matrix, strong, patch, scale)
        down = up.T.tocsr()
        levels.append(Level(single, _column(scale), up.astype(np.float32), down.astype(np.float32)))
        matrix = (down @ (matrix @ up)).tocsr()


def _column(scale: Floats) -> Floats:
    return scale[:, None].astype(np.float32)


def cycle(levels: list[Level], right: Floats) -> Floats:
    """Solve roughly by one V-cycle, columns apart: (n, k)."""
    level, *coarser = levels
    x = level.scale * right
    if level.up is None or level.down is None:
        return x
    x += level.up @ cycle(coarser, level.down @ (right - level.matrix @ x))
    return level.sweep(x, right)


def _strong(matrix: sparse.csr_matrix, sizes: Floats, least: float) -> sparse.csr_matrix:
    """Keep the links between vertices that the sweeps alone would not serve."""
    diagonal = matrix.diagonal()
    hard = sizes > EASY * diagonal
    # No link is as strong as an easy vertex asks.
    root = np.where(hard, np.sqrt(least * diagonal), np.inf)
    links = matrix.tocoo()
    row, col = links.coords
    keep = (row != col) & (np.abs(links.data) > root[row] * root[col])
    return sparse.csr_matrix((links.data[keep], (row[keep], col[keep])), matrix.shape)


def _interpolation(
    matrix: sparse.csr_matrix, strong: sparse.csr_matrix, patch: Ints, scale: Floats
) -> sparse.csr_matrix:
    """Spread each patch's constant by a sweep over the strong links: (n, patches)."""
    inside = np.flatnonzero(patch >= 0)
    flat = sparse.csr_matrix(
        (np.ones(len(inside)), (inside, patch[inside])), (len(patch), patch.max() + 1)
    )
    rest = np.asarray((matrix - strong).sum(axis=1)).ravel()
    spread = sparse.diags(scale) @ (strong @ flat + sparse.diags(rest) @ flat)
    return (flat - spread).tocsr()


@kernel
def _patches(start: Ints, neighbour: Ints) -> tuple[Ints, int]:
    """Group each vertex whose neighbours are all free with them; the others join a group.

    A vertex without links is in none: -1.  No patch is of one vertex, so that
    each level has at most half as many.
    """
    count = 0
    patch = np.full(len(start) - 1, -1)
    for i in range(len(patch)):
        around = neighbour[start[i] : start[i + 1]]
        if len(around) and patch[i] < 0 and (patch[around] < 0).all():
            patch[i] = count
            patch[around] = count
            count += 1
    seeds = patch.copy()
    for i in range(len(patch)):
        if patch[i] < 0:
            for j in neighbour[start[i] : start[i + 1]]:
                if seeds[j] >= 0:
                    patch[i] = seeds[j]
                    break
    return patch, count
