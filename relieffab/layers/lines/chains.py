"""Lines on a mesh as polylines: joined from segments, sampled, chosen."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]


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
    """Polylines one after the other, as seen; a closed one repeats its first point.

    Parameters
    ----------
    points : (n, 3) ndarray
        On the panel, mm.
    strength : (n,) ndarray
        0 to 1.
    normals : (n, 3) ndarray
        Of the surface as seen.
    slack : (n,) ndarray
        Size of the triangles there, mm.
    begin : (c + 1,) ndarray of int
        Where each polyline starts, and their total length at the end.
    """

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
    # To the bit, so that what closes stays closed.
    fine[begin[:-1]] = table[chains.begin[:-1]]
    fine[begin[1:] - 1] = table[chains.begin[1:] - 1]
    return Chains(fine[:, :3], fine[:, 3], fine[:, 4:7], fine[:, 7], begin)
