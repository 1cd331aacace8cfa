"""Which lines to draw: zero sets on a mesh, its creases and its open edges.

D. DeCarlo et al., "Suggestive contours for conveying shape", SIGGRAPH 2003;
S. Rusinkiewicz et al., "Line drawings from 3D models", SIGGRAPH course 2008.
Each definition below is a field on the vertices, whose zero set is the line, and
a strength there; one more definition is one more function like `suggestive`.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from relieffab.layers.chains import Chains, Edges, find_edges, join, split_at
from relieffab.layers.curvature import Curvature, curvature, feature_size
from relieffab.layers.smooth import smooth

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

FADE = 0.03
"""Derivative of the radial curvature, in n.v/fs^2, at which a line has half its strength."""


@dataclass(frozen=True, eq=False)
class Surface:
    """A mesh with all that its lines are found from.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        Where lines are drawn, on the panel, mm.
    faces : (f, 3) ndarray of int
    edges : Edges
        Of the faces.
    bend : Curvature
        Of the faired copy.
    size : float
        Feature size, mm.
    view : (v, 3) ndarray
        Unit vectors from the surface to the viewer.
    """

    vertices: Floats
    faces: Ints
    edges: Edges
    bend: Curvature
    size: float
    view: Floats

    @property
    def facing(self) -> Floats:
        """(v,) n.v, 1 where the surface faces the viewer."""
        return np.einsum("vk,vk->v", self.bend.normals, self.view)


def sharp_edges(vertices: Floats, faces: Ints, edges: Edges, angle: float) -> NDArray[np.bool_]:
    """Tell where the faces on both sides of an edge differ by more than `angle` degrees."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    normal /= np.where(length > 0, length, 1.0)[:, None]
    sides = edges.faces
    turn = np.einsum("ek,ek->e", normal[sides[:, 0]], normal[sides[:, 1]])
    turn = np.where(edges.same_way, -turn, turn)
    solid = (sides[:, 1] >= 0) & (length[sides] > 0).all(axis=1)
    return solid & (turn < np.cos(np.radians(angle)))


def lasting_creases(
    vertices: Floats, edges: Edges, sharp: NDArray[np.bool_], shortest: float
) -> NDArray[np.bool_]:
    """Keep the sharp edges that hang together as a part's creases do.

    Creases of a made part meet each other or close; scans and coarse models have
    sharp edges here and there that end in the open.  What hangs together stays
    if it measures `shortest` mm, and as much six times over for each open end.
    """
    chosen = np.flatnonzero(sharp)
    a, b = edges.ends[chosen].T
    count = len(vertices)
    graph = sparse.coo_matrix((np.ones(len(a)), (a, b)), (count, count))
    _, label = connected_components(graph, directed=False)
    total = np.bincount(label[a], np.linalg.norm(vertices[a] - vertices[b], axis=1), count)
    loose = np.bincount(np.concatenate([a, b]), minlength=count) == 1
    ends = np.bincount(label[loose], minlength=count)
    out = np.zeros_like(sharp)
    out[chosen] = (total >= shortest * np.maximum(6 * ends, 1))[label[a]]
    return out


def prepare(
    vertices: Floats,
    faces: Ints,
    sharp: NDArray[np.bool_],
    edges: Edges,
    *,
    detail: float = 0.0,
    view: Floats | None = None,
) -> Surface:
    """Part a mesh at its creases, fair a copy and measure how it bends.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        On the panel, mm.
    faces : (f, 3) ndarray of int
    sharp : (e,) ndarray of bool
        Creases: smooth on either side, so each side is measured alone.
    edges : Edges
        Of the faces.
    detail : float
        Wavelength that keeps half its height, mm; 0 takes nothing off.
    view : (v, 3) ndarray, optional
        Unit vectors from the surface to the viewer; along Z if not given.
    """
    view = np.broadcast_to([0.0, 0.0, 1.0], vertices.shape) if view is None else view
    if sharp.any():
        faces, parent = split_at(sharp, edges, faces)
        vertices, view = vertices[parent], view[parent]
        edges = find_edges(faces, len(vertices))
    faired = smooth(vertices, faces, detail=detail)
    bend = curvature(faired, faces)
    return Surface(vertices, faces, edges, bend, feature_size(bend, faired), view)


