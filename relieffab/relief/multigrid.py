"""Conjugate gradients, preconditioned by one Chebyshev-smoothed V-cycle.

Levels halve the lattice; coarse functions are quadratic B-splines, whose Galerkin
products keep every operator at 25 couplings a node.  They are of order three, and
a fourth-order operator asks for transfers whose orders add up to more than four
(Hemker 1990): bilinear ones cost more iterations the finer the
lattice.  Levels live
in single precision, conjugate gradients in double.  Lattices carry a border of
two fixed nodes, and a fixed node has no couplings.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import adaptive_kernel, kernel, parallel_kernel, prange

Singles = NDArray[np.float32]
Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

MANY = 60_000  # nodes from which threads pay
COARSEST = 300  # free nodes below which a level is only smoothed
DEGREE = 2  # of the Chebyshev smoother
COARSEST_SWEEPS = 16
NEAR, FAR = np.float32(0.75), np.float32(0.25)
SMOOTHED = 12.0  # the smoother damps the spectrum's top down to this fraction


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


@adaptive_kernel(25 * MANY)
def _apply(stencil, spans, x, out):  # type: ignore[no-untyped-def]
    """Multiply by the operator, from each row's first to its last free node."""
    for i in prange(2, len(x) - 2):
        first, last = spans[i, 0], spans[i, 1]
        row = out[i, first:last]
        row[:] = 0.0
        _couple(stencil[i], x, i, first, row)


