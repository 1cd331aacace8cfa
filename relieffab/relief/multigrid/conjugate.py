"""Conjugate gradients, preconditioned by one V-cycle.

Levels work in single precision, conjugate gradients in double.
"""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import parallel_kernel, prange, summing_kernel
from relieffab.relief.multigrid.cycle import Cycle, Level

Floats = NDArray[np.float64]


@summing_kernel
def _row_dot(x, y, i):  # type: ignore[no-untyped-def]
    total = 0.0
    for j in range(x.shape[1]):
        total += x[i, j] * y[i, j]
    return total


@parallel_kernel
def _dot(x, y, rows):  # type: ignore[no-untyped-def]
    """Row by row inner products, so that threads do not change the sum."""
    for i in prange(len(rows)):
        rows[i] = _row_dot(x, y, i)


def dot(x: Floats, y: NDArray[np.floating]) -> float:
    """Inner product of two lattices, the same for any number of threads."""
    rows = np.empty(len(x))
    _dot(x, y, rows)
    return float(rows.sum())


@parallel_kernel
def _turn(direction, better, beta, size):  # type: ignore[no-untyped-def]
    """Direction = beta direction + size better."""
    for i in prange(len(direction)):
        row, new = direction[i], better[i]
        for j in range(len(row)):
            row[j] = beta * row[j] + size * new[j]


@parallel_kernel
def _go(x, residual, direction, product, step, rows):  # type: ignore[no-untyped-def]
    """X += step direction, residual -= step product; the residual's square by row."""
    for i in prange(len(x)):
        here, left, way, row = x[i], residual[i], direction[i], product[i]
        for j in range(len(here)):
            here[j] += step * way[j]
        for j in range(len(here)):
            left[j] -= step * row[j]
        rows[i] = _row_dot(residual, residual, i)


@parallel_kernel
def _single(residual, scale, out):  # type: ignore[no-untyped-def]
    """Scaled residual in single precision."""
    for i in prange(len(out)):
        left, row = residual[i], out[i]
        for j in range(len(row)):
            row[j] = scale * left[j]


def solve(
    apply: Callable[[Floats, Floats], None],
    levels: Sequence[Level],
    rhs: Floats,
    *,
    tolerance: float,
    most: int = 60,
) -> tuple[Floats, int]:
    """Solve A x = rhs on the free nodes.

    Parameters
    ----------
    apply : callable
        Writes A x, 0 on fixed nodes, into its second argument.
    levels : sequence of Level
        Of A and its coarser versions, finest first.
    rhs : (n, m) ndarray
    tolerance : float
        On the residual, relative to the right-hand side.
    most : int
        Iterations at most.

    Returns
    -------
    x : (n, m) ndarray
        0 on fixed nodes.  Where A turns out not to be positive, what was found up to
        there, or the preconditioner's own answer: a way down in any case (Steihaug 1983).
    iterations : int
    """
    cycle = Cycle(levels)
    residual = np.where(levels[0].free, rhs, 0.0)
    x, product, direction = (np.zeros_like(residual) for _ in range(3))
    single, rows = np.zeros(residual.shape, np.float32), np.empty(len(residual))
    square = dot(residual, residual)
    goal, rho = tolerance**2 * square, 0.0
    for iteration in range(most):
        if square <= goal:
            return x, iteration
        size = float(np.sqrt(square / residual.size))
        _single(residual, 1.0 / size, single)
        better = cycle(single)
        before, rho = rho, dot(residual, better) * size
        _turn(direction, better, rho / before if before else 0.0, size)
        apply(direction, product)
        curvature = dot(direction, product)
        if curvature <= 0:
            return (x if iteration else direction), iteration + 1
        _go(x, residual, direction, product, rho / curvature, rows)
        square = float(rows.sum())
    return x, most
