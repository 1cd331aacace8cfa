"""Osculating cubics: bending that stays true where triangles are of unlike shapes.

F. Cazals and M. Pouget, "Estimating differential quantities using polynomial
fitting of osculating jets", CAGD 2005.  Averages of face values (see `curvature`)
are exact on regular meshes only: where neighbours lie unevenly, normals err by the
size of a triangle, curvature does not converge and its derivative diverges.  A
cubic through two rings of neighbours errs by h^3, h^2 and h.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.layers.lines.curvature import Curvature, cubic_in, diagonalise, tensor_in
from relieffab.layers.lines.edges import Edges

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

TERMS = 10
"""Of a cubic in two variables."""
FEWEST = 14
"""Vertices, its own too, that a fit needs: two rings as a rule, up to four at a rim."""
MOST = 64
"""Vertices that a fit looks at."""
SOUND = 1e-4
"""Least share of a term that the others do not explain: narrow strips tell no cubic."""
ROUGHEST = 0.03
"""Largest RMS of what a fit may miss, as a share of its radius: coarser forms are no cubics."""
ASIDE = 0.3
"""Least cosine between normals of vertices on one sheet of the surface."""


@kernel
def _gather(v, normals, start, ring, near):  # type: ignore[no-untyped-def]
    """List a vertex and its neighbours ring by ring; return how many.

    Two rings as a rule, up to four where a rim leaves too few.
    """
    near[0], count, first, rings = v, 1, 0, 0
    n = normals[v]
    while first < count and (rings < 2 or (rings < 4 and count < FEWEST)):
        last = count
        rings += 1
        for k in range(first, last):
            for at in range(start[near[k]], start[near[k] + 1]):
                other = ring[at]
                m = normals[other]
                known = m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < ASIDE
                for i in range(count):
                    known = known or near[i] == other
                if not known and count < MOST:
                    near[count] = other
                    count += 1
        first = last
    return count


@kernel
def _rows(points, near, count, frame, rows, heights):  # type: ignore[no-untyped-def]
    """Write each neighbour's ten monomials and height, in units of the farthest; return that."""
    reach = 0.0
    for k in range(count):
        d = points[near[k]] - points[near[0]]
        for axis in range(2):
            rows[k, 1 + axis] = (
                d[0] * frame[axis, 0] + d[1] * frame[axis, 1] + d[2] * frame[axis, 2]
            )
        heights[k] = d[0] * frame[2, 0] + d[1] * frame[2, 1] + d[2] * frame[2, 2]
        reach = max(reach, np.hypot(rows[k, 1], rows[k, 2]))
    if reach == 0.0:
        return reach
    for k in range(count):
        x, y = rows[k, 1] / reach, rows[k, 2] / reach
        heights[k] /= reach
        rows[k, 0], rows[k, 1], rows[k, 2] = 1.0, x, y
        rows[k, 3], rows[k, 4], rows[k, 5] = x * x / 2, x * y, y * y / 2
        rows[k, 6], rows[k, 7] = x * x * x / 6, x * x * y / 2
        rows[k, 8], rows[k, 9] = x * y * y / 2, y * y * y / 6
    return reach


@kernel
def _solve(a, b):  # type: ignore[no-untyped-def]
    """Solve a x = b in place by Cholesky, a's lower half given; tell whether it is sound."""
    for i in range(TERMS):
        least = SOUND * a[i, i]
        for j in range(i + 1):
            total = a[i, j]
            for k in range(j):
                total -= a[i, k] * a[j, k]
            if i > j:
                a[i, j] = total / a[j, j]
            elif total > least:
                a[i, i] = np.sqrt(total)
            else:
                return False
    for i in range(TERMS):
        for k in range(i):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]
    for i in range(TERMS - 1, -1, -1):
        for k in range(i + 1, TERMS):
            b[i] -= a[k, i] * b[k]
        b[i] /= a[i, i]
    return True


@kernel
def _cubic(rows, heights, count, jet):  # type: ignore[no-untyped-def]
    """Fit a cubic by its normal equations; tell whether it goes through the heights."""
    a = np.zeros((TERMS, TERMS))
    jet[:] = 0.0
    for k in range(count):
        for i in range(TERMS):
            jet[i] += rows[k, i] * heights[k]
            for j in range(i + 1):
                a[i, j] += rows[k, i] * rows[k, j]
    if not _solve(a, jet):
        return False
    missed = 0.0
    for k in range(count):
        off = heights[k]
        for i in range(TERMS):
            off -= rows[k, i] * jet[i]
        missed += off * off
    return missed <= ROUGHEST * ROUGHEST * count


