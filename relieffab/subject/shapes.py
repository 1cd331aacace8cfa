"""Shapes with known answers: their lines, bending and volume follow from a formula."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Shape = tuple[Floats, Ints]


def sheet(
    surface: Callable[[Floats, Floats], Floats],
    counts: tuple[int, int],
    *,
    closed: tuple[bool, bool] = (False, False),
) -> Shape:
    """Triangulate a surface over the unit square.

    Parameters
    ----------
    surface : callable
        From u and v, (n,) each, to points (n, 3); outward is d/du x d/dv.
    counts : tuple of int
        Vertices along u and along v.
    closed : tuple of bool
        Whether the surface closes on itself along u, along v.

    Returns
    -------
    vertices : (n, 3) ndarray
    faces : (f, 3) ndarray of int
    """
    m, n = counts
    i, j = (k.ravel() for k in np.meshgrid(np.arange(m), np.arange(n), indexing="ij"))
    u = i / (m if closed[0] else m - 1)
    v = j / (n if closed[1] else n - 1)
    last = ((i < m - 1) | closed[0]) & ((j < n - 1) | closed[1])
    i, j = i[last], j[last]
    after_i, after_j = (i + 1) % m, (j + 1) % n
    a, b, c, d = i * n + j, after_i * n + j, after_i * n + after_j, i * n + after_j
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return surface(u, v), faces.astype(np.int64)


def torus(big: float, small: float, counts: tuple[int, int]) -> Shape:
    """Return a torus about the Z axis: the radius of its ring, that of its tube."""

    def surface(u: Floats, v: Floats) -> Floats:
        theta, phi = 2 * np.pi * u, 2 * np.pi * v
        rho = big + small * np.cos(phi)
        return np.stack([rho * np.cos(theta), rho * np.sin(theta), small * np.sin(phi)], axis=1)

    return sheet(surface, counts, closed=(True, True))


def star(distance: Callable[[Floats], Floats], count: int) -> Shape:
    """Triangulate a surface given by its distance from the origin.

    Parameters
    ----------
    distance : callable
        From unit vectors (n, 3) to distances (n,).
    count : int
        Vertices, spread evenly over directions on a golden spiral.
    """
    k = np.arange(count) + 0.5
    z, angle = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    rho = np.sqrt(1 - z * z)
    unit = np.stack([rho * np.cos(angle), rho * np.sin(angle), z], axis=1)
    faces = ConvexHull(unit).simplices.astype(np.int64)
    a, b, c = (unit[faces[:, i]] for i in range(3))
    inward = np.einsum("fn,fn->f", np.cross(b - a, c - a), a) < 0
    faces[inward] = faces[inward][:, ::-1]
    return distance(unit)[:, None] * unit, faces


def sphere(radius: float, count: int) -> Shape:
    """Return a sphere about the origin."""
    return star(lambda unit: np.full(len(unit), radius), count)


def capsule(radius: float, half: float, count: int) -> Shape:
    """Return all within `radius` of the X axis from -half to half."""

    def distance(unit: Floats) -> Floats:
        along = np.abs(unit[:, 0])
        across = np.sqrt(1 - along**2)
        side = radius / np.maximum(across, 1e-12)
        cap = half * along + np.sqrt(np.maximum(radius**2 - (half * across) ** 2, 0.0))
        return np.where(side * along <= half, side, cap)

    return star(distance, count)


def box(size: tuple[float, float, float]) -> Shape:
    """Return a box about the origin: eight vertices, twelve triangles."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = np.array([[q[0], q[i], q[i + 1]] for q in quads for i in (1, 2)])
    return corners * np.array(size) / 2, faces
