"""G2 and G3 as chords no further from the arc than the arc tolerance ($12)."""

import math
from collections.abc import Iterator

from relieffab.grbl.simulator.words import Refused

Point = tuple[float, ...]

_FULL = 5e-7


def centre_from_radius(
    du: float, dv: float, radius: float, *, clockwise: bool
) -> tuple[float, float]:
    """Offset from the start to the centre, for an end at (du, dv) and a signed radius R."""
    rest = 4.0 * radius * radius - du * du - dv * dv
    if rest < 0.0:
        raise Refused(34)
    h = -math.sqrt(rest) / math.hypot(du, dv)
    if not clockwise:
        h = -h
    if radius < 0.0:
        h = -h
    return 0.5 * (du - dv * h), 0.5 * (dv + du * h)


def check_ends(start: tuple[float, float], end: tuple[float, float]) -> None:
    """Refuse an arc whose ends are not equally far from the centre (error 33).

    `start` and `end` are relative to the centre; 5 um are always allowed, and 0.1 % of the
    radius up to 0.5 mm.
    """
    radius, other = math.hypot(*start), math.hypot(*end)
    off = abs(radius - other)
    if off > 0.005 and (off > 0.5 or off > 0.001 * radius):
        raise Refused(33)


def chords(
    start: Point, end: Point, offset: tuple[float, float], axes: tuple[int, int, int],
    *, clockwise: bool, tolerance: float,
) -> Iterator[Point]:  # fmt: skip
    """Yield the ends of the chords from `start` to `end` around `start + offset`."""
    u, v, _ = axes
    cu, cv = start[u] + offset[0], start[v] + offset[1]
    ru, rv = -offset[0], -offset[1]
    qu, qv = end[u] - cu, end[v] - cv
    sweep = math.atan2(ru * qv - rv * qu, ru * qu + rv * qv)
    if clockwise:
        sweep -= math.tau if sweep >= -_FULL else 0.0
    else:
        sweep += math.tau if sweep <= _FULL else 0.0
    radius = math.hypot(ru, rv)
    sagitta = math.sqrt(tolerance * max(2.0 * radius - tolerance, tolerance))
    count = int(abs(0.5 * sweep * radius) / sagitta)
    for step in range(1, count):
        angle = sweep * step / count
        c, s = math.cos(angle), math.sin(angle)
        point = [a + (b - a) * step / count for a, b in zip(start, end, strict=True)]
        point[u] = cu + ru * c - rv * s
        point[v] = cv + ru * s + rv * c
        yield tuple(point)
    yield end