@parallel_kernel
def _fit(points, normals, tangents, start, ring, jets, fitted):  # type: ignore[no-untyped-def]
    """Fit heights over each vertex's tangent plane; write the cubic's ten coefficients.

    Coefficients are the derivatives at the vertex: h, hx, hy, hxx, hxy, hyy, hxxx,
    hxxy, hxyy, hyyy.
    """
    for v in prange(len(points)):
        near, rows, heights = np.empty(MOST, np.int64), np.empty((MOST, TERMS)), np.empty(MOST)
        count = _gather(v, normals, start, ring, near)
        if count < FEWEST:
            continue
        n, e = normals[v], tangents[v]
        frame = np.empty((3, 3))
        frame[0], frame[2] = e, n
        frame[1, 0] = n[1] * e[2] - n[2] * e[1]
        frame[1, 1] = n[2] * e[0] - n[0] * e[2]
        frame[1, 2] = n[0] * e[1] - n[1] * e[0]
        reach = _rows(points, near, count, frame, rows, heights)
        if reach > 0.0 and _cubic(rows, heights, count, jets[v]):
            fitted[v] = True
            jets[v, 0] *= reach
            jets[v, 3:6] /= reach
            jets[v, 6:] /= reach * reach
        else:
            jets[v] = 0.0


def _rings(edges: Edges, count: int) -> tuple[Ints, Ints]:
    """Neighbours of each vertex: where they start in a list, and the list."""
    a, b = edges.ends.T
    source, target = np.concatenate([a, b]), np.concatenate([b, a])
    order = np.argsort(source, kind="stable")
    start = np.concatenate([[0], np.cumsum(np.bincount(source, minlength=count))])
    return start, target[order]


def osculate(vertices: Floats, edges: Edges, rough: Curvature) -> Curvature:
    """Measure again how a mesh bends, by cubics, wherever neighbours suffice.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    edges : Edges
    rough : Curvature
        Of the same mesh; stays where a cubic cannot be fitted: at vertices with too
        few neighbours on their side of the surface, or all on a line.
    """
    count = len(vertices)
    jets, fitted = np.zeros((count, TERMS)), np.zeros(count, bool)
    start, ring = _rings(edges, count)
    e1, e2 = rough.directions
    _fit(np.ascontiguousarray(vertices), rough.normals, e1, start, ring, jets, fitted)
    _, p, q, xx, xy, yy, xxx, xxy, xyy, yyy = jets.T
    w = np.sqrt(1 + p * p + q * q)
    normals = (rough.normals - p[:, None] * e1 - q[:, None] * e2) / w[:, None]
    # Convex is positive: heights over an outward normal fall.  The covariant
    # derivative of hij/w is hijk/w less (hij hkl + hjk hil + hki hjl) gl / w^3.
    tensor = -np.stack([xx, xy, yy]) / w
    px, py = (p * xx + q * xy) / w**2, (p * xy + q * yy) / w**2
    cubic = -np.stack(
        [
            xxx - 3 * xx * px,
            xxy - xx * py - 2 * xy * px,
            xyy - yy * px - 2 * xy * py,
            yyy - 3 * yy * py,
        ]
    )
    tangent = e1 - np.einsum("vk,vk->v", e1, normals)[:, None] * normals
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    across = np.cross(normals, tangent)
    # The heights' own basis, (1, 0, p) and (0, 1, q), is not orthonormal.
    a, b, c, d = (np.einsum("vk,vk->v", i, j) for i in (tangent, across) for j in (e1, e2))
    principal, cos, sin = diagonalise(tensor_in(tensor, (a, b, c, d)))
    basis = cos * a + sin * c, cos * b + sin * d, cos * c - sin * a, cos * d - sin * b
    along = cos[:, None] * tangent + sin[:, None] * across
    directions = np.stack([along, np.cross(normals, along)])
    return replace(
        rough,
        normals=np.where(fitted[:, None], normals, rough.normals),
        directions=np.where(fitted[:, None], directions, rough.directions),
        principal=np.where(fitted, principal, rough.principal),
        derivative=np.where(fitted, cubic_in(cubic / w, basis), rough.derivative),
    )
