"""Operators with 25 stored couplings a node, laid out (row, coupling, column).

Coupling o of node [i, j] is with node [i + o // 5 - 2, j + o % 5 - 2].  Lattices
carry a border of two fixed nodes, and a fixed node has no couplings.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import adaptive_kernel, kernel, parallel_kernel, prange
from relieffab.relief.multigrid.transfer import MANY, coarser, fold_columns, fold_rows

Singles = NDArray[np.float32]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

BLOCK = 8  # coarse rows that one thread folds at a time


@kernel
def _couple(couplings, x, i, first, row):  # type: ignore[no-untyped-def]
    """Add row i of the operator's product, from column `first` on.

    Slices start where they are needed: an index that cannot be negative is what
    lets the compiler use vectors.
    """
    width = len(row)
    for o in range(25):
        start = first + o % 5 - 2
        line = x[i + o // 5 - 2, start : start + width]
        coupling = couplings[o, first : first + width]
        for k in range(width):
            row[k] += coupling[k] * line[k]


@adaptive_kernel(MANY)
def _advance(x, couplings, spans, scale, rhs, step, out, keep, gain):  # type: ignore[no-untyped-def]
    """One Chebyshev step: step = keep step + gain scale (rhs - A x), out = x + step."""
    for i in prange(2, len(x) - 2):
        first, last = spans[i, 0], spans[i, 1]
        row = np.zeros(last - first, np.float32)
        _couple(couplings[i], x, i, first, row)
        moves, scales, wanted = step[i, first:last], scale[i, first:last], rhs[i, first:last]
        here, there = x[i, first:last], out[i, first:last]
        for k in range(len(row)):
            moves[k] = keep * moves[k] + gain * scales[k] * (wanted[k] - row[k])
            there[k] = here[k] + moves[k]


@adaptive_kernel(MANY)
def _residual(x, couplings, spans, free, rhs, out):  # type: ignore[no-untyped-def]
    """Subtract the product from the right-hand side; 0 on fixed nodes."""
    for i in prange(2, len(x) - 2):
        first, last = spans[i, 0], spans[i, 1]
        row = np.zeros(last - first, np.float32)
        _couple(couplings[i], x, i, first, row)
        wanted, left, open_ = rhs[i, first:last], out[i, first:last], free[i, first:last]
        for k in range(len(row)):
            left[k] = wanted[k] - row[k] if open_[k] else np.float32(0.0)


@parallel_kernel
def _scale(couplings, free, out):  # type: ignore[no-untyped-def]
    """Reciprocal row sums of absolute couplings; 0 on fixed nodes."""
    n, m = free.shape
    for i in prange(n):
        total = np.zeros(m, np.float32)
        for o in range(25):
            row = couplings[i, o]
            for j in range(m):
                total[j] += abs(row[j])
        for j in range(m):
            out[i, j] = np.float32(1.0) / total[j] if free[i, j] and total[j] > 0.0 else 0.0


@parallel_kernel
def _coarsen(fine, spans, coarse):  # type: ignore[no-untyped-def]
    """Galerkin product PᵀAP, one axis after the other."""
    rows, cols = coarse.shape[0], coarse.shape[2]
    n = fine.shape[0]
    for block in prange((rows - 4 + BLOCK - 1) // BLOCK):
        top = 2 + block * BLOCK
        low = min(top + BLOCK, rows - 2)
        folded = np.zeros((5, cols), np.float32)
        for i in range(max(2 * top - 4, 2), min(2 * low - 2, n - 2)):
            lo, hi = spans[i, 0], spans[i, 1]
            for d in range(5 if hi > lo else 0):
                fold_columns(fine[i], 5 * d, lo, hi, folded)
                fold_rows(folded, i, d, top, low, lo, hi, coarse)


@dataclass(frozen=True, eq=False)
class Stored:
    """One lattice of the hierarchy.

    Parameters
    ----------
    couplings : (n, 25, m) ndarray of float32
        Of a symmetric positive definite operator; none on fixed nodes.
    free : (n, m) ndarray of bool
        Nodes to solve for; the border of two is never free.
    scale : (n, m) ndarray of float32
        Reciprocal row sums of absolute couplings, 0 on fixed nodes: the operator
        times these has no eigenvalue above 1 (Gershgorin), which the diagonal
        alone does not promise.
    spans : (n, 2) ndarray of int
        First free node of each row, and one past its last; equal where none is.
    """

    couplings: Singles
    free: Bools
    scale: Singles
    spans: Ints

    def advance(
        self, x: Singles, rhs: Singles, step: Singles, out: Singles, keep: float, gain: float
    ) -> None:
        """Take one Chebyshev step: step = keep step + gain scale (rhs - A x), out = x + step."""
        _advance(
            x, self.couplings, self.spans, self.scale, rhs, step, out,
            np.float32(keep), np.float32(gain),
        )  # fmt: skip

    def residual(self, x: Singles, rhs: Singles, out: Singles) -> None:
        """Subtract the product from the right-hand side; 0 on fixed nodes."""
        _residual(x, self.couplings, self.spans, self.free, rhs, out)

    def coarse(self) -> "Stored":
        """Build the operator on the next coarser lattice."""
        n, _, m = self.couplings.shape
        couplings = np.zeros((coarser(n), 25, coarser(m)), np.float32)
        _coarsen(self.couplings, self.spans, couplings)
        return stored(couplings)


def stored(couplings: Singles) -> Stored:
    """Free the nodes with couplings; all others are fixed."""
    diagonal = couplings[:, 12, :]
    free = diagonal > 1e-6 * diagonal.max()
    scale = np.empty(free.shape, np.float32)
    _scale(couplings, free, scale)
    first = free.argmax(axis=1)
    last = free.shape[1] - free[:, ::-1].argmax(axis=1)
    spans = np.stack([first, np.where(free.any(axis=1), last, first)], axis=1)
    return Stored(couplings, free, scale, spans)
