"""What is drawn on paper, whatever writes it: lines and words in mm, Y up."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

INK, PALE, LIGHT, PAPER = "#000000", "#999999", "#b8860b", "#ffffff"
HAIR = 0.15  # mm


@dataclass(frozen=True, eq=False)
class Line:
    """A polyline.

    Parameters
    ----------
    points : (n, 2) ndarray
        X and Y, mm.
    colour : str
        #rrggbb.
    width : float
        mm.
    closed : bool
        Whether the last point joins the first.
    """

    points: Floats
    colour: str = INK
    width: float = HAIR
    closed: bool = False


@dataclass(frozen=True)
class Text:
    """A word or a few.

    Parameters
    ----------
    x, y : float
        Where its base line begins, or its middle or end, mm.
    words : str
    size : float
        Of the letters, mm.
    colour : str
        #rrggbb.
    angle : float
        Counter-clockwise, degrees.
    anchor : str
        'start', 'middle' or 'end'.
    """

    x: float
    y: float
    words: str
    size: float = 2.8
    colour: str = INK
    angle: float = 0.0
    anchor: str = "start"


Mark = Line | Text


def polyline(points: ArrayLike, colour: str = INK, width: float = HAIR) -> Line:
    """Make an open line of points, (n, 2) mm."""
    return Line(np.asarray(points, float), colour, width)


def rectangle(x0: float, y0: float, x1: float, y1: float, colour: str = INK) -> Line:
    """Make a closed line round a rectangle."""
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return Line(np.array(corners, float), colour, HAIR, closed=True)


def cross(x: float, y: float, arm: float = 3.0) -> list[Mark]:
    """Mark a place that sheets are laid over each other by."""
    return [
        polyline([(x - arm, y), (x + arm, y)]),
        polyline([(x, y - arm), (x, y + arm)]),
    ]


def scale_bar(x: float, y: float, length: int = 100) -> list[Mark]:
    """Draw a ruler, from (x, y) to the right, ticks every 10 mm."""
    marks: list[Mark] = [polyline([(x, y), (x + length, y)])]
    for at in range(0, length + 1, 10):
        high = 3.0 if at % 50 == 0 else 1.8
        marks.append(polyline([(x + at, y), (x + at, y + high)]))
    for at, words in ((0, "0"), (length // 2, f"{length // 2}"), (length, f"{length} mm")):
        marks.append(Text(x + at, y - 3.2, words, anchor="start" if at == 0 else "middle"))
    return marks


def plain(words: str, most: int = 48) -> str:
    """Make words of a file's name that can be printed, and not too many."""
    words = "".join(letter if letter.isprintable() else "?" for letter in words)
    return words if len(words) <= most else words[: most - 1] + "…"


def moved(marks: Iterable[Mark], dx: float, dy: float) -> list[Mark]:
    """Move marks by a distance, mm."""
    return [
        replace(mark, points=mark.points + np.array([dx, dy]))
        if isinstance(mark, Line)
        else replace(mark, x=mark.x + dx, y=mark.y + dy)
        for mark in marks
    ]