@parallel_kernel
def _fix(stencil, open_):  # type: ignore[no-untyped-def]
    """Cut the couplings of fixed nodes; `open_` is 1 on free nodes, 0 on fixed ones."""
    n, m = open_.shape
    for i in prange(2, n - 2):
        here = open_[i, 2 : m - 2]
        for o in range(25):
            there = open_[i + o // 5 - 2, o % 5 : o % 5 + m - 4]
            row = stencil[i, o, 2 : m - 2]
            for k in range(m - 4):
                row[k] *= here[k] * there[k]


@kernel
def _across(fine, o, out):  # type: ignore[no-untyped-def]
    """Fold one row of couplings along the columns: Pᵀ and P of that axis.

    `fine` is one row of the operator, `o` its first coupling to the row meant;
    out[f, J] then couples coarse column J, on this fine row, with column J + f - 2.
    """
    m = fine.shape[1]
    out[:] = np.float32(0.0)
    for v in range(4):
        w = NEAR if 0 < v < 3 else FAR
        # Columns J whose fine column 2 J - 4 + v lies within the border.
        first, last = (7 - v) // 2, (m - 3 + 4 - v) // 2 + 1
        for d in range(5):
            # The coupled node, 2 J - 6 + v + d, has two parents.
            home = (v + d + 1) // 2
            other = home + 1 if (v + d) % 2 == 0 else home - 1
            near, far = out[home, first:last], out[other, first:last]
            row = fine[o + d, 2 * first - 4 + v : m]
            for k in range(last - first):
                value = w * row[2 * k]
                near[k] += NEAR * value
                far[k] += FAR * value


@parallel_kernel
def _coarsen(fine, coarse):  # type: ignore[no-untyped-def]
    """Galerkin product PᵀAP, one axis after the other; fixed nodes have no couplings."""
    rows, _, cols = coarse.shape
    n = fine.shape[0]
    for big_i in prange(2, rows - 2):
        folded = np.empty((5, cols), np.float32)
        for u in range(4):
            i = 2 * big_i - 4 + u
            if i < 2 or i >= n - 2:
                continue
            w = NEAR if 0 < u < 3 else FAR
            for d in range(5):
                _across(fine[i], 5 * d, folded)
                a = i + d - 2
                home = (a + 3) // 2
                other = home + 1 if a % 2 == 0 else home - 1
                e, f = 5 * (home - big_i + 2), 5 * (other - big_i + 2)
                for g in range(5):
                    row = folded[g]
                    near, far = coarse[big_i, e + g], coarse[big_i, f + g]
                    for k in range(cols):
                        near[k] += w * NEAR * row[k]
                        far[k] += w * FAR * row[k]


@adaptive_kernel(MANY)
def _restrict(fine, coarse):  # type: ignore[no-untyped-def]
    """Pᵀ of a fine vector that is 0 on fixed nodes."""
    rows, cols = coarse.shape
    n, m = fine.shape
    for big_i in prange(2, rows - 2):
        line = np.zeros(m, np.float32)
        for u in range(4):
            i = 2 * big_i - 4 + u
            if 2 <= i < n - 2:
                w = NEAR if 0 < u < 3 else FAR
                line += w * fine[i]
        for big_j in range(2, cols - 2):
            total = np.float32(0.0)
            for v in range(4):
                j = 2 * big_j - 4 + v
                if 2 <= j < m - 2:
                    total += (NEAR if 0 < v < 3 else FAR) * line[j]
            coarse[big_i, big_j] = total


@adaptive_kernel(MANY)
def _prolong(coarse, free, fine):  # type: ignore[no-untyped-def]
    """Add P of a coarse vector to a fine one."""
    n, m = fine.shape
    for i in prange(2, n - 2):
        a = (i + 3) // 2
        c = a + 1 if i % 2 == 0 else a - 1
        line = NEAR * coarse[a] + FAR * coarse[c]
        for j in range(2, m - 2):
            if free[i, j]:
                b = (j + 3) // 2
                d = b + 1 if j % 2 == 0 else b - 1
                fine[i, j] += NEAR * line[b] + FAR * line[d]


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
    spans : (n, 2) ndarray of int
        First free node of each row, and one past its last; equal where none is.
    """

    stencil: Singles
    free: Bools
    scale: Singles
    spans: Ints


@parallel_kernel
def _scale(stencil, free, out):  # type: ignore[no-untyped-def]
    """Reciprocal row sums of absolute couplings; 0 on fixed nodes."""
    n, m = free.shape
    for i in prange(n):
        total = np.zeros(m, np.float32)
        for o in range(25):
            row = stencil[i, o]
            for j in range(m):
                total[j] += abs(row[j])
        for j in range(m):
            out[i, j] = np.float32(1.0) / total[j] if free[i, j] and total[j] > 0.0 else 0.0


def _level(stencil: Singles, free: Bools) -> Level:
    scale = np.empty(free.shape, np.float32)
    _scale(stencil, free, scale)
    first = free.argmax(axis=1)
    last = free.shape[1] - free[:, ::-1].argmax(axis=1)
    spans = np.stack([first, np.where(free.any(axis=1), last, first)], axis=1)
    return Level(stencil, free, scale, spans)


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
    _fix(stencil, free.astype(np.float32))
    levels = [_level(stencil, free)]
    while np.count_nonzero(free) > COARSEST and min(free.shape) > 12:
        n, m = free.shape
        coarse = np.zeros((n // 2 + 4, 25, m // 2 + 4), np.float32)
        _coarsen(levels[-1].stencil, coarse)
        diagonal = coarse[:, 12, :]
        free = diagonal > 1e-6 * diagonal.max()
        _fix(coarse, free.astype(np.float32))
        levels.append(_level(coarse, free))
    return levels


@adaptive_kernel(25 * MANY)
def _advance(stencil, spans, scale, rhs, x, step, out, keep, gain):  # type: ignore[no-untyped-def]
    """One Chebyshev step: step = keep step + gain scale (rhs - A x), out = x + step."""
    for i in prange(2, len(x) - 2):
        first, last = spans[i, 0], spans[i, 1]
        row = np.zeros(last - first, np.float32)
        _couple(stencil[i], x, i, first, row)
        moves, scales, wanted = step[i, first:last], scale[i, first:last], rhs[i, first:last]
        here, there = x[i, first:last], out[i, first:last]
        for k in range(len(row)):
            moves[k] = keep * moves[k] + gain * scales[k] * (wanted[k] - row[k])
            there[k] = here[k] + moves[k]


@adaptive_kernel(25 * MANY)
def _residual(stencil, spans, free, rhs, x, out):  # type: ignore[no-untyped-def]
    """Subtract the product from the right-hand side; 0 on fixed nodes."""
    for i in prange(2, len(x) - 2):
        first, last = spans[i, 0], spans[i, 1]
        row = np.zeros(last - first, np.float32)
        _couple(stencil[i], x, i, first, row)
        wanted, left, open_ = rhs[i, first:last], out[i, first:last], free[i, first:last]
        for k in range(len(row)):
            left[k] = wanted[k] - row[k] if open_[k] else np.float32(0.0)


def _smooth(level: Level, rhs: Singles, x: Singles, sweeps: int) -> Singles:
    """Chebyshev iteration on the upper part of the spectrum (Saad 2003, Alg. 12.1)."""
    high, low = 1.0, 1.0 / SMOOTHED
    centre, half = (high + low) / 2, (high - low) / 2
    sigma = centre / half
    rho = 1.0 / sigma
    keep, gain = 0.0, 1.0 / centre
    step, other = np.zeros_like(x), np.zeros_like(x)
    for _ in range(sweeps):
        _advance(
            level.stencil, level.spans, level.scale, rhs, x, step, other,
            np.float32(keep), np.float32(gain),
        )  # fmt: skip
        x, other = other, x
        rho_next = 1.0 / (2.0 * sigma - rho)
        keep, gain = rho_next * rho, 2.0 * rho_next / half
        rho = rho_next
    return x


def cycle(levels: list[Level], rhs: Singles) -> Singles:
    """One symmetric V-cycle from 0."""
    level = levels[0]
    x = np.zeros_like(rhs)
    if len(levels) == 1:
        return _smooth(level, rhs, x, COARSEST_SWEEPS)
    x = _smooth(level, rhs, x, DEGREE)
    residual = np.zeros_like(rhs)
    _residual(level.stencil, level.spans, level.free, rhs, x, residual)
    coarse = np.zeros(levels[1].free.shape, np.float32)
    _restrict(residual, coarse)
    coarse *= levels[1].free
    _prolong(cycle(levels[1:], coarse), level.free, x)
    return _smooth(level, rhs, x, DEGREE)


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
        _apply(top.stencil, top.spans, direction, product)
        step = rho / dot(direction, product)
        x += step * direction
        residual -= step * product
    return x, most
