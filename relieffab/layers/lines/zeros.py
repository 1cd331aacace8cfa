"""Zero sets: where a field on a mesh vanishes, as lines that cross its faces."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.chains import Chains, join
from relieffab.layers.lines.surface import Surface

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]


def zero_set(
    surface: Surface,
    field: Floats,
    carried: Floats,
    strength: Callable[[Floats], Floats],
    *,
    along: Floats | None = None,
) -> Chains:
    """Join the lines along which a field on the vertices vanishes.

    The field is linear along each edge; 0 counts as positive, so that every
    crossing lies on one edge and every line passes from face to face.

    Parameters
    ----------
    surface : Surface
    field : (v,) ndarray
    carried : (k, v) ndarray
        What the strength depends on; interpolated to the crossings first.
    strength : callable
        From (k, n) values to (n,) strengths.
    along : (v, 3) ndarray, optional
        Directions of no given sense in which the field was taken: the field
        changes sign with its direction.  A line ends where the directions around
        a face cannot be made to agree.

    Returns
    -------
    Chains
        As seen.
    """
    a, b = surface.edges.ends.T
    from_a, from_b = field[a], field[b]
    if along is not None:
        from_b = np.where(np.einsum("ek,ek->e", along[a], along[b]) < 0, -from_b, from_b)
    crossed = (from_a >= 0) != (from_b >= 0)
    of_face = surface.edges.of_face
    here = crossed[of_face]
    through = here.sum(axis=1) == 2
    at, here = of_face[through], here[through]
    apart = (~here).argmax(axis=1)
    row = np.arange(len(at))
    order, begin = join(np.stack([at[row, apart - 2], at[row, apart - 1]], axis=1))
    share = from_a[order] / (from_a[order] - from_b[order])
    return _chains(surface, a[order], b[order], share, begin, carried, strength)


def _chains(
    surface: Surface,
    a: Ints,
    b: Ints,
    share: Floats,
    begin: Ints,
    carried: Floats,
    strength: Callable[[Floats], Floats],
) -> Chains:
    """Read what lies at a share of the way from vertex a to vertex b, and look at it."""
    slack = np.sqrt(surface.bend.areas)
    table = np.column_stack([surface.vertices, surface.bend.normals, slack, carried.T])
    here = table[a] + share[:, None] * (table[b] - table[a])
    points, normals = here[:, :3], here[:, 3:6]
    return Chains(
        points=surface.eye.project(points),
        strength=strength(here[:, 7:].T),
        normals=surface.eye.bend_normals(points, normals),
        slack=here[:, 6] / (1 - surface.eye.nearness * points[:, 2]),
        begin=begin,
    )


def edge_lines(points: Floats, ends: Ints, steepness: Floats) -> Chains:
    """Join edges given by their vertices into lines of full strength.

    Parameters
    ----------
    points : (v, 3) ndarray
        As seen, mm.
    ends : (e, 2) ndarray of int
    steepness : (e,) ndarray
        Sine of the angle between viewer and normal on the gentler side of each edge:
        how fast the depth rises beside it.
    """
    order, begin = join(ends)
    most = np.zeros(len(points))
    np.maximum.at(most, ends.ravel(), np.repeat(steepness, 2))
    sine = most[order]
    aslant = np.stack([sine, np.zeros_like(sine), np.sqrt(1 - sine**2)], axis=1)
    return Chains(points[order], np.ones(len(order)), aslant, np.zeros(len(order)), begin)
