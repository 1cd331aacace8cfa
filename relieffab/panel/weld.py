"""A mesh as a file without connections holds it: one vertex to a position."""

import numpy as np

from relieffab.panel.model import Floats, Ints


def weld(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """Round to single precision, join what meets there, and drop what collapses.

    A corridor narrower than the rounding becomes two triangles of the same
    corners, back to back: both go, else their edges would have four sides.

    Parameters
    ----------
    vertices : (v, 3) ndarray
    faces : (f, 3) ndarray of int

    Returns
    -------
    vertices : (w, 3) ndarray
        Single precision numbers, held in double.
    faces : (g, 3) ndarray of int
    """
    single, place = np.unique(vertices.astype(np.float32), axis=0, return_inverse=True)
    faces = place.ravel()[faces]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    # Walked upwards twice of three: an even permutation of the sorted corners.
    even = (faces < np.roll(faces, -1, axis=1)).sum(axis=1) == 2
    _, same = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True)
    same = same.ravel()
    net = np.bincount(same, np.where(even, 1, -1))[same]
    used, faces = np.unique(faces[net != 0], return_inverse=True)
    return single[used].astype(np.float64), faces.reshape(-1, 3)
