"""How fields on a mesh change along directions that lie in it."""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.surface import Surface

Floats = NDArray[np.float64]


def _gradients(surface: Surface, corners: Floats) -> tuple[Floats, Floats]:
    """Gradients (f, 3) of fields linear on each face, given at its corners (f, 3), and areas."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    twice = np.einsum("fk,fk->f", normal, normal)
    solid = twice > 0
    turned = sum(
        np.cross(normal, edge) * corners[:, k : k + 1]
        for k, edge in enumerate((c - b, a - c, b - a))
    )
    return np.where(solid, 1 / np.where(solid, twice, 1.0), 0.0)[:, None] * turned, np.sqrt(twice)


def _to_vertices(surface: Surface, of_face: Floats, weight: Floats) -> Floats:
    """Means of face values (f,) round each vertex: (v,), 0 where no face has weight."""
    count = len(surface.vertices)
    corners = surface.faces.ravel()
    total = np.bincount(corners, np.repeat(of_face * weight, 3), count)
    mass = np.bincount(corners, np.repeat(weight, 3), count)
    return np.divide(total, mass, out=np.zeros(count), where=mass > 0)


def slope(surface: Surface, field: Floats, along: Floats) -> Floats:
    """Change of a field per mm along a direction at each vertex.

    Parameters
    ----------
    surface : Surface
    field : (v,) ndarray
    along : (v, 3) ndarray
        Of any length.

    Returns
    -------
    (v,) ndarray
        Changes sign with the direction.
    """
    gradient, area = _gradients(surface, field[surface.faces])
    mean = np.stack([_to_vertices(surface, part, area) for part in gradient.T], axis=1)
    return np.einsum("vk,vk->v", mean, along)


def slope_of_directed(surface: Surface, field: Floats, along: Floats) -> Floats:
    """Change of a field along the very directions its sign belongs to.

    Both senses of a direction give the same answer.

    Parameters
    ----------
    surface : Surface
    field : (v,) ndarray
    along : (v, 3) ndarray

    Returns
    -------
    (v,) ndarray
    """
    directions = along[surface.faces]
    agree = np.einsum("fck,fk->fc", directions, directions[:, 0]) >= 0
    sense = np.where(agree, 1.0, -1.0)
    gradient, area = _gradients(surface, sense * field[surface.faces])
    mean = np.einsum("fc,fck->fk", sense, directions) / 3
    return _to_vertices(surface, np.einsum("fk,fk->f", gradient, mean), area)
