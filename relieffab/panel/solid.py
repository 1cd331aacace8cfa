"""Between a panel's arrays and the solid modeller."""

import manifold3d
import numpy as np

from relieffab.panel.carve import checked
from relieffab.panel.edges import plan_areas
from relieffab.panel.model import Floats, Ints, Panel

ROUNDING = 1e-7  # mm


def manifold_of(panel: Panel, what: str) -> manifold3d.Manifold:
    """Hand a panel to the modeller.

    Parameters
    ----------
    panel : Panel
    what : str
        As a message would name it.

    Raises
    ------
    RelieffabError
        If it is not a solid.
    """
    # Copies: the modeller takes no read-only arrays.
    mesh = manifold3d.Mesh64(np.array(panel.vertices, np.float64), np.array(panel.faces, np.uint64))
    return checked(manifold3d.Manifold(mesh), what)


def arrays_of(solid: manifold3d.Manifold) -> tuple[Floats, Ints]:
    """Take a solid back: vertices (v, 3), mm, and faces (f, 3)."""
    mesh = solid.to_mesh64()
    vertices = np.array(mesh.vert_properties[:, :3], np.float64)
    return vertices, np.array(mesh.tri_verts, np.int64)


def snapped(vertices: Floats) -> Floats:
    """Put coordinates on 0 that are within rounding of it.

    Near 0 single precision has numbers that readers of files take for the same.
    """
    return np.where(np.abs(vertices) < ROUNDING, 0.0, vertices)


def lowest_facing_up(panel: Panel) -> float:
    """Find the Z of the lowest corner of what can be seen from above, mm."""
    up = plan_areas(panel.vertices, panel.faces) > 0
    return float(panel.vertices[panel.faces[up], 2].min())
