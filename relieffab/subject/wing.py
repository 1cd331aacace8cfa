"""The scarab's right wing: rows of feathers laid like shingles below a rounded arm."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relieffab.subject.canvas import Canvas
from relieffab.subject.sdf import Field, Point, bezier, common, cone, stroke

Floats = NDArray[np.float64]

# The arm: out from the shoulder, then up beside the sun; X, Y, Z and half its width, mm.
ARM = (
    (8.0, 5.5, 4.6, 2.1),
    (20.0, -4.5, 7.8, 2.9),
    (36.5, -3.0, 8.0, 2.4),
    (41.0, 20.5, 8.2, 1.4),
)
# Where feathers point, degrees from X, and how long the longest are, mm, along the arm.
AT = (0.0, 0.25, 0.5, 0.75, 1.0)
DIRECTION = (-88.0, -70.0, -38.0, 12.0, 68.0)
LENGTH = (20.0, 20.5, 19.5, 18.0, 18.5)
BEND = 26.0


@dataclass(frozen=True)
class Row:
    """One row of feathers.

    Parameters
    ----------
    count : int
        Feathers in the row.
    reach : float
        Length as a share of the longest.
    height : float
        Of the feathers' tips above the back, mm.
    shift : float
        Along the arm, in feathers.
    shaft : float
        Height of the ridge along the middle, mm.
    """

    count: int
    reach: float
    height: float
    shift: float
    shaft: float


ROWS = (
    Row(count=16, reach=1.0, height=3.2, shift=0.0, shaft=0.45),
    Row(count=16, reach=0.58, height=5.0, shift=0.5, shaft=0.0),
    Row(count=19, reach=0.31, height=6.8, shift=0.0, shaft=0.0),
)
# The wing rises to the viewer away from the body, by this much for a mm squared, mm.
RISE = 0.0011


def quills(row: Row) -> Floats:
    """Courses of a row's feathers, root to tip.

    Returns
    -------
    ndarray (count, 6, 2)
        X and Y, mm.
    """
    t = (np.arange(row.count) + row.shift) / (row.count - 1 + 2 * row.shift)
    root = bezier(ARM, t)[:, :2]
    length = row.reach * np.interp(t, AT, LENGTH)
    angle = np.radians(np.interp(t, AT, DIRECTION))
    bend = np.radians(BEND) * row.reach
    steps = np.linspace(0, 1, 6)
    # A circular arc through the angle `bend`, its middle in the feather's direction.
    turn = angle[:, None] + bend * (steps[None, 1:] - 0.6)
    strides = length[:, None, None] / 5 * np.stack([np.cos(turn), np.sin(turn)], axis=2)
    return root[:, None] + np.concatenate(
        [np.zeros((row.count, 1, 2)), np.cumsum(strides, axis=1)], axis=1
    )


def half_widths(courses: Floats) -> Floats:
    """Half the feathers' widths along their courses, so that neighbours overlap.

    Parameters
    ----------
    courses : (n, k, 2) ndarray

    Returns
    -------
    ndarray (n, k)
        mm.
    """
    gaps = np.linalg.norm(np.diff(courses, axis=0), axis=2)
    gaps = np.concatenate([gaps[:1], (gaps[:-1] + gaps[1:]) / 2, gaps[-1:]])
    half = np.clip(0.62 * gaps, 0.9, 3.0)
    half[:, 0] *= 0.7
    return half


def _feather(p: Point, course: Floats, half: Floats, row: Row) -> Field:
    """Shape one feather: an upright slab under a cambered, tilted, ribbed top."""
    shape = stroke(p, course, half)
    u, w = shape.along, np.clip(shape.across, -1.2, 1.2)
    length = float(np.linalg.norm(np.diff(course, axis=0), axis=1).sum())
    middle = w * (float(half[-1]) / 0.5)
    top = row.height + RISE * (p.x * p.x + p.y * p.y)
    top = top + 0.06 * (u - length) - 0.35 * w * w + 0.6 * w
    top = top + row.shaft * np.exp(-middle * middle) * np.clip((length - u) / 2, 0, 1)
    return common(shape.distance, (p.z - top) * 0.93, 0.6)


def draw_wing(canvas: Canvas) -> None:
    """Draw the wing at X > 0."""
    for row in ROWS:
        courses = quills(row)
        for course, half in zip(courses, half_widths(courses), strict=True):
            low, high = course.min(axis=0) - half.max(), course.max(axis=0) + half.max()
            canvas.draw(
                lambda p, c=course, h=half, r=row: _feather(p, c, h, r),  # type: ignore[misc]
                (*low, 0.0),
                (*high, row.height + 7.0),
            )
    _draw_arm(canvas)


def _draw_arm(canvas: Canvas) -> None:
    course = bezier(ARM, np.linspace(0, 1, 25))
    for start, end in pairwise(course):
        a, b, radii = start[:3], end[:3], (float(start[3]), float(end[3]))
        canvas.draw(
            lambda p, a=a, b=b, r=radii: cone(p, a, b, r),  # type: ignore[misc]
            np.minimum(a, b) - max(radii),
            np.maximum(a, b) + max(radii),
        )
