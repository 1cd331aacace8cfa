"""Lines on a mesh, one triangle and one point at a time: the oracle of `relieffab.layers.lines`.

The eye is infinitely far above, nothing is faired, and strokes are not tidied up.

D. DeCarlo et al., "Suggestive contours for conveying shape", SIGGRAPH 2003;
S. Rusinkiewicz, "Estimating curvatures and their derivatives on triangle meshes",
3DPVT 2004.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable
from math import floor, inf, sqrt

import numpy as np
from numpy.typing import NDArray
from plain_curvature import cubic_form

from relieffab.grid import Grid
from relieffab.layers.lines import contours as line_rules
from relieffab.layers.lines import visibility as depth_rules
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.curvature import Curvature

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]
Edge = tuple[int, int]

VIEW = np.array([0.0, 0.0, 1.0])


def radial(bend: Curvature, vertex: int) -> tuple[float, float]:
    """Radial curvature and its change towards the eye at a vertex (DeCarlo 2003, sec. 3).

    Returns
    -------
    curvature : float
        II(p, p) with p the view's part along the surface, 1/mm.
    derivative : float
        C(p, p, p)/|p|^2 - 2 (n.v) t^2 with the torsion t = II(p, n x p)/|p|^2, 1/mm^2.
    """
    p = bend.directions[:, vertex] @ VIEW
    form = np.diag(bend.principal[:, vertex])
    sine2 = max(p @ p, 1e-12)
    torsion = np.array([-p[1], p[0]]) @ form @ p / sine2
    along = cubic_form(bend.derivative[:, vertex]) @ p @ p @ p / sine2
    return p @ form @ p, along - 2 * (bend.normals[vertex] @ VIEW) * torsion**2


def zero_segments(faces: Ints, field: Floats) -> list[tuple[Edge, Edge]]:
    """Cross each face where a field changes sign: from edge to edge; 0 is positive."""
    segments = []
    for a, b, c in faces.tolist():
        sides = ((a, b), (b, c), (c, a))
        crossed = [side for side in sides if (field[side[0]] >= 0) != (field[side[1]] >= 0)]
        if crossed:
            one, two = (tuple(sorted(side)) for side in crossed)
            segments.append((one, two))
    return segments


def join(segments: Iterable[tuple[Edge, Edge]]) -> list[list[Edge]]:
    """Join segments that share an edge of the mesh into chains.

    Returns
    -------
    list of list of edge
        A chain ends where other than two segments meet; a closed one repeats its
        first edge.
    """
    beside: dict[Edge, set[Edge]] = defaultdict(set)
    for one, two in segments:
        beside[one].add(two)
        beside[two].add(one)
    degree = {edge: len(others) for edge, others in beside.items()}
    chains = []
    for first in sorted(beside, key=lambda edge: degree[edge] == 2):
        while beside[first]:
            chain = [first]
            while len(chain) == 1 or (degree[chain[-1]] == 2 and beside[chain[-1]]):
                following = beside[chain[-1]].pop()
                beside[following].remove(chain[-1])
                chain.append(following)
            chains.append(chain)
    return chains


def zero_set(
    vertices: Floats,
    faces: Ints,
    bend: Curvature,
    field: Floats,
    strength: Callable[[Callable[[Floats], float]], float],
) -> Chains:
    """Join the lines along which a field that is linear on every edge vanishes.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    bend : Curvature
    field : (v,) ndarray
    strength : callable
        Strength at a crossing, given what reads vertex values (v,) there.
    """
    size = np.sqrt(bend.areas)
    points, normals, slack, strengths, begin = [], [], [], [], [0]
    for chain in join(zero_segments(faces, field)):
        for a, b in chain:
            share = field[a] / (field[a] - field[b])

            def read(values: Floats, a: int = a, b: int = b, share: float = share) -> Floats:
                return values[a] + share * (values[b] - values[a])

            normal = read(bend.normals)
            points.append(read(vertices))
            normals.append(normal / np.linalg.norm(normal))
            slack.append(read(size))
            strengths.append(strength(read))
        begin.append(len(points))
    return Chains(
        points=np.array(points).reshape(-1, 3),
        strength=np.array(strengths),
        normals=np.array(normals).reshape(-1, 3),
        slack=np.array(slack),
        begin=np.array(begin),
    )


def contours(vertices: Floats, faces: Ints, bend: Curvature, radius: float) -> Chains:
    """Find where n.v = 0, full strength where the radial curvature is positive (DeCarlo 2003).

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    bend : Curvature
    radius : float
        Of the whole, mm.
    """
    facing = np.array([normal @ VIEW for normal in bend.normals])
    bending = np.array([radial(bend, vertex)[0] for vertex in range(len(vertices))])
    least = line_rules.FLATTEST / radius

    def strength(read: Callable[[Floats], float]) -> float:
        return 1.0 if read(bending) > least else 0.0

    return zero_set(vertices, faces, bend, facing, strength)


def suggestive_contours(vertices: Floats, faces: Ints, bend: Curvature, size: float) -> Chains:
    """Find where the radial curvature vanishes and grows towards the eye (DeCarlo 2003).

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    bend : Curvature
    size : float
        Feature size, mm: strength is x/(3 least + x), x the change times size^2 over n.v.
    """
    facing = np.array([normal @ VIEW for normal in bend.normals])
    bending, change = np.array([radial(bend, vertex) for vertex in range(len(vertices))]).T

    def strength(read: Callable[[Floats], float]) -> float:
        towards = read(facing)
        if towards <= 0:
            return 0.0
        x = max(read(change) * size**2 / towards, 0.0)
        return x / (3 * line_rules.LEAST + x)

    return zero_set(vertices, faces, bend, bending, strength)


def visible(chains: Chains, depth: Floats, grid: Grid) -> NDArray[np.bool_]:
    """Tell which points lie no deeper than the farthest of the 3 x 3 pixels about them.

    Parameters
    ----------
    chains : Chains
    depth : (rows, cols) ndarray
        The z-buffer, mm, larger is nearer, -inf where nothing is seen.
    grid : Grid

    Returns
    -------
    (n,) ndarray of bool
        A point may be deeper by a pixel on the local slope and half a pixel, and by
        one and a half local triangles seen from the side.
    """

    def at(row: int, col: int) -> float:
        return depth[row, col] if 0 <= row < grid.rows and 0 <= col < grid.cols else -inf

    seen = []
    for (x, y, z), (nx, ny, nz), slack in zip(
        chains.points, chains.normals, chains.slack, strict=True
    ):
        row, col = (floor(index) for index in grid.to_index(x, y))
        window = (at(row + down, col + across) for down in (-1, 0, 1) for across in (-1, 0, 1))
        sine = sqrt(nx**2 + ny**2)
        slope = min(sine / max(abs(nz), 1e-9), depth_rules.STEEPEST)
        seen.append(min(window) <= z + grid.pitch * (0.5 + slope) + 1.5 * slack * sine)
    return np.array(seen, bool)
