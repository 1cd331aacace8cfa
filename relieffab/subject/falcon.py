"""A standing falcon, after the statues of Horus at Edfu."""

from itertools import pairwise

import numpy as np

from relieffab.subject.canvas import Canvas, Mesh
from relieffab.subject.sdf import (
    Field,
    Point,
    bezier,
    common,
    cone,
    ellipsoid,
    stroke,
    torus,
    union,
)

SIZE = (76.0, 112.0, 30.0)
WING = ((3.0, 21.0), (-9.0, 12.0), (-17.0, -12.0), (-29.0, -43.0))
WING_WIDTH = (4.0, 10.5, 11.5, 8.5, 1.2)
TAIL = ((-12.0, -22.0), (-23.2, -46.4))
BEAK = ((12.5, 40.5, 4.4), (18.0, 41.5, 3.2), (21.0, 38.0, 2.0), (18.8, 33.6, 0.5))
SCALE = (5.2, 4.4)  # mm across and down of a feather on the breast


def _scales(across: Field, down: Field) -> Field:
    """Lay feathers like shingles: 0 at a feather's root, 1 at its rounded tip."""
    row = np.floor(down)
    x = (across + 0.5 * (row % 2)) % 1.0 - 0.5
    share = down - row
    edge = 1.0 - 1.6 * x * x
    # Beyond its own rounded tip the feather of the next row is seen.
    return np.where(share < edge, share / edge, (share - edge) * 0.5)


def _trunk(p: Point) -> Field:
    """Shape the body, breast and neck."""
    back = cone(p, (-1.0, 16.0, 9.5), (-9.0, -22.0, 8.0), (12.5, 7.5))
    breast = ellipsoid(p, (4.5, 6.0, 9.5), (12.5, 22.0, 11.0))
    neck = cone(p, (1.0, 20.0, 10.0), (5.0, 37.0, 10.5), (11.5, 8.6))
    return union(union(back, breast, 5.0), neck, 8.0)


def _body(p: Point) -> Field:
    """Lay feathers over the breast; they fade away towards the head."""
    tip = _scales(p.x / SCALE[0], (30.0 - p.y) / SCALE[1])
    fade = np.clip((26.0 - p.y) / 8.0, 0, 1)
    return _trunk(p) + fade * (0.45 - 0.8 * tip)


def _head(p: Point) -> Field:
    """Shape the head and its hooked beak."""
    head = ellipsoid(p, (6.2, 40.0, 10.5), (10.0, 8.6, 9.4))
    beak: Field = np.full((), np.inf, np.float32)
    for (ax, ay, ra), (bx, by, rb) in pairwise(bezier(BEAK, np.linspace(0, 1, 13)).tolist()):
        beak = union(beak, cone(p, (ax, ay, 10.5), (bx, by, 10.5), (ra, rb)), 0.3)
    lower = cone(p, (12.0, 37.0, 10.5), (16.4, 36.0, 10.5), (3.0, 1.4))
    gape = np.exp(-(((p.y - 38.2 + 0.12 * (p.x - 12.0)) / 0.45) ** 2)) * (p.x > 12.0)
    return union(head, union(beak, lower, 0.4) + 0.6 * gape, 1.5)


def _eye(p: Point) -> Field:
    """Shape the eye in its ring, the brow above and the mark of the falcon below."""
    eye = union(ellipsoid(p, (10.2, 41.2, 19.0), (2.0, 2.0, 1.7)), _ring(p))
    curves = (
        ([(15.0, 43.0, 0.7), (11.0, 46.4, 0.9), (5.0, 45.6, 0.8), (-1.0, 42.6, 0.4)], 19.2),
        ([(9.8, 38.6, 1.3), (9.6, 35.0, 1.4), (8.0, 33.4, 1.1), (8.6, 30.4, 0.4)], 18.6),
    )
    for course, high in curves:
        for (ax, ay, ra), (bx, by, rb) in pairwise(bezier(course, np.linspace(0, 1, 11)).tolist()):
            eye = union(eye, cone(p, (ax, ay, high), (bx, by, high), (ra, rb)), 0.2)
    return eye


def _ring(p: Point) -> Field:
    return torus(p, (10.2, 41.2, 19.2), 3.1, 0.8)


