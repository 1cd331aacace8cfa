"""How a mesh bends, one triangle at a time: the oracle of `relieffab.layers.lines.curvature`.

N. Max, "Weights for computing vertex normals from facet normals", Journal of
Graphics Tools 4(2), 1999; S. Rusinkiewicz, "Estimating curvatures and their
derivatives on triangle meshes", 3DPVT 2004.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.curvature import FLATTEST, Curvature

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

UP = np.array([0.0, 0.0, 1.0])
DISTINCT = ((0, 0, 0), (0, 0, 1), (0, 1, 1), (1, 1, 1))
"""Where a symmetric cubic form keeps its four numbers."""


@dataclass(frozen=True, eq=False)
class Face:
    """A triangle and the frame it is measured in.

    Parameters
    ----------
    corners : (3,) ndarray of int
        Vertices.
    edges : (3, 3) ndarray
        Row i runs opposite corner i, mm.
    tangent, across, normal : (3,) ndarray
        Unit; the tangent runs along edge 0.
    area : float
        mm^2.
    """

    corners: Ints
    edges: Floats
    tangent: Floats
    across: Floats
    normal: Floats
    area: float

    @property
    def flat_edges(self) -> Floats:
        """(3, 2) edges in the face's plane, mm."""
        return self.edges @ np.stack([self.tangent, self.across]).T


def measure_faces(vertices: Floats, faces: Ints) -> list[Face]:
    """Lay a frame on each triangle that has an area; the others are left out."""
    found = []
    for corners in faces:
        a, b, c = vertices[corners]
        edges = np.array([c - b, a - c, b - a])
        normal = np.cross(edges[0], edges[1])
        twice_area = np.linalg.norm(normal)
        if twice_area <= FLATTEST * (edges**2).sum(axis=1).max():
            continue
        normal = normal / twice_area
        tangent = edges[0] / np.linalg.norm(edges[0])
        across = np.cross(normal, tangent)
        found.append(Face(corners, edges, tangent, across, normal, twice_area / 2))
    return found


def vertex_normals(triangles: Iterable[Face], count: int) -> Floats:
    """Sum (a x b)/(|a|^2 |b|^2) at each vertex over its corners' sides a and b (Max 1999).

    Returns
    -------
    (count, 3) ndarray
        Unit; up where the sum vanishes.
    """
    total, weight = np.zeros((count, 3)), np.zeros(count)
    for face in triangles:
        for i, vertex in enumerate(face.corners):
            a, b = face.edges[i - 2], face.edges[i - 1]
            share = 2 * face.area / ((a @ a) * (b @ b))
            total[vertex] += share * face.normal
            weight[vertex] += share
    for vertex in range(count):
        length = np.linalg.norm(total[vertex])
        vanishes = length <= 1e-12 * weight[vertex]
        total[vertex] = UP if vanishes else total[vertex] / length
    return total


def corner_areas(face: Face) -> Floats:
    """Area of the points of a triangle that are nearest to each corner (Rusinkiewicz 2004).

    Returns
    -------
    (3,) ndarray
        mm^2.  The bisector of a side parts it into right triangles, one leg half
        the side, up to the middle of the circle round it; where the widest angle
        is blunt, up to the edge across from it.
    """
    squared = (face.edges**2).sum(axis=1)
    cot = [-(face.edges[i - 2] @ face.edges[i - 1]) / (2 * face.area) for i in range(3)]
    if min(cot) >= 0:
        half_kite = [squared[i] * cot[i] / 8 for i in range(3)]
        return np.array([half_kite[i - 2] + half_kite[i - 1] for i in range(3)])
    areas = np.zeros(3)
    blunt = int(np.argmin(cot))
    for sharp, side in ((blunt - 2, blunt - 1), (blunt - 1, blunt - 2)):
        areas[sharp] = squared[side] / cot[sharp] / 8
    areas[blunt] = face.area - areas.sum()
    return areas


def any_tangent(normal: Floats) -> Floats:
    """Choose a unit vector at right angles to another."""
    axis = np.eye(3)[np.argmin(np.abs(normal))]
    tangent = np.cross(axis, normal)
    return tangent / np.linalg.norm(tangent)


def turn_into_face(normal: Floats, e1: Floats, face: Face) -> Floats:
    """Lay a vertex frame on a face by the smallest turn that takes normal to normal.

    That turn takes a vector x at right angles to n to x - (x.N)/(1 + n.N) (n + N).

    Parameters
    ----------
    normal, e1 : (3,) ndarray
        Of the vertex; e2 is their cross product.
    face : Face

    Returns
    -------
    (2, 2) ndarray
        Rows are e1 and e2 in the face's frame.
    """
    opening = max(1 + normal @ face.normal, 1e-6)
    laid = e1 - (e1 @ face.normal) / opening * (normal + face.normal)
    c, s = laid @ face.tangent, laid @ face.across
    length = hypot(c, s)
    if length < 1e-6:
        return np.eye(2)
    return np.array([[c, s], [-s, c]]) / length


