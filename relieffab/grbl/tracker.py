"""Where a program goes, followed line by line: for bounds, for progress, for finding the tool.

Not an interpreter: just enough modal state to place every move.  Where a program goes to
places it does not name in work coordinates (G28, G30, G53, probing), positions go on from the
next named one and `certain` turns False.  Where it moves work zero (G10, G92, tool lengths,
other work coordinate systems), `followed` does, too; G49 and G92.1 are taken to find nothing
to clear, which `Controller.cleared_by` knows.
"""

import math
import re
from dataclasses import replace
from typing import Any

from relieffab.grbl.messages import AXES
from relieffab.grbl.modal import Modal
from relieffab.grbl.way import Motion, Place, arc, length_of

WORD = re.compile(r"([A-Z])([-+]?[\d.]+)")
_PLAIN = re.compile(r"(?:G([01]))?(?:X([-\d.]+))?(?:Y([-\d.]+))?(?:Z([-\d.]+))?(?:F([\d.]+))?")
_LENGTHS = 3
_PLAIN_LETTERS = "LNPT"
_SHIFT = 92.0
_PROBING = {38.2, 38.3, 38.4, 38.5}
_AWAY = {28.0, 30.0, 53.0, *_PROBING}
_UNFOLLOWED = {10.0, 28.1, 30.1, 43.1, _SHIFT, *map(float, range(55, 60))}


class Tracker:
    """The state after the lines followed so far.

    Parameters
    ----------
    position : tuple, optional
        Where the tool is before the first line.

    Attributes
    ----------
    modal : Modal
    position : tuple
    low, high : list of (float or None)
        Bounds of the named positions; None on an axis never named.  Like the position, they
        have A once a line names it.
    certain : bool
        False once a line went somewhere unknown, so that the bounds may be wrong.
    followed : bool
        False once work zero was moved, so that positions may be wrong for good.
    plunge : float
        Slowest feed of a descending cut so far, mm/min; inf where there was none.
    fastest_spindle : float
        Highest S named, rpm.
    codes : set of str
        G and M words met so far, such as ``G54``, and letters beyond Grbl's own, such as ``A``.
    """

    def __init__(self, position: Place = (None, None, None)) -> None:
        self.modal = Modal()
        self.position = position
        self.low: list[float | None] = [None] * len(position)
        self.high: list[float | None] = [None] * len(position)
        self.certain = self.followed = True
        self.plunge = math.inf
        self.fastest_spindle = 0.0
        self.codes: set[str] = set()
        self._simple = False

    def follow(self, line: str) -> Motion | None:
        """Follow one clean line; None where it does not move."""
        if self._simple and (match := _PLAIN.fullmatch(line)):
            return self._straight(*match.groups())
        motion = self._any(line)
        modal = self.modal
        self._simple = (
            (modal.units, modal.distance, modal.feed_mode) == (21, 90, 94)
            and modal.motion in (0, 1)
            and None not in (*self.position, *self.low[:3])
        )
        return motion

    def _straight(
        self, g: str | None, x: str | None, y: str | None, z: str | None, f: str | None
    ) -> Motion | None:
        """Follow the commonest kind of line: a straight move in absolute millimetres."""
        if g is not None and float(g) != self.modal.motion:
            self.modal = replace(self.modal, motion=float(g))
        if f is not None:
            self.modal = replace(self.modal, feed=float(f))
        start: Any = self.position
        if x is y is z is None:
            return None
        a, b, c, *turn = start
        goal = (
            a if x is None else float(x),
            b if y is None else float(y),
            c if z is None else float(z),
            *turn,
        )
        self.position = goal
        low: Any = self.low
        high: Any = self.high
        for axis in range(3):
            value = goal[axis]
            if value < low[axis]:
                low[axis] = value
            elif value > high[axis]:
                high[axis] = value
        length = math.dist(start, goal)
        feed = self.modal.feed if self.modal.motion else math.inf
        if goal[2] < c and 0 < feed < self.plunge:
            self.plunge = feed
        return Motion(start, (goal,), length, feed)

    def _any(self, line: str) -> Motion | None:
        axes: dict[int, float] = {}
        centre: dict[str, float] = {}
        away = shifts = False
        if line.startswith("$"):
            return None
        for letter, text in WORD.findall(line):
            value = float(text)
            if letter in "XYZ":
                axes["XYZ".index(letter)] = value
            elif letter == "G":
                self.codes.add(f"G{value:g}")
                self.modal = self.modal.with_g(value)
                self.followed = self.followed and value not in _UNFOLLOWED
                away = away or value in _AWAY
                shifts = shifts or value == _SHIFT
            elif letter in "IJKR":
                centre[letter] = value
            elif letter == "F":
                self.modal = replace(self.modal, feed=value)
            elif letter == "S":
                self.modal = replace(self.modal, speed=value)
                self.fastest_spindle = max(self.fastest_spindle, value)
            elif letter == "M":
                self.codes.add(f"M{value:g}")
                self.modal = self.modal.with_m(value)
            elif letter not in _PLAIN_LETTERS:
                self.codes.add(letter)
                if letter == "A":
                    axes[self._turning()] = value
        away = away or (bool(axes) and self.modal.motion in _PROBING)
        self.certain = self.certain and self.followed and not away
        if away or shifts:
            return self._forget(axes)
        return self._move(axes, centre) if axes or centre else None

    def _turning(self) -> int:
        """Take the rotary axis on; give its place."""
        if len(self.position) < AXES:
            self.position = (*self.position, None)
        if len(self.low) < AXES:
            self.low, self.high = [*self.low, None], [*self.high, None]
        return AXES - 1

    def _forget(self, axes: dict[int, float]) -> Motion:
        """Go somewhere unknown, on the axes named or on all."""
        start = self.position
        self.position = tuple(None if not axes or a in axes else p for a, p in enumerate(start))
        return Motion(start, (self.position,), 0.0, math.inf)

    def _move(self, axes: dict[int, float], centre: dict[str, float]) -> Motion:
        start, modal = self.position, self.modal
        end = list(start)
        for axis, value in axes.items():
            base = start[axis] if modal.relative else 0.0
            if base is None:
                self.certain = False
            else:
                end[axis] = base + value * (modal.scale if axis < _LENGTHS else 1.0)
        goal = tuple(end)
        curved = modal.motion in (2, 3) and None not in start and None not in goal
        points = tuple(arc(modal, start, goal, centre)) if curved else (goal,)
        for point in points:
            self._enclose(point)
        self.position = goal
        length = length_of(start, points)
        return Motion(start, points, length, self._feed(start, goal, length))

    def _feed(self, start: Place, end: Place, length: float) -> float:
        modal = self.modal
        if modal.motion == 0:
            return math.inf
        feed = modal.feed * (length if modal.feed_mode == 93 else modal.scale)
        if start[2] is not None and end[2] is not None and end[2] < start[2] and feed:
            self.plunge = min(self.plunge, feed)
        return feed

    def _enclose(self, point: Place) -> None:
        low, high = self.low, self.high
        for axis, value in enumerate(point):
            if value is None:
                continue
            least, most = low[axis], high[axis]
            if least is None or value < least:
                low[axis] = value
            if most is None or value > most:
                high[axis] = value
