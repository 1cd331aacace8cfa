"""Creases: sharp edges that a made thing has, and a scan has only by chance."""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from relieffab.layers.lines.edges import Edges
from relieffab.layers.shading import face_normals

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]


SHARP = 40.0
"""Faces that differ by more, in degrees, meet at a crease."""
HARD = 60.0
"""What a crease must reach somewhere, degrees."""


def turns(vertices: Floats, faces: Ints, edges: Edges) -> Floats:
    """Angle between the faces on both sides of each edge: (e,), degrees.

    0 where there is one face, 180 where there are more than two.
    """
    normal = face_normals(vertices, faces)
    length = np.linalg.norm(normal, axis=1)
    normal /= np.where(length > 0, length, 1.0)[:, None]
    sides = edges.faces
    cosine = np.einsum("ek,ek->e", normal[sides[:, 0]], normal[sides[:, 1]])
    cosine = np.where(edges.same_way, -cosine, cosine)
    solid = (sides[:, 1] >= 0) & (length[sides] > 0).all(axis=1)
    angle = np.where(solid, np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))), 0.0)
    return np.where(edges.crowded, 180.0, angle)


def find_creases(vertices: Floats, faces: Ints, edges: Edges, shortest: float) -> NDArray[np.bool_]:
    """Tell which edges are creases of a made thing.

    Such creases are hard, and meet each other or close; scans and coarse models
    have sharp edges here and there that end in the open.  What hangs together
    stays if it has `shortest` mm of hard edges, and measures as much six times
    over for each open end.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    edges : Edges
        Of the faces.
    shortest : float
        mm.

    Returns
    -------
    (e,) ndarray of bool
    """
    turn = turns(vertices, faces, edges)
    sharp = turn > SHARP
    a, b = edges.ends[sharp].T
    count = len(vertices)
    graph = sparse.coo_matrix((np.ones(len(a)), (a, b)), (count, count))
    _, label = connected_components(graph, directed=False)
    length = np.linalg.norm(vertices[a] - vertices[b], axis=1)
    total = np.bincount(label[a], length, count)
    hard = np.bincount(label[a], length * (turn[sharp] > HARD), count)
    loose = np.bincount(np.concatenate([a, b]), minlength=count) == 1
    ends = np.bincount(label[loose], minlength=count)
    lasting = (hard >= shortest) & (total >= 6 * ends * shortest)
    out = np.zeros_like(sharp)
    out[sharp] = lasting[label[a]]
    return out
