"""Flat solids bent round an axis: edges halved until their chords follow, and the error measured.

A straight edge of the flat panel becomes a spiral; what is drawn instead is its chord.
Where the edge goes round by du and rises by dh, the chord's middle is nearer to the axis
by du² / 8r, and off along the way round by du dh / 4r.  Within a triangle the error of
a quadratic is at most 4/3 of the largest on its edges.
"""

import numpy as np

from relieffab.bend import Bend
from relieffab.panel.deviate import deviations
from relieffab.panel.edges import edge_keys, plan_areas
from relieffab.panel.model import Floats, Ints
from relieffab.relief.model import Relief

# Pixels from the grid's border where a solid's height is not measured.
BORDER = 1e-6
INSIDE = 4 / 3 * 1.05  # of the largest error on a triangle's edges; and for higher orders


def sags(steps: Floats, radius: float) -> Floats:
    """Bound how far chords are from the edges they stand for, square to the surface, mm.

    Parameters
    ----------
    steps : (n, 3) ndarray
        Along X, Y and upwards on the flat panel, mm.
    radius : float
        The least at which they lie, mm.
    """
    along, _, rise = steps.T
    return (along**2 / 2 + np.abs(along * rise)) / (4 * radius)  # type: ignore[no-any-return]


def refine(vertices: Floats, faces: Ints, radius: float, sag: float) -> tuple[Floats, Ints]:
    """Halve every edge whose chord would be off by more than `sag`, until none is.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        On the flat panel, mm.
    faces : (f, 3) ndarray of int
        Watertight; so are those returned.
    radius : float
        The least at which they lie, mm.
    sag : float
        mm.
    """
    while True:
        there, back = edge_keys(faces), edge_keys(faces, reverse=True)
        _, first, edge = np.unique(np.minimum(there, back), return_index=True, return_inverse=True)
        start, end = faces.ravel()[first], np.roll(faces, -1, axis=1).ravel()[first]
        long = sags(vertices[end] - vertices[start], radius) > sag
        if not long.any():
            return vertices, faces
        middle = np.where(long, np.cumsum(long) - 1 + len(vertices), -1)
        halves = (vertices[start[long]] + vertices[end[long]]) / 2
        vertices = np.concatenate([vertices, halves])
        faces = _split(faces, middle[edge].reshape(-1, 3))


def _split(faces: Ints, middle: Ints) -> Ints:
    """Part triangles by the middles of their edges, -1 where an edge stays whole."""
    count = (middle >= 0).sum(axis=1)
    # One halved edge comes first; of two, the whole one comes last.
    lead = np.where(count == 1, middle.argmax(axis=1), (middle.argmin(axis=1) + 1) % 3)
    turn = (np.where(count % 3 == 0, 0, lead)[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(faces, turn, axis=1).T
    m, n, o = np.take_along_axis(middle, turn, axis=1).T
    patterns = (
        [(a, b, c)],
        [(a, m, c), (m, b, c)],
        [(m, b, n), (a, m, n), (a, n, c)],
        [(a, m, o), (m, b, n), (o, n, c), (m, n, o)],
    )
    parts = [
        np.stack(corners, axis=1)[count == k]
        for k, pattern in enumerate(patterns)
        for corners in pattern
    ]
    return np.concatenate(parts)


def bent_error(vertices: Floats, faces: Ints, relief: Relief, bend: Bend) -> float:
    """Bound the largest distance of a bent solid from its relief, mm.

    At every point of its face and the cut's floor: that of the triangles as they would be
    on the flat panel, towards the axis, and by how much their chords differ from those,
    square to the surface.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        As `Bend.bent` places them, mm.
    faces : (f, 3) ndarray of int
    relief : Relief
    bend : Bend
    """
    flat = bend.flat(vertices)[faces]
    # A triangle across the back has corners on both ends of the flat panel.
    turns = np.rint((flat[..., 0] - flat[:, :1, 0]) / bend.around)
    flat[..., 0] -= turns * bend.around
    past = flat[..., 0].max(axis=1) > bend.middle + bend.around / 2
    before = flat[..., 0].min(axis=1) < bend.middle - bend.around / 2
    turn = np.array([bend.around, 0.0, 0.0])
    flat = np.concatenate([flat, flat[past] - turn, flat[before] + turn])
    places = np.stack(
        [
            (flat[..., 0] - relief.grid.origin[0]) / relief.grid.pitch,
            (relief.grid.origin[1] - flat[..., 1]) / relief.grid.pitch,
            flat[..., 2],
        ],
        axis=-1,
    ).reshape(-1, 3)
    corners = np.arange(len(places)).reshape(-1, 3)
    # Rows run against Y: what faces out turns from rows to columns.
    low, high = (getattr(places.reshape(-1, 3, 3), end)(axis=1)[:, :2] for end in ("min", "max"))
    over = (high > BORDER).all(axis=1) & (low < np.array(relief.grid.shape[::-1]) - BORDER).all(
        axis=1
    )
    out = over & (plan_areas(places, corners) < -(BORDER**2))
    found = float(deviations(relief.heights, places, corners[out], margin=BORDER).max(initial=0.0))
    edges = (flat[out] - np.roll(flat[out], 1, axis=1)).reshape(-1, 3)
    return found + INSIDE * float(sags(edges, bend.radius - relief.depth).max(initial=0.0))
