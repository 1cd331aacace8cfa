"""Normals that keep creases sharp, and Lambert's law."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from relieffab.grid import Grid
from relieffab.layers.raster import Raster, interpolate

Floats = NDArray[np.float64]

GRAZING = 0.02  # least share of a seen normal that points to the viewer
Ints = NDArray[np.int64]
Groups = tuple[Ints, int]
"""Of corners: the split vertex at each, (f, 3), and how many there are."""

CREASE = 40.0
"""Angle between faces beyond which an edge stays sharp, degrees."""


def default_lights() -> Floats:
    """Two lights from the upper left and the upper right, 35 degrees above the panel.

    With the light at the view the lit surface tells nothing of which way it
    slopes; two oblique ones together tell both components.
    """
    lights = np.array([[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0]])
    return lights / np.linalg.norm(lights, axis=1, keepdims=True)


def lambert(normals: Floats, lights: Floats) -> Floats:
    """Shade normals under each light: max(0, n·m) (Wang 2011, Eq. 6, clamped).

    Parameters
    ----------
    normals : (rows, cols, 3) ndarray
    lights : (k, 3) ndarray

    Returns
    -------
    (k, rows, cols) ndarray
    """
    return np.maximum(np.einsum("ijn,kn->kij", normals, lights), 0.0)


def face_normals(vertices: Floats, faces: NDArray[np.integer]) -> Floats:
    """Return normals of the faces, (f, 3), as long as twice the face's area."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def smoothing_groups(vertices: Floats, faces: Ints, crease: float = CREASE) -> Groups:
    """Split vertices where faces meet at more than the crease angle.

    Corners of two faces that share a smooth edge belong together; what is then
    connected is one vertex for the purpose of shading.

    Parameters
    ----------
    vertices : (v, 3) ndarray
    faces : (f, 3) ndarray of int
    crease : float
        Largest angle between neighbouring faces that is still smooth, degrees.

    Returns
    -------
    groups : (f, 3) ndarray of int
        The split vertex at each corner.
    count : int
        How many there are.
    """
    normals = face_normals(vertices, faces)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(length > 0, length, 1.0)
    corners = np.arange(faces.size).reshape(faces.shape)
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    start_corner, end_corner = corners.ravel(), corners[:, [1, 2, 0]].ravel()
    swap = start > end
    low, high = np.where(swap, end, start), np.where(swap, start, end)
    low_corner = np.where(swap, end_corner, start_corner)
    high_corner = np.where(swap, start_corner, end_corner)
    order = np.lexsort((high, low))
    same = (np.diff(low[order]) == 0) & (np.diff(high[order]) == 0)
    one, two = order[:-1][same], order[1:][same]
    cosine = np.einsum("en,en->e", normals[one // 3], normals[two // 3])
    smooth = cosine > np.cos(np.radians(crease))
    one, two = one[smooth], two[smooth]
    rows = np.concatenate([low_corner[one], high_corner[one]])
    cols = np.concatenate([low_corner[two], high_corner[two]])
    graph = coo_array((np.ones(len(rows), np.int8), (rows, cols)), shape=(faces.size,) * 2)
    count, label = connected_components(graph, directed=False)
    return label.reshape(faces.shape).astype(np.int64), int(count)


def pixel_normals(
    raster: Raster,
    vertices: Floats,
    faces: Ints,
    grid: Grid,
    *,
    groups: Groups | None = None,
) -> Floats:
    """Find unit normals at the pixels, smooth over smooth edges, turned to the viewer.

    Parameters
    ----------
    raster : Raster
        Of this mesh on this grid.
    vertices : (v, 3) ndarray
        On the panel, mm.
    faces : (f, 3) ndarray of int
    grid : Grid
    groups : tuple, optional
        From `smoothing_groups` of the same mesh, wherever it lies; found if not given.

    Returns
    -------
    (rows, cols, 3) ndarray
        (0, 0, 1) where nothing is seen.  Corner normals are weighted as in Max,
        "Weights for computing vertex normals from facet normals" (1999).
    """
    corners, count = groups or smoothing_groups(vertices, faces)
    face = face_normals(vertices, faces)
    normals = np.zeros((count, 3))
    for k in range(3):
        here, after, before = (vertices[faces[:, (k + s) % 3]] for s in (0, 1, 2))
        squares = ((after - here) ** 2).sum(1) * ((before - here) ** 2).sum(1)
        weight = np.divide(1.0, squares, out=np.zeros_like(squares), where=squares > 0)
        for axis in range(3):
            normals[:, axis] += np.bincount(corners[:, k], face[:, axis] * weight, count)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals /= np.where(length > 0, length, 1.0)
    corner_points = np.empty((count, 3))
    corner_points[corners.ravel()] = vertices[faces.ravel()]
    out = interpolate(raster, corner_points, corners, normals, grid)
    away = face_normals(vertices, faces)[:, 2] < 0
    out[raster.mask & away[raster.triangle]] *= -1.0
    # Interpolation may pass the horizon of a face that is seen.
    out[raster.mask, 2] = np.maximum(out[raster.mask, 2], GRAZING)
    length = np.linalg.norm(out, axis=2, keepdims=True)
    out /= np.where(length > 0, length, 1.0)
    out[~(length[..., 0] > 0)] = (0.0, 0.0, 1.0)
    return out


def light_at(azimuth: float, elevation: float) -> Floats:
    """Point a unit vector towards a light.

    Parameters
    ----------
    azimuth : float
        From the panel's far side towards its right, degrees.
    elevation : float
        Above the panel, degrees.
    """
    a, e = np.radians(azimuth), np.radians(elevation)
    return np.array([np.sin(a) * np.cos(e), np.cos(a) * np.cos(e), np.sin(e)])
