"""The scarab itself: wing cases, shield, head and six legs."""

from collections.abc import Sequence

import numpy as np

from relieffab.subject.canvas import Canvas
from relieffab.subject.sdf import Field, Point, cone, ellipsoid, groove, stroke, union

ELYTRA = ((1.0, -9.5, 1.0), (13.0, 17.0, 12.6))
SHIELD = ((0.0, 5.4, 1.0), (13.2, 8.6, 11.2))
HEAD = ((0.0, 12.6, 2.5), (7.6, 4.6, 6.3))
STRIAE = 6

Joint = tuple[float, float, float]


def _elytra(p: Point) -> Field:
    """Two wing cases with a seam between them, furrowed from end to end."""
    (cx, cy, cz), (rx, ry, rz) = ELYTRA
    solid = ellipsoid(p, ELYTRA[0], ELYTRA[1])
    # Furrows follow meridians of the ellipsoid: they meet at its two ends.
    x, z = (p.x - cx) / rx, np.maximum(p.z - cz, 0) / rz
    meridian = np.arctan2(x, z + 1e-6) / (np.pi / 2)
    girth = np.sqrt(np.clip(1 - ((p.y - cy) / ry) ** 2, 0, 1))
    fade = np.clip((girth - 0.35) / 0.35, 0, 1) * np.clip((p.x - 4.3) / 1.2, 0, 1)
    furrow = 0.5 - 0.5 * np.cos(meridian * (2 * np.pi * STRIAE))
    seam = 0.9 * np.exp(-((p.x / 0.7) ** 2))
    return solid + 0.55 * fade * furrow**3 + seam


def _shield(p: Point) -> Field:
    """Shape the pronotum: a broad dome with a fine furrow before and behind."""
    (_, cy, cz), (_, ry, rz) = SHIELD
    lean = np.arctan2((p.y - cy) / ry, np.maximum(p.z - cz, 0.1) / rz)
    furrows = np.exp(-(((lean - 0.9) / 0.07) ** 2)) + np.exp(-(((lean + 0.26) / 0.06) ** 2))
    return ellipsoid(p, *SHIELD) + 0.35 * furrows


def _body(p: Point) -> Field:
    """Wing cases and shield, a furrow between them."""
    elytra, shield = _elytra(p), _shield(p)
    parted = groove(elytra, ellipsoid(p, *SHIELD) - 0.8, 1.0, 0.3)
    return union(parted, shield)


def _head(p: Point) -> Field:
    """Shape the head: a flat shovel with six teeth along its rim."""
    (x, y, z), _ = HEAD
    head = ellipsoid(p, *HEAD)
    for angle in (13.0, 39.0, 65.0):
        a = np.radians(angle)
        foot = (x + 5.0 * np.sin(a), y + 2.6 * np.cos(a), z + 1.8)
        tip = (x + 8.6 * np.sin(a), y + 5.7 * np.cos(a), z + 1.2)
        head = union(head, cone(p, foot, tip, (2.3, 0.65)), 0.5)
    brow = stroke(p, ((0.0, 15.0), (2.6, 14.8), (4.8, 14.0), (6.6, 12.6)), (0.5,) * 4).across
    head = head + 0.45 * np.exp(-(brow**2))
    return union(head, ellipsoid(p, (6.9, 12.6, 6.0), (1.6, 1.6, 1.6)), 0.3)


def _limb(p: Point, joints: Sequence[Joint], bones: Sequence[tuple[float, float, float]]) -> Field:
    """Shape a leg from its joints; each bone has radii at its start, swell and end."""
    solid: Field = np.full((), np.inf, np.float32)
    for start, end, radii in zip(joints[:-1], joints[1:], bones, strict=True):
        a, b = np.array(start), np.array(end)
        swell = a + 0.42 * (b - a)
        for c, d, ends in ((a, swell, radii[:2]), (swell, b, radii[1:])):
            solid = union(solid, cone(p, c, d, ends), 0.5)
    return solid


def _foreleg(p: Point) -> Field:
    """Shape the leg that is raised to the sun; its shin carries four teeth."""
    knee, wrist = (18.0, 14.8, 7.6), (14.8, 26.0, 8.0)
    leg = _limb(
        p,
        ((8.0, 8.5, 4.0), knee, wrist, (12.7, 30.2, 8.2), (9.9, 33.4, 7.6)),
        ((2.0, 2.9, 1.5), (1.3, 1.7, 1.7), (0.8, 1.0, 0.8), (0.8, 0.9, 0.6)),
    )
    for s in (0.3, 0.53, 0.76, 0.99):
        foot = tuple(a + s * (b - a) for a, b in zip(knee, wrist, strict=True))
        tip = (foot[0] + 3.1, foot[1] + 1.6, foot[2] - 0.8)
        leg = union(leg, cone(p, foot, tip, (1.3, 0.5)), 0.5)
    return leg


def _midleg(p: Point) -> Field:
    return _limb(
        p,
        (
            (9.0, -7.0, 4.0),
            (20.5, -13.5, 7.6),
            (23.0, -23.5, 6.8),
            (26.0, -28.0, 6.4),
            (26.5, -32.0, 6.0),
        ),
        ((1.9, 2.8, 1.5), (1.3, 1.7, 1.2), (0.8, 1.0, 0.8), (0.8, 0.8, 0.55)),
    )


def _hindleg(p: Point) -> Field:
    return _limb(
        p,
        (
            (6.0, -17.0, 4.0),
            (15.8, -23.0, 7.2),
            (12.6, -31.8, 6.6),
            (8.8, -35.0, 6.2),
            (4.6, -36.4, 6.2),
        ),
        ((2.0, 3.0, 1.6), (1.3, 1.8, 1.2), (0.8, 1.0, 0.8), (0.8, 0.9, 0.6)),
    )


def draw_beetle(canvas: Canvas) -> None:
    """Draw the right half of the animal."""
    canvas.draw(_foreleg, (5, 5, 0), (23, 36, 11))
    canvas.draw(_midleg, (6, -34, 0), (28, -3, 11))
    canvas.draw(_hindleg, (3, -39, 0), (19, -13, 11))
    canvas.draw(_head, (0, 7, 0), (11, 20, 10))
    canvas.draw(_body, (0, -28, 0), (15, 15, 17))
