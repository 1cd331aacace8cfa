"""The mould that casts a panel: a tray whose cavity is the panel, face down.

Turned over, the panel's face is the tray's floor, and what is sunk into the one
stands up from the other, mirrored.  The walls around lean outwards by the draft,
so that the cast comes free; it is poured level with the brim.
"""

from math import radians, tan

import manifold3d
import numpy as np

from relieffab.errors import InputError
from relieffab.panel.edges import plan_areas
from relieffab.panel.model import Floats, Panel
from relieffab.panel.solid import ROUNDING, checked, manifold_of, panel_of

# Material under the floor, and around at the brim, mm.
FLOOR, RIM = 4.0, 6.0
MOST = 45.0  # degrees of draft
BEYOND = 1.0  # mm that the cavity is cut higher than the brim


def check_angle(draft: float) -> None:
    """Refuse a draft that no wall has.

    Raises
    ------
    InputError
        If it is not from 0 to 45 degrees.
    """
    if not 0 <= draft <= MOST:
        raise InputError(
            "walls cannot have that draft",
            expected=f"0 to {MOST:g} degrees",
            found=f"{draft:g}",
            where="draft",
        )


def outer_size(size: tuple[float, float], thickness: float, draft: float) -> tuple[float, float]:
    """Size of the mould of a panel, X and Y, mm."""
    check_angle(draft)
    around = 2 * (thickness * tan(radians(draft)) + RIM)
    return size[0] + around, size[1] + around


def _check_rectangle(panel: Panel, low: Floats, high: Floats) -> None:
    back = (panel.vertices[panel.faces, 2] < low[2] + ROUNDING).all(axis=1)
    area = abs(float(plan_areas(panel.vertices, panel.faces[back]).sum())) / 2
    whole = float(np.prod((high - low)[:2]))
    if abs(area - whole) > ROUNDING * whole:
        raise InputError(
            "only a rectangular panel has a mould",
            expected=f"a back of {whole:g} mm²",
            found=f"{area:g} mm²",
        )


def leaning(panel: Panel, draft: float, beyond: float = 0.0) -> Floats:
    """Lean a panel's sides outwards, from its face down: what the mould casts.

    Parameters
    ----------
    panel : Panel
        Rectangular.
    draft : float
        Of the sides, degrees.
    beyond : float, optional
        How far the back is moved down, mm, the sides going on.

    Returns
    -------
    (v, 3) ndarray
        The panel's vertices, those on its sides moved outwards.
    """
    low, high = panel.vertices.min(axis=0), panel.vertices.max(axis=0)
    found = panel.vertices.copy()
    found[found[:, 2] < low[2] + ROUNDING, 2] -= beyond
    out = (high[2] - found[:, 2]) * tan(radians(draft))
    for axis in (0, 1):
        place = panel.vertices[:, axis]
        found[:, axis] -= np.where(place < low[axis] + ROUNDING, out, 0.0)
        found[:, axis] += np.where(place > high[axis] - ROUNDING, out, 0.0)
    return found


def make_mould(panel: Panel, draft: float = 3.0) -> Panel:
    """Make the tray that casts a panel.

    Parameters
    ----------
    panel : Panel
        On a rectangular stock; the mould is as near to the relief as it is.
    draft : float, optional
        Of the walls around, degrees: the cast's back is larger than its face.

    Returns
    -------
    Panel
        The floor, which is the cast's face, at Z0, the brim above it by the panel's
        thickness; the near left corner at X0 Y0, X mirrored.

    Raises
    ------
    InputError
        If the draft is out of range, or the panel not rectangular.
    """
    check_angle(draft)
    low, high = panel.vertices.min(axis=0), panel.vertices.max(axis=0)
    _check_rectangle(panel, low, high)
    cavity = manifold_of(leaning(panel, draft, BEYOND), panel.faces, "the cavity")
    size = (float(high[0] - low[0]), float(high[1] - low[1]))
    outer = np.array([*outer_size(size, float(high[2] - low[2]), draft), high[2] - low[2] + FLOOR])
    corner = np.array([*(low + high)[:2] / 2 - outer[:2] / 2, low[2]])
    block = manifold3d.Manifold.cube(tuple(outer)).translate(tuple(corner))
    solid = checked(block - cavity, "the mould")
    # Half a turn about Y lays it on its floor; a reflection would cast the panel's image.
    place = (float(corner[0] + outer[0]), float(-corner[1]), float(high[2]))
    return panel_of(solid.scale((-1.0, 1.0, -1.0)).translate(place), panel.max_error_mm)
