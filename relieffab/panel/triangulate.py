"""The relief's surface below the face as few triangles between its nodes."""

import numpy as np

from relieffab.panel.grow import grow
from relieffab.panel.model import Sinking, Surface


def triangulate(sinking: Sinking, bound: float) -> Surface:
    """Cover what lies below the face.

    Parameters
    ----------
    sinking : Sinking
    bound : float
        Largest vertical distance to the relief at any point, mm; 0 joins only what
        is flat.

    Returns
    -------
    Surface
        Its outline lies on the face, or on the grid's border.
    """
    h, pitch = sinking.heights, sinking.grid.pitch
    faces = grow(h, bound)
    nodes, faces = np.unique(faces[(h.ravel()[faces] < 0).any(axis=1)], return_inverse=True)
    row, col = np.divmod(nodes, h.shape[1])
    vertices = np.stack([col, -row, h.ravel()[nodes] / pitch], axis=1)
    # Rows run against Y: a triangle that turns from columns to rows faces down.
    return Surface(sinking.grid, vertices, faces.reshape(-1, 3)[:, ::-1].copy())
