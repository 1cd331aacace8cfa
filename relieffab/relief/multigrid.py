"""Conjugate gradients, preconditioned by one Chebyshev-smoothed V-cycle.

Levels halve the lattice; coarse operators are Galerkin products with bilinear
interpolation, which keeps every operator at 25 couplings a node.  Levels live
in single precision, conjugate gradients in double.  Lattices carry a border of
two fixed nodes, and a fixed node has no couplings but a 1 with itself.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import parallel_kernel, prange

Singles = NDArray[np.float32]
Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

COARSEST = 300  # free nodes below which a level is solved directly
DEGREE = 2  # of the Chebyshev smoother
SMOOTHED = 12.0  # the smoother damps the spectrum's top down to this fraction


@parallel_kernel
def _apply(stencil, x, out):  # type: ignore[no-untyped-def]
    """Multiply by the operator."""
    n, m = x.shape
    for i in prange(2, n - 2):
        row = np.zeros(m, out.dtype)
        for o in range(25):
            shift = o % 5 - 2
            line = x[i + o // 5 - 2]
            coupling = stencil[i, o]
            for j in range(2, m - 2):
                row[j] += coupling[j] * line[j + shift]
        out[i] = row


@parallel_kernel
def _fix(stencil, free):  # type: ignore[no-untyped-def]
    """Cut the couplings of fixed nodes."""
    n, m = free.shape
    for i in prange(n):
        for j in range(m):
            for o in range(25):
                if not free[i, j]:
                    stencil[i, o, j] = 1.0 if o == 12 else 0.0
                elif not free[i + o // 5 - 2, j + o % 5 - 2]:
                    stencil[i, o, j] = 0.0


@parallel_kernel
def _coarsen(fine, free, coarse):  # type: ignore[no-untyped-def]
    """Galerkin product PᵀAP; coarse node I lies on fine node 2 I - 2."""
    rows, _, cols = coarse.shape
    n, m = free.shape
    for big_i in prange(2, rows - 2):
        for big_j in range(2, cols - 2):
            for u in range(-1, 2):
                for v in range(-1, 2):
                    i, j = 2 * big_i - 2 + u, 2 * big_j - 2 + v
                    if i >= n - 2 or j >= m - 2 or i < 2 or j < 2 or not free[i, j]:
                        continue
                    w = (1.0 - 0.5 * abs(u)) * (1.0 - 0.5 * abs(v))
                    for o in range(25):
                        value = w * fine[i, o, j]
                        if value == 0.0:
                            continue
                        # Twice the place of the coupled node on the coarse lattice.
                        a, b = i + o // 5, j + o % 5
                        for s in range(1 + a % 2):
                            for t in range(1 + b % 2):
                                e = a // 2 + s - big_i + 2
                                f = b // 2 + t - big_j + 2
                                share = value / ((1 + a % 2) * (1 + b % 2))
                                coarse[big_i, 5 * e + f, big_j] += share


@parallel_kernel
def _restrict(fine, coarse):  # type: ignore[no-untyped-def]
    """Pᵀ of a fine vector that is 0 on fixed nodes."""
    rows, cols = coarse.shape
    n, m = fine.shape
    for big_i in prange(2, rows - 2):
        for big_j in range(2, cols - 2):
            total = np.float32(0.0)
            for u in range(-1, 2):
                for v in range(-1, 2):
                    i, j = 2 * big_i - 2 + u, 2 * big_j - 2 + v
                    if 2 <= i < n - 2 and 2 <= j < m - 2:
                        total += (
                            np.float32((1.0 - 0.5 * abs(u)) * (1.0 - 0.5 * abs(v))) * fine[i, j]
                        )
            coarse[big_i, big_j] = total


@parallel_kernel
def _prolong(coarse, free, fine):  # type: ignore[no-untyped-def]
    """Add P of a coarse vector to a fine one."""
    n, m = fine.shape
    for i in prange(2, n - 2):
        a = (i + 2) // 2
        c = a + i % 2
        for j in range(2, m - 2):
            if free[i, j]:
                b = (j + 2) // 2
                d = b + j % 2
                fine[i, j] += np.float32(0.25) * (
                    coarse[a, b] + coarse[a, d] + coarse[c, b] + coarse[c, d]
                )


@parallel_kernel
def _dot(x, y, rows):  # type: ignore[no-untyped-def]
    """Row by row inner products, so that threads do not change the sum."""
    for i in prange(len(rows)):
        total = 0.0
        for j in range(x.shape[1]):
            total += x[i, j] * y[i, j]
        rows[i] = total


def dot(x: Floats, y: Floats) -> float:
    """Inner product of two lattices, the same for any number of threads."""
    rows = np.empty(len(x))
    _dot(x, y, rows)
    return float(rows.sum())


@dataclass(frozen=True, eq=False)
class Level:
    """One lattice of the hierarchy.

    Parameters
    ----------
    stencil : (n, 25, m) ndarray of float32
    free : (n, m) ndarray of bool
    scale : (n, m) ndarray of float32
        Reciprocal row sums of absolute couplings, 0 on fixed nodes: the operator
        times these has no eigenvalue above 1 (Gershgorin), which the diagonal
        alone does not promise.
    """

    stencil: Singles
    free: Bools
    scale: Singles


@parallel_kernel
def _scale(stencil, free, out):  # type: ignore[no-untyped-def]
    """Reciprocal row sums of absolute couplings; 0 on fixed nodes."""
    n, m = free.shape
    for i in prange(n):
        for j in range(m):
            total = np.float32(0.0)
            for o in range(25):
                total += abs(stencil[i, o, j])
            out[i, j] = np.float32(1.0) / total if free[i, j] and total > 0.0 else 0.0


def _level(stencil: Singles, free: Bools) -> Level:
    scale = np.empty(free.shape, np.float32)
    _scale(stencil, free, scale)
    return Level(stencil, free, scale)


def build(stencil: Singles, free: Bools) -> list[Level]:
    """Make the hierarchy, finest level first.

    Parameters
    ----------
    stencil : (n, 25, m) ndarray of float32
        Couplings of a symmetric positive definite operator; changed in place.
    free : (n, m) ndarray of bool
        Nodes to solve for; the border of two is never free.

    Returns
    -------
    list of Level
    """
    _fix(stencil, free)
    levels = [_level(stencil, free)]
    while np.count_nonzero(free) > COARSEST and min(free.shape) > 12:
        n, m = free.shape
        coarse = np.zeros(((n - 4) // 2 + 5, 25, (m - 4) // 2 + 5), np.float32)
        _coarsen(levels[-1].stencil, free, coarse)
        diagonal = coarse[:, 12, :]
        free = diagonal > 1e-6 * diagonal.max()
        _fix(coarse, free)
        levels.append(_level(coarse, free))
    return levels


def _smooth(level: Level, rhs: Singles, x: Singles, *, start_at_zero: bool) -> None:
    """Chebyshev iteration on the upper part of the spectrum (Saad 2003, Alg. 12.1)."""
    high, low = 1.0, 1.0 / SMOOTHED
    centre, half = (high + low) / 2, (high - low) / 2
    sigma = centre / half
    rho = 1.0 / sigma
    product = np.zeros_like(x)
    if not start_at_zero:
        _apply(level.stencil, x, product)
    step = (rhs - product) * level.scale / np.float32(centre)
    x += step
    for _ in range(DEGREE - 1):
        _apply(level.stencil, x, product)
        rho_next = 1.0 / (2.0 * sigma - rho)
        step *= np.float32(rho_next * rho)
        step += (rhs - product) * level.scale * np.float32(2.0 * rho_next / half)
        x += step
        rho = rho_next


def cycle(levels: list[Level], rhs: Singles) -> Singles:
    """One symmetric V-cycle from 0."""
    level = levels[0]
    x = np.zeros_like(rhs)
    if len(levels) == 1:
        for sweep in range(8):
            _smooth(level, rhs, x, start_at_zero=sweep == 0)
        return x
    _smooth(level, rhs, x, start_at_zero=True)
    residual = np.zeros_like(rhs)
    _apply(level.stencil, x, residual)
    np.subtract(rhs, residual, out=residual)
    residual *= level.free
    coarse = np.zeros(levels[1].free.shape, np.float32)
    _restrict(residual, coarse)
    coarse *= levels[1].free
    _prolong(cycle(levels[1:], coarse), level.free, x)
    _smooth(level, rhs, x, start_at_zero=False)
    return x


def solve(
    levels: list[Level], rhs: Floats, *, tolerance: float, most: int = 60
) -> tuple[Floats, int]:
    """Solve A x = rhs on the free nodes.

    Parameters
    ----------
    levels : list of Level
        From `build`.
    rhs : (n, m) ndarray
    tolerance : float
        On the residual, relative to the right-hand side.
    most : int
        Iterations at most.

    Returns
    -------
    x : (n, m) ndarray
        0 on fixed nodes.
    iterations : int
    """
    top = levels[0]
    residual = np.where(top.free, rhs, 0.0)
    x = np.zeros_like(residual)
    product = np.zeros_like(residual)
    goal = tolerance**2 * dot(residual, residual)
    direction, rho = None, 0.0
    for iteration in range(most):
        if dot(residual, residual) <= goal:
            return x, iteration
        size = np.abs(residual).max()
        better = cycle(levels, (residual / size).astype(np.float32)) * size
        rho_next = dot(residual, better)
        direction = better if direction is None else better + (rho_next / rho) * direction
        rho = rho_next
        _apply(top.stencil, direction, product)
        step = rho / dot(direction, product)
        x += step * direction
        residual -= step * product
    return x, most