def _wing(p: Point) -> Field:
    """Shape the folded wing: shingled coverts, then long quills side by side."""
    course = bezier(WING, np.linspace(0, 1, 41))
    half = np.interp(np.linspace(0, 1, 41), np.linspace(0, 1, 5), WING_WIDTH)
    shape = stroke(p, course, half)
    length = float(np.linalg.norm(np.diff(course, axis=0), axis=1).sum())
    w, t = np.clip(shape.across, -1.1, 1.1), np.clip(shape.along / length, 0, 1.1)
    coverts = _scales(2.1 * w, 17.0 * t)
    quill = (2.6 * w + 0.9 * t) % 1.0
    quills = quill - 0.25 * np.exp(-(((quill - 0.55) / 0.07) ** 2))
    end = 0.47 - 0.10 * w * w
    covered = t < end
    ledge = np.where(covered, 1.5, 0.0)
    top = 20.0 - 4.0 * t - 2.6 * w * w + ledge
    top = top + np.where(covered, 0.9 * coverts, 0.9 * quills)
    return common(shape.distance, (p.z - top) * 0.8, 0.5)


def _tail(p: Point) -> Field:
    """Shape the tail: five feathers, cut off straight."""
    foot, tip = (np.array(end) for end in TAIL)
    length = float(np.hypot(*(tip - foot)))
    ux, uy = ((tip - foot) / length).tolist()
    along = (p.x - foot[0]) * ux + (p.y - foot[1]) * uy
    across = (p.x - foot[0]) * uy - (p.y - foot[1]) * ux
    wide = 5.0 + 2.0 * np.clip(along / length, 0, 1)
    outline = common(np.abs(across) - wide, np.abs(along - length / 2) - length / 2, 0.6)
    feather = (across / wide * 2.5 + 0.5) % 1.0
    top = 11.0 + 0.8 * feather - 0.06 * across * across
    return common(outline, (p.z - top) * 0.85, 0.5)


def _leg(p: Point, x: float, z: float) -> Field:
    """Shape a feathered thigh, the bare shank and a foot of three toes and a spur."""
    thigh = cone(p, (x - 3.0, -16.0, z - 1.5), (x + 0.6, -33.0, z), (9.0, 4.0))
    tip = _scales(p.x / SCALE[0], (30.0 - p.y) / SCALE[1])
    thigh = thigh + 0.4 - 0.7 * tip
    shank = cone(p, (x + 0.6, -33.0, z), (x + 1.2, -43.0, z), (2.9, 2.6))
    foot = union(thigh, shank, 1.0)
    for dx, dz in ((12.5, 2.5), (11.0, -1.5), (-6.0, 0.5)):
        end = (x + 1.2 + dx, -45.2, z + dz)
        foot = union(foot, cone(p, (x + 1.2, -43.6, z), end, (2.5, 1.5)), 1.0)
        claw = (x + 1.2 + dx * 1.24, -46.4, z + dz)
        foot = union(foot, cone(p, end, claw, (1.3, 0.4)), 0.3)
    return foot


def _plinth(p: Point) -> Field:
    """Lay the slab that it stands on."""
    slab = common(np.abs(p.x + 4.0) - 31.0, np.abs(p.y + 49.2) - 2.6, 0.8)
    return common(slab, p.z - 21.0, 0.8)


def falcon(*, cell: float = 0.3) -> Mesh:
    """Model a falcon that stands and looks to the right.

    Parameters
    ----------
    cell : float
        Side of the grid cells it is meshed from, mm.

    Returns
    -------
    vertices : (v, 3) ndarray
        mm; X right, Y up, Z to the viewer, the flat back on Z = 0; some 62 x 101 x 23 mm.
    faces : (f, 3) ndarray of int64
        Counter-clockwise seen from outside; closed.
    """
    canvas = Canvas(SIZE, cell, mirrored=False)
    canvas.draw(_tail, (-34, -54, 0), (-4, -16, 14))
    canvas.draw(lambda p: _leg(p, 7.0, 6.0), (-8, -48, 0), (25, -6, 16))
    canvas.draw(_body, (-24, -34, 0), (19, 46, 24))
    canvas.draw(lambda p: _leg(p, 2.0, 13.0), (-12, -48, 2), (20, -6, 24))
    canvas.draw(_head, (-6, 29, 0), (24, 50, 21), blend=2.0)
    canvas.draw(_eye, (-4, 29, 16), (18, 49, 22))
    canvas.draw(_wing, (-36, -46, 0), (14, 30, 25))
    canvas.draw(_plinth, (-37, -53, 0), (29, -45, 23))
    return canvas.mesh()
