"""Edges of a mesh: which faces meet at each, and parting a mesh along some."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

Ints = NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Edges:
    """The edges of a mesh, each once.

    Parameters
    ----------
    ends : (e, 2) ndarray of int
        Vertices, the lower first.
    of_face : (f, 3) ndarray of int
        The edge opposite each corner.
    faces : (e, 2) ndarray of int
        Two of the faces at the edge; the second is -1 on a boundary.
    same_way : (e,) ndarray of bool
        Whether both faces run along it in one direction: oddly wound.
    crowded : (e,) ndarray of bool
        Whether it has more faces than two.
    """

    ends: Ints
    of_face: Ints
    faces: Ints
    same_way: NDArray[np.bool_]
    crowded: NDArray[np.bool_]


def find_edges(faces: Ints, count: int) -> Edges:
    """List the edges of `faces` (f, 3) over `count` vertices."""
    tail, head = faces[:, [1, 2, 0]].ravel(), faces[:, [2, 0, 1]].ravel()
    forward = tail < head
    key = np.where(forward, tail, head).astype(np.int64) * count + np.where(forward, head, tail)
    order = np.argsort(key, kind="stable")
    ranked = key[order]
    new = np.ones(len(key), bool)
    new[1:] = ranked[1:] != ranked[:-1]
    first = np.flatnonzero(new)
    of_face = np.empty(len(key), np.int64)
    of_face[order] = np.cumsum(new) - 1
    uses = np.diff(np.append(first, len(key)))
    many = uses > 1
    second = order[np.minimum(first + 1, len(key) - 1)] if len(key) else first
    pair = np.stack([order[first] // 3, np.where(many, second // 3, -1)], axis=1)
    ends = np.stack([ranked[first] // count, ranked[first] % count], axis=1)
    same_way = many & (forward[order[first]] == forward[second])
    return Edges(ends, of_face.reshape(-1, 3), pair, same_way, uses > 2)


def split_at(creased: NDArray[np.bool_], edges: Edges, faces: Ints) -> tuple[Ints, Ints]:
    """Part a mesh along edges, so that each side has vertices of its own.

    Parameters
    ----------
    creased : (e,) ndarray of bool
    edges : Edges
        Of `faces`.
    faces : (f, 3) ndarray of int

    Returns
    -------
    faces : (f, 3) ndarray of int
    parent : (w,) ndarray of int
        The vertex each new one came from.
    """
    flat = faces.ravel()
    count = int(flat.max(initial=-1)) + 1
    touched = np.zeros(count, bool)
    touched[edges.ends[creased]] = True
    joined = np.flatnonzero(~creased & (edges.faces[:, 1] >= 0))
    joined = joined[touched[edges.ends[joined]].any(axis=1)]
    links = []
    for end in range(2):
        vertex = edges.ends[joined, end]
        corner = [
            3 * face + (faces[face] == vertex[:, None]).argmax(axis=1)
            for face in edges.faces[joined].T
        ]
        links.append(np.stack(corner, axis=1)[touched[vertex]])
    a, b = np.concatenate(links).T
    own = np.flatnonzero(touched[flat])
    place = np.zeros(len(flat), np.int64)
    place[own] = np.arange(len(own))
    graph = sparse.coo_matrix((np.ones(len(a)), (place[a], place[b])), (len(own), len(own)))
    parts, label = connected_components(graph, directed=False)
    parent = np.concatenate([np.arange(count), np.zeros(parts, np.int64)])
    parent[count + label] = flat[own]
    out = flat.copy()
    out[own] = count + label
    return out.reshape(-1, 3), parent