def zero_set(
    surface: Surface,
    field: Floats,
    carried: Floats,
    strength: Callable[[Floats], Floats],
    kind: str,
) -> Chains:
    """Join the lines along which a field on the vertices vanishes.

    The field is linear inside each face; 0 counts as positive, so that every
    crossing lies on one edge and every line passes from face to face.

    Parameters
    ----------
    surface : Surface
    field : (v,) ndarray
    carried : (k, v) ndarray
        What the strength depends on; interpolated to the crossings first.
    strength : callable
        From (k, n) values to (n,) strengths.
    kind : str
        As in `Stroke`.
    """
    positive = field >= 0
    of_corner = positive[surface.faces]
    crossed = np.flatnonzero(of_corner.any(axis=1) & ~of_corner.all(axis=1))
    of_corner = of_corner[crossed]
    alone = np.where(of_corner.sum(axis=1) == 1, of_corner.argmax(axis=1), of_corner.argmin(axis=1))
    at = surface.edges.of_face[crossed]
    row = np.arange(len(crossed))
    segments = np.stack([at[row, alone - 2], at[row, alone - 1]], axis=1)
    order, begin = join(segments)
    a, b = surface.edges.ends[order].T
    share = field[a] / np.where(positive[a] == positive[b], 1.0, field[a] - field[b])
    size = np.sqrt(surface.bend.areas)
    table = np.column_stack([surface.vertices, surface.bend.normals, size, carried.T])
    here = table[a] + share[:, None] * (table[b] - table[a])
    return Chains(kind, here[:, :3], strength(here[:, 7:].T), here[:, 3:6], here[:, 6], begin)


def _in_principal_frame(surface: Surface) -> tuple[Floats, Floats]:
    """Components u, w of the view along e1 and e2."""
    e1, e2 = surface.bend.directions
    u, w = (np.einsum("vk,vk->v", e, surface.view) for e in (e1, e2))
    return u, w


def radial_curvature(surface: Surface) -> Floats:
    """Curvature towards the viewer times sin^2 of the angle off the normal: (v,), 1/mm."""
    u, w = _in_principal_frame(surface)
    k1, k2 = surface.bend.principal
    return k1 * u * u + k2 * w * w


def radial_derivative(surface: Surface) -> Floats:
    """Change of the radial curvature towards the viewer, times n.v: (v,), 1/mm^2."""
    u, w = _in_principal_frame(surface)
    k1, k2 = surface.bend.principal
    c0, c1, c2, c3 = surface.bend.derivative
    sine2 = np.maximum(u * u + w * w, 1e-12)
    along = (u * u * (u * c0 + 3 * w * c1) + w * w * (3 * u * c2 + w * c3)) / sine2
    torsion = (k2 - k1) * u * w / sine2
    return along - 2 * surface.facing * torsion**2


def contours(surface: Surface) -> Chains:
    """Where the surface turns away from the viewer: n.v = 0, strength 1 where kr > 0."""

    def strength(carried: Floats) -> Floats:
        return np.where(carried[0] > 0, 1.0, 0.0)

    kr = radial_curvature(surface)
    return zero_set(surface, surface.facing, kr[None], strength, "contour")


def suggestive(surface: Surface) -> Chains:
    """Where it almost does: kr = 0, growing towards the viewer.

    Strength is x/(FADE + x) with x the derivative in units of n.v/fs^2: 0.25 at
    the least derivative worth a line, 0.01 (Rusinkiewicz 2004).
    """

    def strength(carried: Floats) -> Floats:
        facing, change = np.maximum(carried, 0)
        return np.where(facing > 0, change / np.maximum(FADE * facing + change, 1e-300), 0.0)

    carried = np.stack([surface.facing, radial_derivative(surface) * surface.size**2])
    return zero_set(surface, radial_curvature(surface), carried, strength, "suggestive")


def edge_lines(vertices: Floats, ends: Ints, kind: str) -> Chains:
    """Join edges given by their vertices (e, 2) into lines of full strength."""
    order, begin = join(ends)
    count = len(order)
    flat = np.broadcast_to([0.0, 0.0, 1.0], (count, 3))
    return Chains(kind, vertices[order], np.ones(count), flat, np.zeros(count), begin)
