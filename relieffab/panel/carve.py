"""The slab minus the space above the relief: Relief and Stock to Panel."""

import manifold3d
import numpy as np

from relieffab.errors import InputError, RelieffabError
from relieffab.panel.deviate import deviations
from relieffab.panel.edges import edge_keys, has_repeats, plan_areas
from relieffab.panel.model import Floats, Ints, Panel, Sinking, Surface
from relieffab.panel.simplify import GROWN, distances, simplify
from relieffab.panel.sinking import sink
from relieffab.panel.space import CLEARANCE, clear_of_face, part_touching, solid_above
from relieffab.panel.triangulate import triangulate
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief
from relieffab.stock import Stock

# Shares of the tolerance kept back for peaks, and for sheets, that must not touch.
RESERVE = 0.02
# Rounding of the modeller, mm: nearer to the face is the face.
ROUNDING = 1e-7
# Pixels from the grid's border where a panel's height is not measured.
BORDER = 1e-6


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


def _solid(vertices: Floats, faces: Ints, what: str) -> manifold3d.Manifold:
    mesh = manifold3d.Mesh64(
        np.ascontiguousarray(vertices, np.float64), np.ascontiguousarray(faces, np.uint64)
    )
    return checked(manifold3d.Manifold(mesh), what)


def slab(stock: Stock) -> manifold3d.Manifold:
    """Make the uncut slab, its face at Z0."""
    size = (stock.width, stock.height, stock.thickness)
    box = manifold3d.Manifold.cube(size).translate((0.0, 0.0, -stock.thickness))
    return checked(box, "the slab")


def carve(stock: Stock, surface: Surface) -> manifold3d.Manifold:
    """Take the space above a surface out of the slab.

    Raises
    ------
    RelieffabError
        If either, or what is left, is not a solid.
    """
    space = _solid(*solid_above(surface), "the space above the relief")
    return checked(slab(stock) - space, "the carved panel")


def is_watertight(faces: Ints) -> bool:
    """Say whether every edge is walked exactly once each way."""
    there, back = edge_keys(faces), edge_keys(faces, reverse=True)
    return not has_repeats(there) and np.array_equal(np.sort(there), np.sort(back))


def largest_error(vertices: Floats, faces: Ints, relief: Relief) -> float:
    """Measure a panel against the relief, at every point of its face and the cut's floor, mm.

    On the grid's border there may be an upright wall, where a panel has no one height.
    """
    grid, h = relief.grid, relief.heights
    col = (vertices[:, 0] - grid.origin[0]) / grid.pitch
    row = (grid.origin[1] - vertices[:, 1]) / grid.pitch
    places = np.stack([col, row, vertices[:, 2]], axis=1)
    # Rows run against Y: what faces up turns from rows to columns.
    up = plan_areas(places, faces) < 0
    return float(deviations(h, places, faces[up], margin=BORDER).max(initial=0.0))


def _finish(solid: manifold3d.Manifold, relief: Relief, error: float) -> Panel:
    mesh = solid.to_mesh64()
    vertices = np.array(mesh.vert_properties[:, :3], np.float64)
    vertices[np.abs(vertices[:, 2]) < ROUNDING, 2] = 0.0
    faces = np.array(mesh.tri_verts, np.int64)
    return Panel(
        vertices,
        faces,
        is_watertight(faces),
        float(solid.volume()),
        max(error, largest_error(vertices, faces, relief)),
    )


def _surface(sinking: Sinking, tolerance: float, progress: Progress) -> tuple[Surface, float]:
    """Triangulate and simplify what is below the face; and its largest error, mm."""
    reserve = RESERVE * tolerance
    bound = tolerance - 2 * reserve
    surface = triangulate(sinking, GROWN * bound)
    surface = simplify(surface, sinking, bound, progress=progress)
    surface = clear_of_face(surface, min(reserve, CLEARANCE))
    steepest = max(-float(sinking.heights.min()), CLEARANCE) / sinking.grid.pitch
    surface = part_touching(surface, min(reserve / steepest, CLEARANCE))
    return surface, float(distances(surface, sinking).max(initial=0.0))


def make_panel(
    relief: Relief, stock: Stock, *, tolerance: float = 0.02, progress: Progress = silent
) -> Panel:
    """Carve a relief into a slab.

    Parameters
    ----------
    relief : Relief
        One with nothing below the face leaves the plain slab.
    stock : Stock
    tolerance : float, optional
        Largest vertical distance between panel and relief at any point, mm.
    progress : Progress, optional

    Returns
    -------
    Panel
        Watertight, its error measured.

    Raises
    ------
    InputError
        If the tolerance is not a length, or the stock cannot hold the relief.
    RelieffabError
        If the result breaks the tolerance or is no solid; neither should be.
    """
    if not 0 < tolerance < stock.thickness:
        raise InputError(
            "the panel's tolerance cannot be met",
            expected=f"more than 0 mm, less than the stock's thickness, {stock.thickness:g} mm",
            found=f"{tolerance:g} mm",
        )
    sinking = sink(relief, stock)
    surface, error = _surface(sinking, tolerance, progress)
    progress("carve", 0, 1)
    solid = carve(stock, surface) if len(surface.faces) else slab(stock)
    panel = _finish(solid, relief, error)
    progress("carve", 1, 1)
    return accept(panel, tolerance)


def accept(panel: Panel, tolerance: float) -> Panel:
    """Return a panel that is watertight and within tolerance, else raise."""
    if panel.max_error_mm > tolerance:
        raise RelieffabError(
            "the panel is out of tolerance",
            expected=f"within {tolerance:g} mm of the relief",
            found=f"{panel.max_error_mm:g} mm",
        )
    if not panel.watertight:
        raise RelieffabError("the panel is not watertight", expected="two triangles at every edge")
    return panel
