"""The space above a surface, closed to a solid that meets the face at its outline only.

A boolean has nothing to guess where two solids cross.  Where they merely touch,
at a point or along a line, Manifold's result is a manifold in its connections,
but holds slits and corridors of no width, which do not survive a file format
that knows only positions.  So there are no touching places: what touches is
moved by less than a tenth of a micron.
"""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from relieffab.panel.edges import edge_keys, outline
from relieffab.panel.model import Floats, Ints, Surface

# Never moved further than this, mm.
CLEARANCE = 1e-4
# How far above the face the solid reaches, mm.
HEADROOM = 1.0


def _split_ridges(surface: Surface, depth: float) -> Surface:
    """Lower the middle of every inner edge that lies on the face, by `depth` pixels.

    No triangle has two such edges: it would lie on the face itself.
    """
    faces, count = surface.faces, len(surface.vertices)
    there, back = edge_keys(faces), edge_keys(faces, reverse=True)
    either = np.minimum(there, back).reshape(-1, 3)
    on_face = surface.vertices[faces, 2] == 0
    start, end = outline(faces).T
    rim = start * (int(faces.max(initial=0)) + 1) + end
    inner = ~np.isin(there, rim, kind="sort").reshape(-1, 3)
    face, side = np.nonzero(on_face & np.roll(on_face, -1, axis=1) & inner)
    if len(face) == 0:
        return surface
    _, first, middle = np.unique(either[face, side], return_index=True, return_inverse=True)
    a, b, c = (faces[face, (side + k) % 3] for k in range(3))
    between = (surface.vertices[a] + surface.vertices[b])[first] / 2
    between[:, 2] = -depth
    m = middle + count
    halves = [np.stack([a, m, c], axis=1), np.stack([m, b, c], axis=1)]
    return Surface(
        surface.grid,
        np.concatenate([surface.vertices, between]),
        np.concatenate([np.delete(faces, face, axis=0), *halves]),
    )


def clear_of_face(surface: Surface, clearance: float) -> Surface:
    """Keep all of a surface but its outline below the face.

    Peaks and ridges that just reach the face are lowered by `clearance`.
    Triangles that lie on the face cut nothing and are left out.

    Parameters
    ----------
    surface : Surface
        Nowhere above the face.
    clearance : float
        mm.

    Returns
    -------
    Surface
        Within `clearance` of the given one.
    """
    depth = clearance / surface.grid.pitch
    vertices = surface.vertices.copy()
    vertices[vertices[:, 2] > -depth, 2] = 0.0
    faces = surface.faces[(vertices[surface.faces, 2] < 0).any(axis=1)]
    inside = np.ones(len(vertices), bool)
    inside[outline(faces)] = False
    vertices[inside & (vertices[:, 2] == 0), 2] = -depth
    return _split_ridges(Surface(surface.grid, vertices, faces), depth)


def part_touching(surface: Surface, gap: float) -> Surface:
    """Give each sheet that meets others at a vertex only a vertex of its own.

    Two figures that touch at a corner share a node; walls raised from both
    would share an edge, which no solid may.

    Parameters
    ----------
    surface : Surface
    gap : float
        How far each such vertex moves into its own sheet, mm.

    Returns
    -------
    Surface
    """
    faces, count = surface.faces, len(surface.faces)
    start = np.arange(3 * count)
    end = np.roll(start.reshape(count, 3), -1, axis=1).ravel()
    key, opposite = edge_keys(faces), edge_keys(faces, reverse=True)
    order = np.argsort(key)
    mate = order[np.searchsorted(key, opposite, sorter=order).clip(max=len(key) - 1)]
    met = key[mate] == opposite
    # The corner where an edge starts is the corner where its mate ends.
    a, b = start[met], end[mate[met]]
    links = coo_array((np.ones(len(a), bool), (a, b)), shape=(3 * count, 3 * count))
    total, sheet = connected_components(links, directed=False)
    origin = np.empty(total, np.int64)
    origin[sheet] = faces.ravel()
    split = sheet.reshape(count, 3).astype(np.int64)
    vertices = surface.vertices[origin]
    for vertex in np.flatnonzero(np.bincount(origin, minlength=len(surface.vertices))[origin] > 1):
        around = vertices[split[(split == vertex).any(axis=1)]].mean(axis=1)
        inward = (around - vertices[vertex])[:, :2].sum(axis=0)
        vertices[vertex, :2] += inward * (gap / surface.grid.pitch / np.hypot(*inward))
    return Surface(surface.grid, vertices, split)


def solid_above(surface: Surface) -> tuple[Floats, Ints]:
    """Close the space between a surface and a plane above the face.

    Parameters
    ----------
    surface : Surface
        Its sheets parted where they touch.

    Returns
    -------
    vertices : (2 v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
        Watertight, counter-clockwise seen from outside.
    """
    floor = surface.points()
    lid = floor.copy()
    lid[:, 2] = HEADROOM
    v = len(floor)
    a, b = outline(surface.faces).T
    walls = [np.stack([a, b, b + v], axis=1), np.stack([a, b + v, a + v], axis=1)]
    # From inside the solid the surface is the floor: it turns its back to it.
    shell = [surface.faces[:, ::-1], surface.faces + v, *walls]
    return np.concatenate([floor, lid]), np.concatenate(shell)
