"""The Gauss-Newton operator on the next coarser lattice, put together row by row.

Couplings of the fine lattice live in a ring of three rows for as long as it takes
to fold them onto the coarse one: stored whole they would take more memory than
everything else together.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.relief.energy.rows import DEPTH, FORM, LIGHT, LINE, TWIST, buffers, tilt
from relieffab.relief.energy.tangent import Finest, Tangent
from relieffab.relief.energy.terms import asked, columns
from relieffab.relief.multigrid.cycle import Level, hierarchy
from relieffab.relief.multigrid.stored import stored
from relieffab.relief.multigrid.transfer import coarser, fold_columns, fold_rows

Singles = NDArray[np.float32]
Bools = NDArray[np.bool_]

# Nodes, as (row, column) from the middle one, that a difference of radiance along
# the falling and the rising diagonal of a node's pixels depends on.
NODES = np.array(
    [
        [(-1, -1), (-1, 0), (0, -1), (0, 0), (0, 1), (1, 0), (1, 1)],
        [(-1, 0), (-1, 1), (0, -1), (0, 0), (0, 1), (1, -1), (1, 0)],
    ]
)
COARSE_ROWS = 16  # in a block, which one thread takes at a time
SIGNS = np.array([1, -1, -1, 1])  # of the corners in a pixel's twist


@kernel
def _slopes(weighing, c, r, lo, hi, ring):  # type: ignore[no-untyped-def]
    """Add the couplings of the slopes and twists of pixel row r."""
    width = hi - lo
    inside, ink = weighing.mask[r, lo:hi], weighing.stencil[r, lo:hi]
    weight, bend = np.empty(width, ring.dtype), np.empty(width, ring.dtype)
    for k in range(width):
        weight[k] = (c[DEPTH] if inside[k] else 0.0) + c[LINE] * ink[k]
        bend[k] = c[TWIST] if inside[k] else 0.0
    for one in range(4):
        for two in range(4):
            down, right = two // 2 - one // 2, two % 2 - one % 2
            row = ring[(r + one // 2) % 3, 5 * (down + 2) + right + 2]
            row = row[lo + one % 2 : hi + one % 2]
            # Corners 0 and 3 end one diagonal, 1 and 2 the other.
            pair = 1.0 if one == two else (-1.0 if one + two == 3 else 0.0)
            sign = SIGNS[one] * SIGNS[two]
            for k in range(width):
                row[k] += pair * weight[k] + sign * bend[k]


@kernel
def _derivatives(b, r, j, lines):  # type: ignore[no-untyped-def]
    """Derive light j's differences at node row r by the 7 heights of `NODES`.

    `b` holds pixel rows r - 1 and r; lines[0 or 1, place, k] is for the node left of
    the buffers' column k.
    """
    width = lines.shape[2]
    far, near = (r - 1) % 2, r % 2
    al_far, be_far, al_near, be_near = (
        b.along[far, j],
        b.across[far, j],
        b.along[near, j],
        b.across[near, j],
    )
    falling, rising = lines[0], lines[1]
    for k in range(1, width):
        falling[0, k], falling[1, k], falling[2, k] = al_far[k - 1], -be_far[k - 1], be_far[k - 1]
    for k in range(1, width):
        falling[3, k], falling[4, k] = -al_near[k] - al_far[k - 1], be_near[k]
        falling[5, k], falling[6, k] = -be_near[k], al_near[k]
    for k in range(1, width):
        rising[0, k], rising[1, k], rising[4, k] = -al_far[k], be_far[k], al_far[k]
    for k in range(1, width):
        rising[2, k], rising[3, k] = al_near[k - 1], -be_far[k] - be_near[k - 1]
        rising[5, k], rising[6, k] = be_near[k - 1], -al_near[k - 1]


@kernel
def _lights(b, weighing, c, r, lo, hi, lines, heavy, ring):  # type: ignore[no-untyped-def]
    """Add the couplings of the gradients of radiance at node row r."""
    width, whole = hi - lo, weighing.whole[r, lo:hi]
    for j in range(b.along.shape[1]):
        _derivatives(b, r, j, lines)
        for diagonal in range(2):
            for one in range(7):
                line = lines[diagonal, one]
                for k in range(1, width):
                    heavy[k] = c[LIGHT] * line[k] if whole[k] else 0.0
                y, x = NODES[diagonal, one]
                for two in range(7):
                    down, right = NODES[diagonal, two, 0] - y, NODES[diagonal, two, 1] - x
                    row = ring[(r + y) % 3, 5 * (down + 2) + right + 2][lo + x : hi + x]
                    other = lines[diagonal, two]
                    for k in range(1, width):
                        row[k] += heavy[k] * other[k]


@kernel
def _close(row, free, i, lo, hi):  # type: ignore[no-untyped-def]
    """Cut the couplings of fixed nodes from row i."""
    for o in range(25):
        here, line = free[i, lo:hi], row[o, lo:hi]
        start = lo + o % 5 - 2
        there = free[i + o // 5 - 2, start : start + hi - lo]
        for k in range(hi - lo):
            line[k] = line[k] if here[k] and there[k] else 0.0


@kernel
def _reciprocal(row, lo, hi, out):  # type: ignore[no-untyped-def]
    """Reciprocal sums of a row's absolute couplings, 0 where there are none."""
    total = np.zeros(hi - lo, row.dtype)
    for o in range(25):
        line = row[o, lo:hi]
        for k in range(hi - lo):
            total[k] += abs(line[k])
    for k in range(hi - lo):
        out[lo + k] = 1.0 / total[k] if total[k] > 0.0 else 0.0


