"""The slab minus the space above the relief: Relief and Stock to Panel."""

from dataclasses import replace

import manifold3d
import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError, RelieffabError
from relieffab.panel.blank import Blank, make_blank
from relieffab.panel.cad import CHORD
from relieffab.panel.deviate import deviations
from relieffab.panel.edges import plan_areas
from relieffab.panel.model import Floats, Ints, Panel, Sinking, Surface
from relieffab.panel.simplify import GROWN, distances, simplify
from relieffab.panel.sinking import sink
from relieffab.panel.solid import ROUNDING, checked, manifold_of, panel_of
from relieffab.panel.space import CLEARANCE, clear_of_face, part_touching, solid_above
from relieffab.panel.triangulate import triangulate
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief
from relieffab.stock import Stock

# Shares of the tolerance kept back for peaks, and for sheets, that must not touch.
RESERVE = 0.02
# Pixels from the grid's border where a panel's height is not measured.
BORDER = 1e-6


def carve(blank: Blank, surface: Surface) -> manifold3d.Manifold:
    """Take the space above a surface out of the uncut stock.

    Raises
    ------
    RelieffabError
        If either, or what is left, is not a solid.
    """
    stock = manifold_of(blank.vertices, blank.faces, "the stock")
    if len(surface.faces) == 0:
        return stock
    space = manifold_of(*solid_above(surface), "the space above the relief")
    return checked(stock - space, "the carved panel")


def _of_face(vertices: Floats, faces: Ints, stock: Stock) -> NDArray[np.bool_]:
    """Tell triangles of the level face, and of what is cut into it, from frame, holes and sides."""
    x, y, z = vertices.T
    # Keyholes have shoulders that face up; the sides reach to the back.
    back = max((key.depth for key in stock.keyholes), default=ROUNDING) - stock.thickness
    near = stock.on_face(x, y, -CHORD) & (z <= ROUNDING) & (z > back)
    # What stands upright along a rim has all its corners there.
    away = stock.on_face(x, y, CHORD)
    return np.asarray(near[faces].all(axis=1) & away[faces].any(axis=1))


def largest_error(vertices: Floats, faces: Ints, relief: Relief, stock: Stock) -> float:
    """Measure a panel against the relief, at every point of its face and the cut's floor, mm.

    On the grid's border there may be an upright wall, where a panel has no one height.
    Frame and holes are not looked at.
    """
    grid, h = relief.grid, relief.heights
    col = (vertices[:, 0] - grid.origin[0]) / grid.pitch
    row = (grid.origin[1] - vertices[:, 1]) / grid.pitch
    places = np.stack([col, row, vertices[:, 2]], axis=1)
    # Rows run against Y: what faces up turns from rows to columns.
    up = plan_areas(places, faces) < 0
    if not stock.plain:
        up &= _of_face(vertices, faces, stock)
    return float(deviations(h, places, faces[up], margin=BORDER).max(initial=0.0))


def surface_below(sinking: Sinking, tolerance: float, progress: Progress) -> tuple[Surface, float]:
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
    relief: Relief,
    stock: Stock,
    *,
    blank: Blank | None = None,
    tolerance: float = 0.02,
    progress: Progress = silent,
) -> Panel:
    """Carve a relief into a slab.

    Parameters
    ----------
    relief : Relief
        One with nothing below the face leaves the plain slab.
    stock : Stock
    blank : Blank, optional
        The stock's triangles, where they are at hand: one with a shape takes cadquery.
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
    CadUnavailableError
        If the stock has a shape and cadquery is not there.
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
    surface, error = surface_below(sinking, tolerance, progress)
    progress("carve", 0, 1)
    panel = panel_of(carve(blank or make_blank(stock), surface), error)
    found = largest_error(panel.vertices, panel.faces, relief, stock)
    panel = replace(panel, max_error_mm=max(error, found))
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
