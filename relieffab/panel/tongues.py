"""Tongues that join the parts of a panel: their shape, and the room they need."""

from math import ceil, cos, radians, tan

import manifold3d
import numpy as np

from relieffab.errors import InputError

# A tongue: how far it reaches, how wide it is at the seam, how much each side leans, degrees.
LENGTH, WIDTH, TAPER = 5.0, 10.0, 15.0
# Rough distance of the tongues along a seam, mm; two at least, where there is room.
SPACING = 60.0
# Material kept between notches, and between a notch and the relief above it, mm.
WALL, COVER = 2.0, 1.0
# A tongue lower than this breaks, mm; and as a share of the slab it is no higher than that.
LOWEST, SHARE = 1.0, 1 / 3
LOOSEST = 1.0  # mm of clearance, beyond which nothing is held in its place
BEYOND = 1.0  # mm that a cutting solid reaches past what it cuts
ROUNDING = 1e-9
MOST = (26, 99)  # rows and columns that have a name, A1 to Z99


Pair = tuple[float, float]


def needed(clearance: float, count: int, *, seam: bool) -> float:
    """Side that a part must have for one tongue, clear of those of crossing seams, mm.

    Parameters
    ----------
    clearance : float
    count : int
        Parts along the side: more than one are joined by crossing tongues.
    seam : bool
        Whether the side itself is one, with a tongue.
    """
    tongue = WIDTH + 2 * clearance / cos(radians(TAPER)) if seam else 0.0
    crossing = 2 * (LENGTH + clearance) if count > 1 else 0.0
    return tongue + crossing + 2 * WALL


def _count(side: float, room: float) -> int:
    if side <= room + ROUNDING:
        return 1
    if room <= LENGTH:
        raise InputError(
            "the print bed has no room for a tongue",
            expected=f"more than {LENGTH:g} mm",
            found=f"{room:g} mm",
            where="bed",
        )
    return ceil(side / (room - LENGTH) - ROUNDING)


def layout(size: Pair, bed: Pair, clearance: float) -> tuple[int, int]:
    """Count the fewest equal parts that fit a bed, tongues included.

    Parameters
    ----------
    size : tuple of float
        Of the panel, X and Y, mm.
    bed : tuple of float
        Of the printer, X and Y, mm; parts are not turned on it.
    clearance : float
        Between tongue and notch, mm.

    Returns
    -------
    rows, cols : int

    Raises
    ------
    InputError
        If the clearance is out of range, or the parts have no room for tongues.
    """
    if not 0 <= clearance <= LOOSEST:
        raise InputError(
            "tongues cannot fit with that clearance",
            expected=f"0 to {LOOSEST:g} mm",
            found=f"{clearance:g} mm",
            where="clearance",
        )
    cols, rows = _count(size[0], bed[0]), _count(size[1], bed[1])
    parts = (size[0] / cols, size[1] / rows)
    least = (
        needed(clearance, cols, seam=rows > 1),
        needed(clearance, rows, seam=cols > 1),
    )
    small = any(part < need for part, need in zip(parts, least, strict=True))
    if rows * cols > 1 and (small or rows > MOST[0] or cols > MOST[1]):
        raise InputError(
            "the parts would be too small for their tongues",
            expected=f"{least[0]:.4g} x {least[1]:.4g} mm or more, "
            f"at most {MOST[0]} rows and {MOST[1]} columns",
            found=f"{rows} x {cols} parts of {parts[0]:.4g} x {parts[1]:.4g} mm",
            where="bed",
            hint="a larger bed",
        )
    return rows, cols


def tongue_height(thickness: float, floor: float, clearance: float) -> float:
    """Choose how high tongues are: a third of the slab, well under the relief.

    Parameters
    ----------
    thickness : float
        Of the slab, mm.
    floor : float
        What the relief leaves of it where it is deepest, mm.
    clearance : float
        Above a tongue, mm.

    Raises
    ------
    InputError
        If the slab is too thin.
    """
    height = min(SHARE * thickness, floor - COVER - clearance)
    if height < LOWEST - ROUNDING:
        raise InputError(
            "the slab is too thin for tongues",
            expected=f"{LOWEST / SHARE:g} mm or more, and {LOWEST + COVER + clearance:g} mm "
            "under the deepest of the relief",
            found=f"{thickness:g} mm, and {floor:g} mm",
            where="thickness",
            hint="a thicker stock, a shallower relief, or a larger bed",
        )
    return height


def prism(at: Pair, across: bool, height: float, clearance: float | None) -> manifold3d.Manifold:
    """Stand a tongue on Z0, or what cuts its notch.

    Parameters
    ----------
    at : tuple of float
        (X, Y) of its middle on the seam, mm.
    across : bool
        Whether the seam runs along X: the tongue points to +Y, else to +X.
    height : float
        mm.
    clearance : float or None
        None for the tongue; mm for what cuts its notch, below Z0, too.

    Returns
    -------
    Manifold
    """
    grow, below = (0.0, 0.0) if clearance is None else (clearance, -BEYOND)
    lean, half = tan(radians(TAPER)), WIDTH / 2 + grow / cos(radians(TAPER))
    # The sides go on past the seam, so that they cross it and have no corner there.
    u = np.array([-BEYOND, LENGTH + grow, LENGTH + grow, -BEYOND])
    v = (half - u * lean) * [1.0, 1.0, -1.0, -1.0]
    plan = np.stack([v, u] if across else [u, v], axis=1) + at
    corners = [(x, y, z) for x, y in plan for z in (below, height + grow)]
    return manifold3d.Manifold.hull_points(corners)
