"""A drawing as the page lays it out: paths and words in pixels of an SVG."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

TICK = 4.0  # pixels of an arrow's head


@dataclass(frozen=True)
class Word:
    """A word on the drawing: where, how it is anchored, and whether it stands upright."""

    x: float
    y: float
    text: str
    anchor: str = "middle"
    upright: bool = False


@dataclass(frozen=True)
class Line:
    """A path on the drawing, and its class in the style sheet."""

    kind: str
    path: str


@dataclass(frozen=True)
class Inset:
    """A picture on the drawing, and the degrees it is turned by within its box, clockwise."""

    x: float
    y: float
    width: float
    height: float
    uri: str
    turn: int = 0

    @property
    def lying(self) -> "Inset":
        """What comes to fill the box once it is turned about the middle."""
        if self.turn % 180 == 0:
            return self
        x, y = self.x + (self.width - self.height) / 2, self.y + (self.height - self.width) / 2
        return replace(self, x=x, y=y, width=self.height, height=self.width)


@dataclass
class Drawing:
    """A drawing being made.

    Parameters
    ----------
    width, height : float
        Pixels.
    title : str
        For those who cannot see it.
    """

    width: float
    height: float
    title: str
    insets: list[Inset] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    words: list[Word] = field(default_factory=list)

    def polyline(self, kind: str, points: ArrayLike, *, closed: bool = False) -> None:
        """Draw a line through points (n, 2)."""
        corners = [f"{x:.1f} {y:.1f}" for x, y in np.asarray(points, float)]
        self.lines.append(Line(kind, f"M{' L'.join(corners)}{' Z' if closed else ''}"))

    def circle(self, kind: str, middle: ArrayLike, radius: float) -> None:
        """Draw a circle round a place (2,)."""
        x, y = np.asarray(middle, float)
        half = f"a{radius:.1f} {radius:.1f} 0 0 1"
        path = f"M{x - radius:.1f} {y:.1f} {half} {2 * radius:.1f} 0 {half} {-2 * radius:.1f} 0 Z"
        self.lines.append(Line(kind, path))

    def arrow(self, kind: str, start: Sequence[float], end: Sequence[float]) -> None:
        """Draw an arrow along X or Y, its head at the end."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        way = (b - a) / max(float(np.linalg.norm(b - a)), 1e-9)
        side = np.array([-way[1], way[0]])
        back = b - 2 * TICK * way
        self.polyline(kind, [a, b])
        self.polyline(kind, [back + 0.8 * TICK * side, b, back - 0.8 * TICK * side])

    def across(self, x0: float, x1: float, y: float, text: str, *, from_y: float) -> None:
        """Measure along X at height y; witness lines come from `from_y`."""
        for x in (x0, x1):
            self.polyline("witness", [(x, from_y), (x, y + (3 if y > from_y else -3))])
        self._measure((x0, y), (x1, y))
        self.words.append(Word((x0 + x1) / 2, y - 4, text))

    def down(self, y0: float, y1: float, x: float, text: str, *, from_x: float) -> None:
        """Measure along Y at x; witness lines come from `from_x`."""
        for y in (y0, y1):
            self.polyline("witness", [(from_x, y), (x + (3 if x > from_x else -3), y)])
        self._measure((x, y0), (x, y1))
        if abs(y1 - y0) > 40:
            self.words.append(Word(x - 4, (y0 + y1) / 2, text, upright=True))
        else:
            right = x > from_x
            anchor = "start" if right else "end"
            self.words.append(Word(x + (6 if right else -6), (y0 + y1) / 2 + 4, text, anchor))

    def _measure(self, a: Sequence[float], b: Sequence[float]) -> None:
        self.polyline("measure", [a, b])
        for x, y in (a, b):
            self.polyline("measure", [(x - 3, y + 3), (x + 3, y - 3)])