def fit_curvature(face: Face, normals: Floats) -> Floats:
    """Second fundamental form of a face by least squares (Rusinkiewicz 2004, sec. 2).

    Parameters
    ----------
    face : Face
    normals : (3, 3) ndarray
        At its corners.

    Returns
    -------
    (2, 2) ndarray
        The form II with II edge = change of the normal along the edge, 1/mm.
    """
    rows, right = [], []
    for i, (u, w) in enumerate(face.flat_edges):
        change = normals[i - 1] - normals[i - 2]
        rows += [[u, w, 0], [0, u, w]]
        right += [change @ face.tangent, change @ face.across]
    e, f, g = np.linalg.lstsq(np.array(rows), np.array(right))[0]
    return np.array([[e, f], [f, g]])


def cubic_form(c: Sequence[float]) -> Floats:
    """Write the four numbers of a symmetric cubic form out as (2, 2, 2)."""
    return np.array([[[c[0], c[1]], [c[1], c[2]]], [[c[1], c[2]], [c[2], c[3]]]])


def fit_derivative(face: Face, forms: Sequence[Floats]) -> Floats:
    """Derivative of the form by least squares (Rusinkiewicz 2004, sec. 3).

    Parameters
    ----------
    face : Face
    forms : sequence of (2, 2) ndarray
        At its corners, in the face's frame.

    Returns
    -------
    (2, 2, 2) ndarray
        The tensor C with C edge = change of the form along the edge, 1/mm^2.
    """
    rows, right = [], []
    for i, (u, w) in enumerate(face.flat_edges):
        change = forms[i - 1] - forms[i - 2]
        rows += [[u, w, 0, 0], [0, u, w, 0], [0, u, w, 0], [0, 0, u, w]]
        right += list(change.ravel())
    return cubic_form(np.linalg.lstsq(np.array(rows), np.array(right))[0])


def diagonalise(form: Floats) -> tuple[Floats, Floats]:
    """Principal curvatures (2,), the larger in size first, and the first's direction (2,)."""
    values, vectors = np.linalg.eigh(form)
    first = int(np.argmax(np.abs(values)))
    return values[[first, 1 - first]], vectors[:, first]


def vertex_forms(
    triangles: Sequence[Face], shares: Sequence[Floats], normals: Floats, e1: Floats
) -> Floats:
    """Mean second fundamental form at each vertex, in its frame (Rusinkiewicz 2004, sec. 2).

    Parameters
    ----------
    triangles : sequence of Face
    shares : sequence of (3,) ndarray
        What each triangle weighs at its corners; 1 in all at a vertex.
    normals, e1 : (v, 3) ndarray
        Frames of the vertices.

    Returns
    -------
    (v, 2, 2) ndarray
        1/mm.
    """
    forms = np.zeros((len(normals), 2, 2))
    for face, share in zip(triangles, shares, strict=True):
        form = fit_curvature(face, normals[face.corners])
        for vertex, weight in zip(face.corners, share, strict=True):
            turn = turn_into_face(normals[vertex], e1[vertex], face)
            forms[vertex] += weight * (turn @ form @ turn.T)
    return forms


def vertex_cubics(
    triangles: Sequence[Face],
    shares: Sequence[Floats],
    normals: Floats,
    e1: Floats,
    principal: Floats,
) -> Floats:
    """Mean derivative of the form at each vertex, in its frame (Rusinkiewicz 2004, sec. 3).

    Parameters
    ----------
    triangles, shares, normals
        As in `vertex_forms`.
    e1 : (v, 3) ndarray
        Principal directions.
    principal : (v, 2) ndarray
        Principal curvatures, 1/mm.

    Returns
    -------
    (v, 2, 2, 2) ndarray
        1/mm^2.
    """
    cubics = np.zeros((len(normals), 2, 2, 2))
    for face, share in zip(triangles, shares, strict=True):
        turns = [turn_into_face(normals[vertex], e1[vertex], face) for vertex in face.corners]
        pairs = zip(turns, face.corners, strict=True)
        forms = [turn.T @ np.diag(principal[vertex]) @ turn for turn, vertex in pairs]
        cubic = fit_derivative(face, forms)
        for vertex, weight, turn in zip(face.corners, share, turns, strict=True):
            cubics[vertex] += weight * np.einsum("ia,jb,kc,abc->ijk", turn, turn, turn, cubic)
    return cubics


def curvature(vertices: Floats, faces: Ints) -> Curvature:
    """Measure normals, principal curvatures and their derivative (Rusinkiewicz 2004).

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
        Outward-oriented.

    Returns
    -------
    Curvature
    """
    count = len(vertices)
    triangles = measure_faces(vertices, faces)
    normals = vertex_normals(triangles, count)
    parts = [corner_areas(face) for face in triangles]
    areas = np.zeros(count)
    for face, part in zip(triangles, parts, strict=True):
        areas[face.corners] += part
    shares = [part / areas[face.corners] for face, part in zip(triangles, parts, strict=True)]

    e1 = np.array([any_tangent(normal) for normal in normals])
    principal = np.zeros((count, 2))
    for vertex, form in enumerate(vertex_forms(triangles, shares, normals, e1)):
        principal[vertex], (c, s) = diagonalise(form)
        e1[vertex] = c * e1[vertex] + s * np.cross(normals[vertex], e1[vertex])

    cubics = vertex_cubics(triangles, shares, normals, e1, principal)
    derivative = np.stack([cubics[:, i, j, k] for i, j, k in DISTINCT])
    directions = np.stack([e1, np.cross(normals, e1)])
    return Curvature(normals, directions, principal.T, derivative, areas)
