"""Between arrays and the solid modeller."""

import manifold3d
import numpy as np

from relieffab.errors import RelieffabError
from relieffab.panel.edges import edge_keys, has_repeats, plan_areas
from relieffab.panel.model import Floats, Ints, Panel

# Rounding of the modeller, mm: nearer to 0 is 0.
ROUNDING = 1e-7


def checked(solid: manifold3d.Manifold, what: str) -> manifold3d.Manifold:
    """Return a solid, or raise what the solid modeller says against it.

    Manifold raises nothing: a bad input becomes an empty solid with a status.

    Raises
    ------
    RelieffabError
        With the modeller's own word.
    """
    status = solid.status()
    if status != manifold3d.Error.NoError:
        raise RelieffabError(f"{what} is not a solid", expected="NoError", found=status.name)
    if solid.is_empty():
        raise RelieffabError(f"{what} is empty", expected="a volume", found="0 mm³")
    return solid


def manifold_of(vertices: Floats, faces: Ints, what: str) -> manifold3d.Manifold:
    """Hand triangles to the modeller.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        mm.
    faces : (f, 3) ndarray of int
    what : str
        As a message would name it.

    Raises
    ------
    RelieffabError
        If they are not a solid.
    """
    # Copies: the modeller takes no read-only arrays.
    mesh = manifold3d.Mesh64(np.array(vertices, np.float64), np.array(faces, np.uint64))
    return checked(manifold3d.Manifold(mesh), what)


def is_watertight(faces: Ints) -> bool:
    """Say whether every edge is walked exactly once each way."""
    there, back = edge_keys(faces), edge_keys(faces, reverse=True)
    return not has_repeats(there) and np.array_equal(np.sort(there), np.sort(back))


def panel_of(solid: manifold3d.Manifold, error: float) -> Panel:
    """Take a solid back from the modeller.

    Near 0 single precision has numbers that readers of files take for the same:
    coordinates within rounding of it are put there.

    Parameters
    ----------
    solid : Manifold
    error : float
        Its largest vertical distance to the relief, mm.
    """
    mesh = solid.to_mesh64()
    vertices = np.array(mesh.vert_properties[:, :3], np.float64)
    vertices[np.abs(vertices) < ROUNDING] = 0.0
    faces = np.array(mesh.tri_verts, np.int64)
    return Panel(vertices, faces, is_watertight(faces), float(solid.volume()), error)


def lowest_facing_up(panel: Panel) -> float:
    """Find the Z of the lowest corner of what can be seen from above, mm."""
    up = plan_areas(panel.vertices, panel.faces) > 0
    return float(panel.vertices[panel.faces[up], 2].min())
