"""Lines on a mesh as polylines: who neighbours whom, and walking along it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
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
    """

    ends: Ints
    of_face: Ints
    faces: Ints
    same_way: NDArray[np.bool_]


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
    many = np.diff(np.append(first, len(key))) > 1
    second = order[np.minimum(first + 1, len(key) - 1)] if len(key) else first
    pair = np.stack([order[first] // 3, np.where(many, second // 3, -1)], axis=1)
    ends = np.stack([ranked[first] // count, ranked[first] % count], axis=1)
    same_way = many & (forward[order[first]] == forward[second])
    return Edges(ends, of_face.reshape(-1, 3), pair, same_way)


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


@kernel
def _walk(start, link, segment, degree, used, order, begin):  # type: ignore[no-untyped-def]
    """Follow segments from node to node; write nodes to `order`, chain starts to `begin`.

    Chains begin and end at nodes that do not have exactly two segments; what
    then remains is closed.
    """
    n, chains = 0, 0
    for loops in range(2):
        for first in range(len(degree)):
            if loops == 0 and degree[first] == 2:
                continue
            for i in range(start[first], start[first + 1]):
                if used[segment[i]]:
                    continue
                begin[chains] = n
                chains += 1
                order[n] = first
                n += 1
                at = i
                while at >= 0:
                    used[segment[at]] = True
                    node = link[at]
                    order[n] = node
                    n += 1
                    at = -1
                    if degree[node] == 2:
                        for j in range(start[node], start[node + 1]):
                            if not used[segment[j]]:
                                at = j
    return n, chains


def join(segments: Ints) -> tuple[Ints, Ints]:
    """Join segments that share a node into chains.

    Parameters
    ----------
    segments : (s, 2) ndarray of int
        Node numbers; a segment given twice counts once.

    Returns
    -------
    order : (n,) ndarray of int
        Nodes, chain after chain; a closed chain ends with its first node.
    begin : (c + 1,) ndarray of int
        Where each chain starts in `order`, and its length at the end.
    """
    segments = segments[segments[:, 0] != segments[:, 1]]
    nodes, local = np.unique(segments.ravel(), return_inverse=True)
    pairs = np.unique(np.sort(local.reshape(-1, 2), axis=1), axis=0)
    source = pairs.T.ravel()
    by_node = np.argsort(source, kind="stable")
    degree = np.bincount(source, minlength=len(nodes))
    start = np.concatenate([[0], np.cumsum(degree)])
    target = pairs[:, ::-1].T.ravel()[by_node]
    segment = by_node % max(len(pairs), 1)
    order = np.empty(2 * len(pairs), np.int64)
    begin = np.empty(len(pairs), np.int64)
    used = np.zeros(len(pairs), bool)
    n, chains = _walk(start, target, segment, degree, used, order, begin)
    return nodes[order[:n]], np.append(begin[:chains], n)


@dataclass(frozen=True, eq=False)
class Chains:
    """Polylines of one kind, one after the other; a closed one repeats its first point.

    Parameters
    ----------
    kind : str
        As in `Stroke`.
    points : (n, 3) ndarray
        On the panel, mm.
    strength : (n,) ndarray
        0 to 1.
    normals : (n, 3) ndarray
        Of the surface.
    slack : (n,) ndarray
        Size of the triangles there, mm.
    begin : (c + 1,) ndarray of int
        Where each polyline starts, and their total length at the end.
    """

    kind: str
    points: Floats
    strength: Floats
    normals: Floats
    slack: Floats
    begin: Ints


def resample(chains: Chains, step: float) -> Chains:
    """Place points along each polyline at even distances of at most `step` mm, as seen."""
    if len(chains.points) == 0:
        return chains
    table = np.column_stack([chains.points, chains.strength, chains.normals, chains.slack])
    gap = np.hypot(*np.diff(chains.points[:, :2], axis=0).T)
    gap[chains.begin[1:-1] - 1] = 1.0  # between polylines: any length, none is sampled there
    arc = np.concatenate([[0.0], np.cumsum(gap)])
    start, stop = arc[chains.begin[:-1]], arc[chains.begin[1:] - 1]
    pieces = np.maximum(np.ceil((stop - start) / step), 1).astype(np.int64)
    begin = np.concatenate([[0], np.cumsum(pieces + 1)])
    share = (np.arange(begin[-1]) - np.repeat(begin[:-1], pieces + 1)) / np.repeat(
        pieces, pieces + 1
    )
    at = np.repeat(start, pieces + 1) + share * np.repeat(stop - start, pieces + 1)
    fine = np.stack([np.interp(at, arc, column) for column in table.T], axis=1)
    return Chains(chains.kind, fine[:, :3], fine[:, 3], fine[:, 4:7], fine[:, 7], begin)


def select(chains: Chains, wanted: NDArray[np.bool_]) -> Chains:
    """Keep the polylines flagged in `wanted` (c,)."""
    length = np.diff(chains.begin)
    rows = np.repeat(wanted, length)
    begin = np.concatenate([[0], np.cumsum(length[wanted])])
    return Chains(
        chains.kind,
        chains.points[rows],
        chains.strength[rows],
        chains.normals[rows],
        chains.slack[rows],
        begin,
    )
