"""Fewer triangles still, never further from the relief than the tolerance.

fast-simplification collapses edges by quadric error (Garland and Heckbert,
Surface simplification using quadric error metrics, 1997) and knows no bound of
its own, so that each of its results is measured against the relief, at every
point.  Where one is out, the triangles around are frozen and it is done again.  A
result is taken only if it is within tolerance everywhere, so that the worst that
can happen is a surface not reduced.  The outline stays, so that the panel's face
does.

Measured on a horse of 120 x 90 x 4 mm at 1024 x 768, 1.57 M triangles, tolerance
0.02 mm: grown to 0.9 of it, 62.0 k triangles in 0.2 s; this leaves 57.5 k after
two rounds of freezing.  Grown to all of it, 59.3 k.  Grown to half of it, 77.6 k,
and this leaves 64.7 k: new nodes know better than quadrics where the relief bends.
"""

import fast_simplification
import numpy as np
from numpy.typing import NDArray

from relieffab.panel.deviate import deviations
from relieffab.panel.edges import edge_keys, has_repeats, outline, plan_areas
from relieffab.panel.model import Floats, Ints, Sinking, Surface
from relieffab.progress import Progress, silent

Bools = NDArray[np.bool_]

GROWN = 0.9  # of the tolerance that a surface is best grown to before it comes here
REACH = 2.0  # of the pass in tolerances
TRIES = 6
# Low aggressiveness raises the quadric threshold slowly, best collapses first.
AGGRESSIVENESS = 3.0
# Where the library's threshold ends, its 100th round: 1e-9 (100 + 3)^agg, a squared length.
LAST_REACH = (1e-9 * 103.0**AGGRESSIVENESS) ** 0.5


def distances(surface: Surface, sinking: Sinking) -> Floats:
    """Largest vertical distance of each triangle from the relief, (f,), mm."""
    return deviations(sinking.heights, surface.over_nodes(), surface.faces)


def folded(surface: Surface) -> Bools:
    """Say which triangles do not face upwards, (f,).

    A surface without any, whose outline is that of a region of the plane, lies
    over each point of it exactly once: the degree of its projection is 1, and
    no triangle counts negatively.
    """
    return plan_areas(surface.vertices, surface.faces) <= 0  # type: ignore[no-any-return]


def _places(surface: Surface) -> NDArray[np.complex128]:
    """One sortable number a vertex: a surface over the plane has one vertex at a place."""
    return surface.vertices[:, 0] + 1j * surface.vertices[:, 1]  # type: ignore[no-any-return]


def _collapse(surface: Surface, frozen: Bools, reach: float) -> Surface:
    """Simplify the triangles not frozen, and join them to the others.

    Scaling by a power of two is exact, and the library leaves the border where
    it is: both sides of the joint agree to the last bit.  What would rise above
    the face stays on it.
    """
    ids, faces = np.unique(surface.faces[~frozen], return_inverse=True)
    scale = 2.0 ** np.round(np.log2(LAST_REACH / reach))
    points, triangles = fast_simplification.simplify(
        surface.vertices[ids] * scale,
        faces.reshape(-1, 3).astype(np.int32),
        target_count=1,
        agg=AGGRESSIVENESS,
        preserve_border=True,
    )
    points = points / scale
    points[:, 2] = np.minimum(points[:, 2], 0.0)
    start = len(surface.vertices)
    joined = Surface(
        surface.grid,
        np.concatenate([surface.vertices, points]),
        np.concatenate([surface.faces[frozen], triangles.astype(np.int64) + start]),
    )
    _, first, place = np.unique(_places(joined), return_index=True, return_inverse=True)
    used, faces = np.unique(place[joined.faces], return_inverse=True)
    return Surface(surface.grid, joined.vertices[first[used]], faces.reshape(-1, 3))


def _outline_places(surface: Surface) -> NDArray[np.complex128]:
    return np.sort(_places(surface)[outline(surface.faces)].T)


def is_sound(candidate: Surface, original: Surface) -> bool:
    """Say whether every edge has one triangle a side and the outline is the original's."""
    if has_repeats(edge_keys(candidate.faces)):
        return False
    return np.array_equal(_outline_places(candidate), _outline_places(original))


def _boxes(surface: Surface, margin: int) -> tuple[Ints, Ints, Ints, Ints]:
    """First and last row, first and last column of the nodes around each triangle."""
    rows, cols = surface.grid.node_shape
    x, y = surface.vertices[surface.faces, 0], -surface.vertices[surface.faces, 1]
    return tuple(  # type: ignore[return-value]
        np.clip(limit + way * margin, 0, count - 1).astype(np.int64)
        for values, count in ((y, rows), (x, cols))
        for limit, way in ((np.floor(values.min(axis=1)), -1), (np.ceil(values.max(axis=1)), 1))
    )


def _near(surface: Surface, bad: Surface, margin: int) -> Bools:
    """Say which triangles of a surface lie where bad ones do, by their boxes, (f,)."""
    rows, cols = surface.grid.node_shape
    counts = np.zeros((rows + 1, cols + 1), np.int32)
    top, low, left, right = _boxes(bad, margin)
    for row, col, sign in (
        (top, left, 1), (low + 1, right + 1, 1), (top, right + 1, -1), (low + 1, left, -1)
    ):  # fmt: skip
        np.add.at(counts, (row, col), sign)
    marked = counts.cumsum(axis=0).cumsum(axis=1)[:-1, :-1] > 0
    table = np.zeros((rows + 1, cols + 1), np.int32)
    np.cumsum(np.cumsum(marked, axis=0, dtype=np.int32), axis=1, out=table[1:, 1:])
    top, low, left, right = _boxes(surface, 0)
    low, right = low + 1, right + 1
    return table[low, right] - table[top, right] - table[low, left] + table[top, left] > 0  # type: ignore[no-any-return]


def simplify(
    surface: Surface, sinking: Sinking, tolerance: float, *, progress: Progress = silent
) -> Surface:
    """Reduce a surface as far as it stays within tolerance of the relief.

    Parameters
    ----------
    surface : Surface
    sinking : Sinking
        The relief to measure against, on the same grid.
    tolerance : float
        Largest vertical distance at any point, mm.
    progress : Progress

    Returns
    -------
    Surface
        With the same outline; the given one if nothing could be taken away.
    """
    reach = REACH * tolerance / sinking.grid.pitch
    frozen = np.zeros(len(surface.faces), bool)
    for attempt in range(TRIES):
        progress("simplify", attempt, TRIES)
        if frozen.all():
            break
        candidate = _collapse(surface, frozen, reach)
        out = (distances(candidate, sinking) > tolerance) | folded(candidate)
        if not out.any():
            progress("simplify", TRIES, TRIES)
            return candidate if is_sound(candidate, surface) else surface
        bad = Surface(candidate.grid, candidate.vertices, candidate.faces[out])
        frozen |= _near(surface, bad, attempt)
    progress("simplify", TRIES, TRIES)
    return surface