@parallel_kernel
def _coarse(p, q, weighing, figure, lights, c, places, free, scale, coarse):  # type: ignore[no-untyped-def]
    """Fold the fine operator onto the coarse lattice; fine rows' `scale` on the way."""
    n, m = figure.shape
    rows, cols = coarse.shape[0], coarse.shape[2]
    for block in prange(len(places)):
        top = 2 + block * COARSE_ROWS
        low = min(top + COARSE_ROWS, rows - 2)
        lo, hi = places[block, 0], places[block, 1]
        if hi <= lo:
            continue
        b = buffers(len(lights), hi - lo, c)
        ring = np.zeros((3, 25, m), c.dtype)
        lines, heavy = np.zeros((2, 7, hi - lo), c.dtype), np.zeros(hi - lo, c.dtype)
        folded = np.zeros((5, cols), c.dtype)
        first, last = max(2 * top - 4, 2), min(2 * low - 2, n - 2)
        for r in range(first - 2, last + 1):
            tilt(p[r, lo:hi], q[r, lo:hi], lights, c, r, b)
            if r < first - 1:
                continue
            ring[(r + 1) % 3] = 0.0
            inside, middle = figure[r], ring[r % 3, 12]
            for k in range(lo, hi):
                middle[k] += c[FORM] if inside[k] else 0.0
            _slopes(weighing, c, r, lo, hi, ring)
            _lights(b, weighing, c, r, lo, hi, lines, heavy, ring)
            i = r - 1
            if i >= first:
                done = ring[i % 3]
                _close(done, free, i, lo + 2, hi - 2)
                if i >= 2 * top - 2:
                    _reciprocal(done, lo + 2, hi - 2, scale[i])
                for d in range(5):
                    fold_columns(done, 5 * d, lo, hi, folded)
                    fold_rows(folded, i, d, top, low, lo, hi, coarse)


def coarse_couplings(tangent: Tangent, free: Bools) -> tuple[Singles, Singles]:
    """Fold the operator on free nodes onto the next coarser lattice.

    Parameters
    ----------
    tangent : Tangent
    free : (n, m) ndarray of bool
        Nodes to solve for, all of the figure.

    Returns
    -------
    couplings : (rows, 25, cols) ndarray of float32
        Galerkin product, as `multigrid.stored` keeps it.
    scale : (n, m) ndarray of float32
        Reciprocal row sums of the fine operator's absolute couplings; 0 on nodes
        that are not free.
    """
    terms = tangent.terms
    n, m = free.shape
    couplings = np.zeros((coarser(n), 25, coarser(m)), np.float32)
    scale = np.zeros((n, m), np.float32)
    tops = np.arange(2, len(couplings) - 2, COARSE_ROWS)
    places = columns(terms.figure, 2 * tops - 8, 2 * COARSE_ROWS + 10)
    kind = np.float32
    _coarse(
        tangent.p, tangent.q, asked(terms), terms.figure, terms.lights.astype(kind),
        terms.constants(kind), places, free, scale, couplings,
    )  # fmt: skip
    return couplings, scale


def levels(tangent: Tangent, free: Bools) -> list[Level]:
    """Build the hierarchy that preconditions the operator on free nodes, finest first."""
    couplings, scale = coarse_couplings(tangent, free)
    return [Finest(tangent, free, scale), *hierarchy(stored(couplings))]
