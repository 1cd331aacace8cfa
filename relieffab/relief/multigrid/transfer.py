"""Between a lattice and the next coarser one: quadratic B-splines.

Coarse node I spreads over fine nodes 2 I - 4 to 2 I - 1 with weights 1/4, 3/4, 3/4
and 1/4, so that every fine node has two parents an axis, and Galerkin products keep
every operator at 25 couplings a node.  The splines are of order three, and a
fourth-order operator asks for transfers whose orders add up to more than four
(Hemker 1990): bilinear ones cost more iterations the finer the lattice.
"""

import numpy as np

from relieffab.compiled import adaptive_kernel, kernel, prange

MANY = 60_000  # nodes from which threads pay
NEAR, FAR = np.float32(0.75), np.float32(0.25)


def coarser(n: int) -> int:
    """Nodes along an axis of the next coarser lattice, its border of two included."""
    return n // 2 + 4


@kernel
def parents(i):  # type: ignore[no-untyped-def]
    """Coarse nodes that a fine one depends on, the nearer first."""
    home = (i + 3) // 2
    return home, home + 1 if i % 2 == 0 else home - 1


@kernel
def fold_columns(fine, o, lo, hi, out):  # type: ignore[no-untyped-def]
    """Fold one row of couplings along the columns: Pᵀ and P of that axis.

    `fine` is one row of the operator, 0 outside columns lo to hi - 1, and `o` its
    first coupling to the row meant; out[f, J] then couples coarse column J, on this
    fine row, with column J + f - 2.
    """
    m = fine.shape[1]
    out[:, max(lo // 2, 0) : hi // 2 + 4] = 0.0
    for v in range(4):
        w = NEAR if 0 < v < 3 else FAR
        # Columns J whose fine column 2 J - 4 + v lies in the span.
        first, last = (lo + 5 - v) // 2, (hi + 3 - v) // 2 + 1
        for d in range(5):
            # The coupled node, 2 J - 6 + v + d, has two parents.
            home = (v + d + 1) // 2
            other = home + 1 if (v + d) % 2 == 0 else home - 1
            near, far = out[home, first:last], out[other, first:last]
            row = fine[o + d, 2 * first - 4 + v : m]
            for k in range(min(last - first, (len(row) + 1) // 2)):
                value = w * row[2 * k]
                near[k] += NEAR * value
                far[k] += FAR * value


@kernel
def fold_rows(folded, i, d, top, low, lo, hi, coarse):  # type: ignore[no-untyped-def]
    """Add one folded row of couplings, of row i with row i + d - 2, to rows top to low - 1."""
    first, last = max(lo // 2, 0), min(hi // 2 + 4, coarse.shape[2])
    near, far = parents(i + d - 2)
    mine = parents(i)
    for parent in range(2):
        big = mine[parent]
        if top <= big < low:
            w = NEAR if parent == 0 else FAR
            for g in range(5):
                row = folded[g, first:last]
                one = coarse[big, 5 * (near - big + 2) + g, first:last]
                two = coarse[big, 5 * (far - big + 2) + g, first:last]
                for k in range(last - first):
                    one[k] += w * NEAR * row[k]
                    two[k] += w * FAR * row[k]


@adaptive_kernel(MANY)
def restrict(fine, coarse):  # type: ignore[no-untyped-def]
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
def prolong(coarse, free, fine):  # type: ignore[no-untyped-def]
    """Add P of a coarse vector to the free nodes of a fine one."""
    n, m = fine.shape
    for i in prange(2, n - 2):
        near, far = parents(i)
        line = NEAR * coarse[near] + FAR * coarse[far]
        for j in range(2, m - 2):
            if free[i, j]:
                home, other = parents(j)
                fine[i, j] += NEAR * line[home] + FAR * line[other]
