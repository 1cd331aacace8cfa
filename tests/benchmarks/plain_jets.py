"""Osculating cubics, one vertex at a time: the oracle of `relieffab.layers.lines.jets`.

F. Cazals and M. Pouget, "Estimating differential quantities using polynomial
fitting of osculating jets", CAGD 2005.
"""

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from plain_curvature import DISTINCT, diagonalise

from relieffab.layers.lines.curvature import Curvature
from relieffab.layers.lines.jets import ASIDE, FEWEST, MOST, ROUGHEST

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]


def find_neighbours(faces: Ints, count: int) -> list[list[int]]:
    """List the neighbours of every vertex, from the next higher number on and round."""
    beside: list[set[int]] = [set() for _ in range(count)]
    for a, b, c in faces.tolist():
        beside[a] |= {b, c}
        beside[b] |= {c, a}
        beside[c] |= {a, b}
    return [sorted(others, key=lambda o, v=v: (o < v, o)) for v, others in enumerate(beside)]


def gather(vertex: int, neighbours: Sequence[Sequence[int]], normals: Floats) -> list[int]:
    """List a vertex and two rings of neighbours on its sheet, up to four while they are few."""
    near, start = [vertex], 0
    for ring in range(4):
        if ring >= 2 and len(near) >= FEWEST:
            break
        front, start = near[start:], len(near)
        for other in (o for v in front for o in neighbours[v]):
            if other not in near and normals[other] @ normals[vertex] >= ASIDE:
                near.append(other)
    return near[:MOST]


def fit_cubic(x: Floats, y: Floats, heights: Floats) -> Floats | None:
    """Fit z = h(x, y) by least squares (Cazals and Pouget 2005, sec. 3).

    Parameters
    ----------
    x, y, heights : (n,) ndarray
        In units of the farthest point.

    Returns
    -------
    (10,) ndarray or None
        h, hx, hy, hxx, hxy, hyy, hxxx, hxxy, hxyy, hyyy at the origin; None where
        the points leave one of them open, or lie off the cubic.
    """
    ones = np.ones_like(x)
    quadratic = [x * x / 2, x * y, y * y / 2]
    cubic = [x**3 / 6, x * x * y / 2, x * y * y / 2, y**3 / 6]
    rows = np.stack([ones, x, y, *quadratic, *cubic], axis=1)
    if len(x) < rows.shape[1]:
        return None
    apart = np.diag(np.linalg.qr(rows, mode="r")) ** 2
    if (apart <= 1e-9 * (rows**2).sum(axis=0)).any():
        return None
    jet = np.linalg.lstsq(rows, heights)[0]
    missed = ((heights - rows @ jet) ** 2).mean()
    return jet if missed <= ROUGHEST**2 else None


def bend_of_jet(jet: Floats) -> tuple[Floats, Floats, Floats]:
    """Read how a graph z = h(x, y) bends at the origin; convex is positive.

    The tangents (1, 0, hx) and (0, 1, hy) are taken for an orthonormal frame, as the
    fast one takes them: right as far as the gradient's square is small.

    Returns
    -------
    gradient : (2,) ndarray
    form : (2, 2) ndarray
        -hij/w, w = sqrt(1 + |grad h|^2).
    cubic : (2, 2, 2) ndarray
        Its covariant derivative -(hijk - hij sk - hjk si - hki sj)/w, s = H grad h/w^2.
    """
    gradient = jet[1:3]
    second = np.array([[jet[3], jet[4]], [jet[4], jet[5]]])
    third = np.empty((2, 2, 2))
    for i, j, k in np.ndindex(2, 2, 2):
        third[i, j, k] = jet[6 + i + j + k]
    w = sqrt(1 + gradient @ gradient)
    slope = second @ gradient / w**2
    carried = np.multiply.outer(second, slope)
    carried = carried + carried.transpose(2, 0, 1) + carried.transpose(1, 2, 0)
    return gradient, -second / w, -(third - carried) / w


def refit(frame: Floats, offsets: Floats) -> tuple[Floats, Floats, Floats] | None:
    """Measure how a surface bends at a vertex by the cubic through its neighbours.

    Parameters
    ----------
    frame : (3, 3) ndarray
        Rows are a tangent, the one across and a normal, none of them exact.
    offsets : (n, 3) ndarray
        Neighbours from the vertex, itself too, mm.

    Returns
    -------
    frame : (3, 3) ndarray
        Rows are e1, e2 and the normal.
    principal : (2,) ndarray
        1/mm.
    derivative : (4,) ndarray
        1/mm^2.
    """
    x, y, heights = frame @ offsets.T
    reach = np.sqrt(x**2 + y**2).max()
    jet = fit_cubic(x / reach, y / reach, heights / reach) if reach > 0 else None
    if jet is None:
        return None
    gradient, form, cubic = bend_of_jet(jet)
    normal = frame.T @ [*-gradient, 1.0] / sqrt(1 + gradient @ gradient)
    tangent = frame[0] - (frame[0] @ normal) * normal
    tangent /= np.linalg.norm(tangent)
    basis = np.stack([tangent, np.cross(normal, tangent)]) @ frame[:2].T
    form = basis @ form @ basis.T
    cubic = np.einsum("ia,jb,kc,abc->ijk", basis, basis, basis, cubic)
    principal, (c, s) = diagonalise(form / reach)
    turn = np.array([[c, s], [-s, c]])
    turned = np.einsum("ia,jb,kc,abc->ijk", turn, turn, turn, cubic / reach**2)
    e1 = c * tangent + s * np.cross(normal, tangent)
    frame = np.stack([e1, np.cross(normal, e1), normal])
    return frame, principal, np.array([turned[at] for at in DISTINCT])


def osculate(vertices: Floats, faces: Ints, rough: Curvature) -> Curvature:
    """Measure again how a mesh bends, by cubics, wherever neighbours suffice.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    rough : Curvature
        Of the same mesh: the frames to fit in, and what stays where there is no fit.
    """
    frames = np.stack([*rough.directions, rough.normals], axis=1)
    principal, derivative = rough.principal.copy(), rough.derivative.copy()
    neighbours = find_neighbours(faces, len(vertices))
    for vertex in range(len(vertices)):
        near = gather(vertex, neighbours, rough.normals)
        if len(near) < FEWEST:
            continue
        better = refit(frames[vertex], vertices[near] - vertices[vertex])
        if better is not None:
            frames[vertex], principal[:, vertex], derivative[:, vertex] = better
    e1, e2, normals = frames.transpose(1, 0, 2)
    return Curvature(normals, np.stack([e1, e2]), principal, derivative, rough.areas)
