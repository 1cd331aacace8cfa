"""A cut that meets the face at its outline only, so that the boolean has nothing to guess."""

import numpy as np

from relieffab.panel.model import Ints, Surface
from relieffab.panel.triangulate import edge_keys, outline

# A tenth of a micron below the face is no longer the face.
CLEARANCE = 1e-4


def _split_ridges(surface: Surface, depth: float) -> Surface:
    """Lower the middle of every inner edge that lies on the face, by `depth` pixels.

    No triangle has two such edges: it would lie on the face itself.
    """
    faces, count = surface.faces, len(surface.vertices)
    there, back = edge_keys(faces), edge_keys(faces, reverse=True)
    either = np.minimum(there, back).reshape(-1, 3)
    on_face = surface.vertices[faces, 2] == 0
    inner = ~np.isin(there, edge_keys_of(outline(faces), faces)).reshape(-1, 3)
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


def edge_keys_of(edges: Ints, faces: Ints) -> Ints:
    """Number directed edges (n, 2) as `edge_keys` numbers those of `faces`."""
    return edges[:, 0] * (int(faces.max(initial=0)) + 1) + edges[:, 1]


def clear_of_face(surface: Surface, clearance: float = CLEARANCE) -> Surface:
    """Keep all of a surface but its outline below the face.

    Peaks and ridges that just reach the face would be points and lines common
    to slab and cut, where a boolean leaves slits of no width: they are lowered
    by `clearance`.  Triangles that lie on the face cut nothing and are left out.

    Parameters
    ----------
    surface : Surface
        Nowhere above the face.
    clearance : float, optional
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
