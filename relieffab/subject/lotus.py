"""A lotus between two buds, as it stands on columns and friezes."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relieffab.subject.canvas import Canvas, Mesh
from relieffab.subject.sdf import Field, Point, bezier, common, cone, ellipsoid, union

Floats = NDArray[np.float64]

SIZE = (104.0, 110.0, 22.0)
HEART = (0.0, -4.0)  # where the petals spring from, X and Y

# Rows of petals from the back to the front: degrees from upright and mm long; mm wide, mm high.
BACK = (((10.0, 46.0), (30.0, 45.5), (50.0, 44.0), (69.0, 41.0)), 4.4, 5.5)
MIDDLE = (((0.0, 46.0), (20.0, 45.5), (40.0, 44.0), (60.0, 42.0)), 5.2, 8.0)
SEPALS = (((0.0, 45.0), (34.0, 44.0), (77.0, 43.0)), 7.4, 11.5)


def _blade(p: Point, foot: Floats, tip: Floats, half: float) -> tuple[Field, Field, Field]:
    """Lay out a pointed leaf: signed distance, share of its length, share of its half width."""
    length = float(np.hypot(*(tip - foot)))
    ux, uy = ((tip - foot) / length).tolist()
    x, y = p.x - foot[0], p.y - foot[1]
    t = np.clip((x * ux + y * uy) / length, 0.0, 1.0)
    # 0.55 of the way up it is widest, and 1 there.
    width = half * (t / 0.55) ** 0.66 * ((1 - t) / 0.45) ** 0.54 + 0.02
    across = x * uy - y * ux
    beyond = np.abs(x * ux + y * uy - t * length)
    away = np.hypot(np.maximum(np.abs(across) - width, 0), beyond)
    distance = np.where(away > 0, away, np.abs(across) - width) * 0.8
    return distance, t, np.clip(across / width, -1.2, 1.2)


def _petal(p: Point, tip: Floats, half: float, high: float) -> Field:
    """Shape a petal: hollowed to both sides of its midrib, its tip leaning out."""
    distance, t, w = _blade(p, np.array(HEART), tip, half)
    top = high + 3.4 * t * t - 2.4 * w * w + 0.6 * np.exp(-((w / 0.2) ** 2)) * (1 - t)
    top = top - 0.24 * np.exp(-(((np.abs(w) - 0.55) / 0.15) ** 2)) * np.clip(4 * (1 - t) * t, 0, 1)
    return common(distance, (p.z - top) * 0.85, 0.5)


def _draw_row(canvas: Canvas, row: tuple[tuple[tuple[float, float], ...], float, float]) -> None:
    """Draw a row, the outer petals over the inner ones."""
    petals, half, high = row
    for k, (angle, length) in enumerate(petals):
        a = np.radians(angle)
        tip = np.array(HEART) + length * np.array([np.sin(a), np.cos(a)])
        low, upper = np.minimum(HEART, tip) - half, np.maximum(HEART, tip) + half
        canvas.draw(
            lambda p, end=tip, z=high + 0.9 * k: _petal(p, end, half, z),  # type: ignore[misc]
            (*low, 0.0),
            (*upper, high + 9.0),
        )


def _cup(p: Point) -> Field:
    """Shape the cup below the petals, ringed where the stem begins."""
    cup = ellipsoid(p, (0.0, -5.5, 8.0), (8.2, 6.6, 9.4))
    rings = union(
        cone(p, (-3.6, -12.6, 9.0), (3.6, -12.6, 9.0), (1.5, 1.5)),
        cone(p, (-3.2, -15.6, 9.0), (3.2, -15.6, 9.0), (1.3, 1.3)),
    )
    return union(cup, rings)


def _stem(p: Point, path: list[tuple[float, float]], radius: float, high: float) -> Field:
    """Shape a stem along a Bézier curve."""
    solid: Field = np.full((), np.inf, np.float32)
    for (ax, ay), (bx, by) in pairwise(bezier(path, np.linspace(0, 1, 25)).tolist()):
        solid = union(solid, cone(p, (ax, ay, high), (bx, by, high), (radius, radius)))
    return solid


def _bud(p: Point) -> Field:
    """Shape a closed bud that leans outwards: a leaf laid over two others."""
    foot, tip = np.array([33.6, 2.0]), np.array([42.0, 34.0])
    distance, t, w = _blade(p, foot, tip, 7.2)
    top = 12.0 - 4.6 * w * w
    leaf = np.abs(w) - 0.62 * np.sqrt(np.clip(1.02 - t, 0, 1))
    top = top + 1.2 / (1 + np.exp(np.clip(leaf / 0.07, -30, 30)))
    top = top + 0.4 * np.exp(-((w / 0.16) ** 2))
    return common(distance, (p.z - top) * 0.8, 0.5)


def _collar(p: Point) -> Field:
    """Bind the bud's foot."""
    return cone(p, (30.4, 5.6, 9.4), (36.6, 3.6, 9.4), (1.7, 1.7))


def _tie(p: Point) -> Field:
    """Tie the three stems together: five turns of a band."""
    solid: Field = np.full((), np.inf, np.float32)
    for k in range(5):
        y = -33.0 - 2.5 * k
        solid = union(solid, cone(p, (-6.6, y, 8.0), (6.6, y, 8.0), (1.45, 1.45)))
    plate = common(np.abs(p.x) - 6.4, np.abs(p.y + 38.0) - 6.0)
    return union(solid, common(plate, p.z - 8.0))


def lotus(*, cell: float = 0.3) -> Mesh:
    """Model an open lotus and two buds on bound stems.

    Parameters
    ----------
    cell : float
        Side of the grid cells it is meshed from, mm.

    Returns
    -------
    vertices : (v, 3) ndarray
        mm; X right, Y up, Z to the viewer, the flat back on Z = 0; some 100 x 95 x 20 mm.
    faces : (f, 3) ndarray of int64
        Counter-clockwise seen from outside; closed.
    """
    canvas = Canvas(SIZE, cell)
    outer = [(33.8, 4.0), (30.0, -16.0), (8.0, -16.0), (3.6, -34.0), (9.0, -51.0)]
    canvas.draw(lambda p: _stem(p, outer, 1.9, 6.6), (2, -54, 0), (36, 6, 10))
    canvas.draw(lambda p: _stem(p, [(0, -14), (0, -50)], 2.2, 6.8), (0, -52, 0), (4, -12, 10))
    canvas.draw(_bud, (22, 0, 0), (54, 36, 16))
    canvas.draw(_collar, (28, 0, 0), (40, 9, 13))
    for row in (BACK, MIDDLE, SEPALS):
        _draw_row(canvas, row)
    canvas.draw(_cup, (0, -18, 0), (9, 2, 19))
    canvas.draw(_tie, (0, -46, 0), (9, -30, 11))
    return canvas.mesh()
