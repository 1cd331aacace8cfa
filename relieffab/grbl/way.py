"""The way of one line of a program: straight pieces, arcs cut into chords."""

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from relieffab.grbl.modal import Modal

SAG = 0.01
"""mm that a chord may lie inside its arc."""
FULL_CIRCLE_BELOW = 5e-7
"""Radians of an arc that ends where it begins, within rounding."""

Place = tuple[float | None, ...]
"""X, Y, Z in work coordinates, mm, and A, degrees, if there is one; None where not known."""

_PLANES = {17.0: (0, 1, 2), 18.0: (2, 0, 1), 19.0: (1, 2, 0)}


class Motion(NamedTuple):
    """One line's way.

    Parameters
    ----------
    start : tuple
    points : tuple of tuple
        Ends of its straight pieces; arcs are cut every degree, large ones more often.
    length : float
        mm, over the axes that are known; a degree counts as one, as controllers have it.
    feed : float
        mm/min; inf for a rapid.
    """

    start: Place
    points: tuple[Place, ...]
    length: float
    feed: float

    @property
    def known(self) -> bool:
        """True where it begins and ends at known places."""
        return None not in self.start and None not in self.points[-1]

    @property
    def cutting(self) -> bool:
        """True for G1, G2, G3."""
        return self.feed != math.inf


def arc(modal: Modal, start: Place, end: Place, centre: Mapping[str, float]) -> Iterator[Place]:
    """Points along an arc, a degree and `SAG` apart at most, the end point last.

    Parameters
    ----------
    modal : Modal
        With G2 or G3 in force.
    start, end : tuple
        Known on every axis.
    centre : mapping of str to float
        The words I, J, K or R, in the units of the program.
    """
    u, v, _ = _PLANES[modal.plane]
    scale = modal.scale
    a, b = [float(x or 0.0) for x in start], [float(x or 0.0) for x in end]
    clockwise = modal.motion == 2
    if "R" in centre:
        radius = centre["R"] * scale * (1 if clockwise else -1)
        cu, cv = _centre(a[u], a[v], b[u], b[v], radius)
    else:
        cu = a[u] + centre.get("IJK"[u], 0.0) * scale
        cv = a[v] + centre.get("IJK"[v], 0.0) * scale
    radius = math.hypot(a[u] - cu, a[v] - cv)
    begin = math.atan2(a[v] - cv, a[u] - cu)
    turn = -1.0 if clockwise else 1.0
    sweep = turn * (math.atan2(b[v] - cv, b[u] - cu) - begin) % math.tau
    sweep = turn * (sweep if sweep > FULL_CIRCLE_BELOW else math.tau)
    steps = max(1, math.ceil(abs(sweep) / _step(radius)))
    for step in range(1, steps):
        angle = begin + sweep * step / steps
        point = [p + (q - p) * step / steps for p, q in zip(a, b, strict=True)]
        point[u] = cu + radius * math.cos(angle)
        point[v] = cv + radius * math.sin(angle)
        yield tuple(point)
    yield end


def _step(radius: float) -> float:
    """Angle of a chord that leaves the arc by `SAG` at most, radians."""
    return min(math.radians(1), math.sqrt(8 * SAG / radius)) if radius else math.radians(1)


def _centre(x0: float, y0: float, x1: float, y1: float, radius: float) -> tuple[float, float]:
    """Centre of the arc of signed radius: to the right of the chord where positive."""
    chord = math.hypot(x1 - x0, y1 - y0) or 1.0
    away = math.sqrt(max(radius**2 - chord**2 / 4, 0.0)) * math.copysign(1.0, radius)
    return (
        (x0 + x1) / 2 + away * (y1 - y0) / chord,
        (y0 + y1) / 2 - away * (x1 - x0) / chord,
    )


def length_of(start: Place, points: tuple[Place, ...]) -> float:
    """Length of a polyline, over the axes known at both ends of each piece, mm."""
    total, a = 0.0, start
    for b in points:
        square = 0.0
        for p, q in zip(a, b, strict=True):
            if p is not None and q is not None:
                square += (q - p) ** 2
        total += math.sqrt(square)
        a = b
    return total
