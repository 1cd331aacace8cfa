"""A seated cat with collar and earring, after the bronzes of the Late Period."""

from itertools import pairwise

import numpy as np

from relieffab.subject.canvas import Canvas, Mesh
from relieffab.subject.sdf import Field, Point, bezier, common, cone, ellipsoid, torus, union

SIZE = (76.0, 112.0, 30.0)
THROAT = (5.0, 25.0)  # where the collar hangs from, X and Y
COLLAR = (9.5, 19.5)  # its inner and outer radius, mm
TAIL = ((-22.0, -24.0), (-36.0, -44.0), (-20.0, -46.5), (2.0, -42.6))


def _trunk(p: Point) -> Field:
    """Shape body, chest and neck: one smooth bulk."""
    back = cone(p, (-11.0, -27.0, 9.0), (-1.0, 8.0, 10.0), (15.0, 9.5))
    chest = cone(p, (8.0, 6.0, 10.0), (6.0, -20.0, 10.0), (8.8, 9.0))
    neck = cone(p, (2.0, 8.0, 10.0), (6.5, 28.0, 10.5), (10.0, 6.8))
    return union(union(back, chest, 9.0), neck, 7.0)


def _collar(p: Point) -> Field:
    """Lay a broad collar of four rows of beads round the neck."""
    x, y = p.x - THROAT[0], p.y - THROAT[1]
    away = np.hypot(x, y)
    angle = np.arctan2(x, -y)
    row = (away - COLLAR[0]) / (COLLAR[1] - COLLAR[0]) * 4
    beads = np.cos(2 * np.pi * row) - 0.6 * np.cos(44 * angle) * (row > 2) * (row < 3)
    shell = _trunk(p) - 1.1 + 0.28 * beads
    band = np.maximum(COLLAR[0] - away, away - COLLAR[1])
    return common(common(shell, band, 0.4), -(p.y - (THROAT[1] - 5.0)) * -1.0, 0.4)


def _head(p: Point) -> Field:
    """Shape skull, muzzle and brow."""
    skull = ellipsoid(p, (7.5, 35.4, 11.0), (11.0, 9.6, 9.8))
    muzzle = ellipsoid(p, (15.6, 31.4, 11.0), (5.2, 4.8, 6.6))
    head = union(skull, muzzle, 3.5)
    mouth = np.hypot(p.y - 29.9 + 0.16 * (p.x - 15.0), 0.8 * np.maximum(14.0 - p.x, 0))
    head = head + 0.6 * np.exp(-((mouth / 0.6) ** 2))
    nose = ellipsoid(p, (19.9, 33.8, 11.0), (1.5, 1.5, 3.2))
    return union(head, nose, 0.8)


def _eye(p: Point) -> Field:
    """Shape an eye within its lid, the outer corner drawn out."""
    ball = ellipsoid(p, (11.2, 36.8, 18.6), (3.0, 2.0, 2.0))
    lid = [(15.4, 35.2), (13.2, 39.4), (9.4, 39.6), (3.6, 36.2)]
    under = [(15.4, 35.2), (12.6, 33.6), (9.4, 34.2), (3.6, 36.2)]
    solid = ball
    for course in (lid, under):
        path = bezier(course, np.linspace(0, 1, 9))
        for (ax, ay), (bx, by) in pairwise(path.tolist()):
            solid = union(solid, cone(p, (ax, ay, 19.6), (bx, by, 19.6), (0.75, 0.75)))
    return solid


def _ear(p: Point, foot: float, z: float) -> Field:
    """Shape an ear that stands up, hollow to the front."""
    outer = cone(p, (foot, 39.0, z), (foot - 2.2, 52.0, z - 0.5), (6.4, 0.9))
    inner = cone(p, (foot + 1.2, 40.0, z + 5.4), (foot - 1.6, 50.5, z + 1.6), (4.2, 0.5))
    return common(outer, -inner, 0.5)


