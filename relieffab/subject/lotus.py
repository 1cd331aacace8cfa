"""A lotus between two buds, as it stands on columns and friezes."""

from itertools import pairwise

import numpy as np

from relieffab.subject.canvas import Canvas, Mesh
from relieffab.subject.sdf import Field, Point, bezier, common, cone, ellipsoid, stroke, union

SIZE = (104.0, 104.0, 22.0)
HEART = (0.0, -4.0)  # where the petals spring from, X and Y

# Rows of petals from the back to the front: degrees from upright, mm long and wide, mm high.
BACK = (((14.0, 45.0), (41.0, 43.0), (66.0, 40.0)), 5.6, 6.0)
MIDDLE = (((0.0, 46.0), (28.0, 44.0), (54.0, 41.0)), 6.4, 9.0)
FRONT = (((13.0, 33.0), (40.0, 31.0)), 5.6, 12.0)
SEPALS = (((0.0, 27.0), (80.0, 36.0)), 6.2, 14.5)


def _petal(p: Point, angle: float, length: float, half: float, high: float) -> Field:
    """Shape a petal: pointed, hollowed to both sides of its midrib, its tip leaning out."""
    a = np.radians(angle)
    reach = np.linspace(0, 1, 9)
    # It leaves the heart upright and leans over on its way.
    lean = a * (0.82 + 0.18 * reach)
    course = np.stack([np.sin(lean), np.cos(lean)], axis=1) * (length * reach)[:, None]
    width = half * np.sin(np.pi * np.clip(0.10 + 0.90 * reach, 0, 1)) ** 0.75 + 0.25
    shape = stroke(p, course + HEART, width)
    w = np.clip(shape.across, -1.2, 1.2)
    along = shape.along / length
    top = high + 3.0 * along * along - 2.2 * w * w + 0.55 * np.exp(-((w / 0.13) ** 2))
    top = top - 0.25 * np.exp(-(((np.abs(w) - 0.5) / 0.10) ** 2))
    return common(shape.distance, (p.z - top) * 0.85, 0.5)


def _draw_row(canvas: Canvas, row: tuple[tuple[tuple[float, float], ...], float, float]) -> None:
    """Draw a row, the outer petals over the inner ones."""
    petals, half, high = row
    for k, (angle, length) in enumerate(petals):
        tip = np.array(HEART) + length * np.array(
            [np.sin(np.radians(angle)), np.cos(np.radians(angle))]
        )
        low = np.minimum(HEART, tip) - half - 3
        upper = np.maximum(HEART, tip) + half + 3
        lift = high + 0.9 * k
        canvas.draw(
            lambda p, a=angle, n=length, z=lift: _petal(p, a, n, half, z),  # type: ignore[misc]
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
    """Shape a closed bud that leans outwards: three leaves laid over each other."""
    foot, tip = np.array([34.0, 4.0]), np.array([41.5, 30.0])
    reach = np.linspace(0, 1, 9)[:, None]
    course = foot + reach * (tip - foot) + np.array([1.6, 0.0]) * np.sin(np.pi * reach)
    width = 7.2 * np.sin(np.pi * (0.14 + 0.86 * reach[:, 0])) ** 0.8 + 0.25
    shape = stroke(p, course, width)
    w = np.clip(shape.across, -1.2, 1.2)
    along = shape.along / 27.0
    top = 11.5 - 4.6 * w * w
    # The middle leaf lies over the others, whose edges meet behind its point.
    leaf = np.abs(w) - 0.58 * np.sqrt(np.clip(1.04 - along, 0, 1))
    top = top + 1.1 / (1 + np.exp(np.clip(leaf / 0.045, -30, 30)))
    top = top + 0.4 * np.exp(-((w / 0.10) ** 2))
    return common(shape.distance, (p.z - top) * 0.8, 0.5)


def _collar(p: Point) -> Field:
    """Bind the bud's foot."""
    return cone(p, (30.4, 5.6, 9.4), (36.6, 3.6, 9.4), (1.7, 1.7))


def _tie(p: Point) -> Field:
    """Tie the three stems together: five turns of a band."""
    solid: Field = np.full((), np.inf, np.float32)
    for k in range(5):
        y = -33.0 - 2.5 * k
        solid = union(solid, cone(p, (-6.6, y, 8.0), (6.6, y, 8.0), (1.45, 1.45)))
    return union(solid, common(np.abs(p.x) - 6.0 + 0 * p.y, np.abs(p.y + 38.0) - 6.0) + 0 * p.z)


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
    outer = [(33.8, 4.0), (30.0, -16.0), (8.0, -16.0), (4.2, -34.0), (5.0, -50.0)]
    canvas.draw(lambda p: _stem(p, outer, 1.9, 6.6), (2, -52, 0), (36, 6, 10))
    canvas.draw(lambda p: _stem(p, [(0, -14), (0, -50)], 2.2, 6.8), (0, -52, 0), (4, -12, 10))
    canvas.draw(_bud, (22, 0, 0), (52, 34, 16))
    canvas.draw(_collar, (28, 0, 0), (40, 9, 13))
    for row in (BACK, MIDDLE, FRONT, SEPALS):
        _draw_row(canvas, row)
    canvas.draw(_cup, (0, -18, 0), (9, 2, 19))
    canvas.draw(lambda p: common(_tie(p), p.z - 9.6, 0.3), (0, -46, 0), (9, -30, 11))
    return canvas.mesh()
