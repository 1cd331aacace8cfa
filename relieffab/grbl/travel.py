"""How far a program cuts and where it goes, followed line by line for progress and checks.

Not an interpreter: just enough modal state (G0-G3, G17-G21, G90/G91, I J K R) to add up
millimetres and keep bounds.  Where a program does what cannot be followed (G28, G53, G92,
G10, other work coordinate systems), the lengths go on from the next named position and
`certain` turns False.
"""

import math
import re
from collections.abc import Iterator
from itertools import pairwise

WORD = re.compile(r"([A-Z])([-+]?[\d.]+)")
MM_PER_INCH = 25.4
FULL_CIRCLE_BELOW = 5e-7
"""Radians of an arc that ends where it begins, within rounding."""

_PLANES = {17.0: (0, 1, 2), 18.0: (2, 0, 1), 19.0: (1, 2, 0)}
_UNFOLLOWED = {10.0, 28.0, 28.1, 30.0, 30.1, 43.1, 53.0, 92.0, 92.1, *map(float, range(55, 60))}
_AWAY = {28.0, 30.0, 53.0, 92.0, 92.1}


class Tracker:
    """Position, bounds and length of cut of the lines followed so far.

    Attributes
    ----------
    low, high : list of 3 (float or None)
        Bounds of the named positions in work coordinates, mm; None on an axis never named.
    certain : bool
        False once a line could not be followed, so that the bounds may be wrong.
    """

    def __init__(self) -> None:
        self.low: list[float | None] = [None, None, None]
        self.high: list[float | None] = [None, None, None]
        self.certain = True
        self._position: list[float | None] = [None, None, None]
        self._motion = 0.0
        self._scale = 1.0
        self._relative = False
        self._plane = (0, 1, 2)

    def follow(self, line: str) -> float:
        """Follow one clean line; return its length of cut (G1, G2, G3), mm."""
        axes: dict[int, float] = {}
        centre: dict[str, float] = {}
        away = False
        for letter, text in WORD.findall(line):
            value = float(text)
            if letter == "G":
                self._modal(value)
                away = away or value in _AWAY
            elif letter in "XYZ":
                axes["XYZ".index(letter)] = value
            elif letter in "IJKR":
                centre[letter] = value * self._scale
        if not axes and not centre:
            return 0.0
        if away:
            self._forget(axes)
            return 0.0
        return self._move({axis: value * self._scale for axis, value in axes.items()}, centre)

    def _modal(self, code: float) -> None:
        if code in (0, 1, 2, 3):
            self._motion = code
        elif code in _PLANES:
            self._plane = _PLANES[code]
        elif code in (20, 21):
            self._scale = MM_PER_INCH if code == 20 else 1.0
        elif code in (90, 91):
            self._relative = code == 91
        elif code in _UNFOLLOWED:
            self.certain = False

    def _forget(self, axes: dict[int, float]) -> None:
        for axis in axes or range(3):
            self._position[axis] = None

    def _move(self, axes: dict[int, float], centre: dict[str, float]) -> float:
        start, end = self._position, list(self._position)
        for axis, value in axes.items():
            base = start[axis] if self._relative else 0.0
            if base is None:
                self.certain = False
            else:
                end[axis] = base + value
        arc = self._motion >= 2 and None not in start and None not in end
        points = list(self._arc(start, end, centre)) if arc else [end]
        for point in points:
            self._enclose(point)
        self._position = end
        if self._motion == 0:
            return 0.0
        return _length([start, *points])

    def _enclose(self, point: list[float | None]) -> None:
        for axis, value in enumerate(point):
            if value is None:
                continue
            low, high = self.low[axis], self.high[axis]
            self.low[axis] = value if low is None or value < low else low
            self.high[axis] = value if high is None or value > high else high

    def _arc(
        self, start: list[float | None], end: list[float | None], centre: dict[str, float]
    ) -> Iterator[list[float | None]]:
        """Points along an arc, 2 degrees apart at most, the end point last."""
        u, v, w = self._plane
        a, b = [float(x or 0.0) for x in start], [float(x or 0.0) for x in end]
        clockwise = self._motion == 2
        if "R" in centre:
            cu, cv = _centre(a[u], a[v], b[u], b[v], centre["R"] * (1 if clockwise else -1))
        else:
            cu = a[u] + centre.get("IJK"[u], 0.0)
            cv = a[v] + centre.get("IJK"[v], 0.0)
        radius = math.hypot(a[u] - cu, a[v] - cv)
        begin = math.atan2(a[v] - cv, a[u] - cu)
        turn = -1.0 if clockwise else 1.0
        sweep = turn * (math.atan2(b[v] - cv, b[u] - cu) - begin) % math.tau
        sweep = turn * (sweep if sweep > FULL_CIRCLE_BELOW else math.tau)
        steps = max(1, math.ceil(abs(sweep) / math.radians(2)))
        for step in range(1, steps):
            angle = begin + sweep * step / steps
            point: list[float | None] = [None, None, None]
            point[u] = cu + radius * math.cos(angle)
            point[v] = cv + radius * math.sin(angle)
            point[w] = a[w] + (b[w] - a[w]) * step / steps
            yield point
        yield list(end)


def _centre(x0: float, y0: float, x1: float, y1: float, radius: float) -> tuple[float, float]:
    """Centre of the arc of signed radius: to the right of the chord where positive."""
    chord = math.hypot(x1 - x0, y1 - y0) or 1.0
    away = math.sqrt(max(radius**2 - chord**2 / 4, 0.0)) * math.copysign(1.0, radius)
    return (
        (x0 + x1) / 2 + away * (y1 - y0) / chord,
        (y0 + y1) / 2 - away * (x1 - x0) / chord,
    )


def _length(points: list[list[float | None]]) -> float:
    """Length of a polyline, over the axes known at both ends of each piece, mm."""
    total = 0.0
    for a, b in pairwise(points):
        total += math.sqrt(
            sum((q - p) ** 2 for p, q in zip(a, b, strict=True) if p is not None and q is not None)
        )
    return total