def _limb(p: Point, joints: list[tuple[float, ...]]) -> Field:
    """Shape a leg from joints: X, Y, Z and radius."""
    solid: Field = np.full((), np.inf, np.float32)
    for a, b in pairwise(joints):
        solid = union(solid, cone(p, a[:3], b[:3], (a[3], b[3])), 1.0)
    return solid


def _foreleg(p: Point, x: float, z: float) -> Field:
    leg = _limb(
        p,
        [(x - 2.0, -6.0, z - 1.0, 6.2), (x + 0.5, -24.0, z, 4.2), (x + 0.8, -40.5, z, 3.5)],
    )
    shoulder = ellipsoid(p, (x - 4.0, -3.0, z - 2.5), (9.0, 14.0, 8.5))
    paw = ellipsoid(p, (x + 4.4, -42.6, z), (6.4, 3.3, 4.4))
    toes = 0.35 * np.exp(-((np.sin((p.z - z) * 1.5) / 0.35) ** 2)) * (p.x > x + 5.0)
    return union(union(leg, shoulder, 4.0), paw, 2.5) + toes


def _haunch(p: Point) -> Field:
    """Shape thigh and hind paw."""
    thigh = ellipsoid(p, (-8.0, -27.5, 14.0), (15.5, 16.5, 9.5))
    paw = cone(p, (-6.0, -41.5, 17.0), (9.5, -42.6, 17.0), (3.8, 3.4))
    return union(thigh, paw, 3.0)


def _tail(p: Point) -> Field:
    path = bezier(TAIL, np.linspace(0, 1, 41))
    high = np.linspace(10.0, 21.5, 41)
    wide = np.linspace(3.6, 2.4, 41)
    solid: Field = np.full((), np.inf, np.float32)
    for k in range(40):
        a, b = (*path[k], high[k]), (*path[k + 1], high[k + 1])
        solid = union(solid, cone(p, a, b, (float(wide[k]), float(wide[k + 1]))))
    return solid


def _plinth(p: Point) -> Field:
    """Lay the slab that it sits on."""
    x, y = np.abs(p.x + 4.0) - 31.0, np.abs(p.y + 48.6) - 2.6
    return common(common(x + 0 * p.y, y + 0 * p.x, 0.8) + 0 * p.z, p.z - 23.0, 0.8)


def cat(*, cell: float = 0.3) -> Mesh:
    """Model a cat that sits and looks to the right.

    Parameters
    ----------
    cell : float
        Side of the grid cells it is meshed from, mm.

    Returns
    -------
    vertices : (v, 3) ndarray
        mm; X right, Y up, Z to the viewer, the flat back on Z = 0; some 66 x 106 x 26 mm.
    faces : (f, 3) ndarray of int64
        Counter-clockwise seen from outside; closed.
    """
    canvas = Canvas(SIZE, cell, mirrored=False)
    canvas.draw(lambda p: _foreleg(p, 13.5, 5.5), (0, -47, 0), (26, 12, 14))
    canvas.draw(lambda p: _ear(p, 10.5, 6.0), (3, 33, 0), (18, 55, 12))
    canvas.draw(_trunk, (-28, -46, 0), (20, 38, 26))
    canvas.draw(_head, (-4, 24, 0), (25, 46, 22))
    canvas.draw(lambda p: _ear(p, 3.0, 14.5), (-5, 33, 5), (11, 55, 21))
    canvas.draw(_eye, (2, 31, 15), (18, 42, 23))
    canvas.draw(lambda p: _foreleg(p, 8.0, 14.5), (-6, -47, 2), (20, 12, 22), blend=3.0)
    canvas.draw(_collar, (-16, 2, 2), (26, 22, 26))
    canvas.draw(_haunch, (-26, -47, 2), (15, -9, 25))
    canvas.draw(_tail, (-36, -48, 2), (6, -20, 26))
    canvas.draw(lambda p: torus(p, (-2.2, 38.6, 19.0), 2.7, 0.75), (-7, 34, 17), (3, 43, 21))
    canvas.draw(_plinth, (-37, -53, 0), (30, -44, 25))
    return canvas.mesh()
