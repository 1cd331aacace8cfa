"""A round stock on its rotary axis: seen from the operator's side, and across the axis."""

from collections.abc import Sequence
from math import pi

import numpy as np
from numpy.typing import NDArray

from relieffab.job.sheet.drawing import TICK, Drawing, Word
from relieffab.job.sheet.words import mm
from relieffab.round import Round, chord
from relieffab.stock import Stock

Floats = NDArray[np.float64]

LONGEST, THICKEST = 330.0, 170.0  # pixels along and across the axis
LEFT, ABOVE = 76.0, 56.0
DISC = 84.0  # pixels of the face's radius, across the axis
FINE = 0.1  # pixels a drawn arc may be off


def along(
    stock: Stock, bent: Round, depth: float, cut: Sequence[float], safe: float = 0.0
) -> Drawing:
    """Draw a round stock from the operator's side, cut open along its axis.

    Parameters
    ----------
    stock : Stock
        As it lies on the machine.
    bent : Round
        Its bore and floor.
    depth : float
        Of the relief, mm; 0 where there is none.
    cut : (low, high)
        From where to where along the axis the relief is cut, mm from the figure's top.
    safe : float
        The height of rapids over the face, mm; 0 where there are none.
    """
    scale = min(LONGEST / stock.width, THICKEST / bent.diameter)
    long, thick = stock.width * scale, bent.diameter * scale
    top, right = ABOVE + safe * scale, LEFT + long
    page = Drawing(right + 104, top + thick + 46, "The stock from the operator's side")
    page.polyline("stock", _box(LEFT, top, right, top + thick), closed=True)
    middle = top + thick / 2
    if bent.bore:
        half, end = bent.bore / 2 * scale, right - bent.floor * scale
        page.polyline("cut", _box(LEFT, middle - half, end, middle + half), closed=True)
    if depth:
        x0, x1 = (LEFT + float(np.clip(x, 0, stock.width)) * scale for x in cut)
        page.polyline("cut", _box(x0, top, x1, top + depth * scale), closed=True)
        page.down(top, top + depth * scale, right + 14, f"{mm(depth)} mm deep", from_x=right)
    page.polyline("hidden", [(LEFT - 14, middle), (right + 14, middle)])
    page.words.append(Word(right + 18, middle + 4, "axis", "start"))
    if safe:
        page.polyline("travel", [(LEFT - 20, ABOVE), (right + 14, ABOVE)])
        words = f"rapids at Z {mm(safe - stock.work_zero[2])}"
        page.words.append(Word(right + 14, ABOVE - 5, words, "end"))
    foot = top + thick
    page.across(LEFT, right, foot + 22, f"{mm(stock.width)} mm", from_y=foot)
    page.down(top, foot, 0.3 * LEFT, f"{mm(bent.diameter)} mm", from_x=LEFT)
    within = min(20.0, long / 2 - 4)  # so that the two keep apart on a short stock
    page.words.append(Word(LEFT + within, foot + 40, "figure's top", "end"))
    page.words.append(Word(right - within, foot + 40, "figure's foot", "start"))
    at = LEFT + stock.work_zero[0] * scale, top - stock.work_zero[2] * scale
    _zero(page, at, "X", "Z")
    return page


def across(stock: Stock, bent: Round, depth: float, letter: str) -> Drawing:
    """Draw a round stock across its axis, as seen against X, the operator on the left.

    Parameters
    ----------
    stock : Stock
        As it lies on the machine.
    bent : Round
        Its bore.
    depth : float
        Of the relief, mm; 0 where there is none.
    letter : {'A', 'Y', ''}
        The word of the rotary axis; empty where no machine is known.
    """
    scale = DISC / stock.radius
    middle = np.array([96.0 + DISC, ABOVE + DISC])
    page = Drawing(2 * middle[0], middle[1] + DISC + 46, "The stock across its axis")
    page.circle("stock", middle, DISC)
    if bent.bore:
        page.circle("cut", middle, bent.bore / 2 * scale)
    # The face under the cutter is that of work zero: Y grows over the top, away from here.
    first, last = ((stock.work_zero[1] - y) / stock.radius for y in (stock.height, 0.0))
    if depth:
        outer = _arc(middle, DISC, first, last)
        inner = _arc(middle, DISC - depth * scale, first, last)
        page.polyline("cut", [*outer, *inner[::-1]], closed=True)
    page.circle("measure", middle, 1.5)
    left, right = middle[0] - DISC, middle[0] + DISC
    words = f"{mm(bent.diameter)} mm"
    page.across(left, right, middle[1] + DISC + 22, words, from_y=middle[1])
    page.words.append(Word(4, middle[1] + DISC + 40, "operator's side", "start"))
    _zero(page, (middle[0], middle[1] - DISC - stock.work_zero[2] * scale), "", "Z")
    if letter:
        page.words.append(Word(middle[0] - 10, ABOVE - 6, f"{letter} 0", "end"))
        _turn(page, middle, letter)
    return page


def _turn(page: Drawing, middle: Floats, letter: str) -> None:
    """Show which way the stock turns: its top away from the operator as A grows, else to him."""
    ends = (0.3, 0.85) if letter == "A" else (0.85, 0.3)
    arc = _arc(middle, DISC + 15, *ends)
    page.polyline("turn", arc)
    way = (arc[-1] - arc[-2]) / np.linalg.norm(arc[-1] - arc[-2])
    side, back = np.array([-way[1], way[0]]), arc[-1] - 2 * TICK * way
    page.polyline("turn", [back + 0.8 * TICK * side, arc[-1], back - 0.8 * TICK * side])
    x, y = middle + (DISC + 22) * np.array([np.sin(0.62), -np.cos(0.62)])
    page.words.append(Word(float(x), float(y), f"turns so as {letter} grows", "start"))


def _arc(middle: Floats, radius: float, first: float, last: float) -> Floats:
    """Go round from one angle to another, clockwise from the top: (n, 2)."""
    count = int(abs(last - first) / chord(radius, FINE)) + 2
    angle = np.linspace(first, last, count)
    return middle + radius * np.stack([np.sin(angle), -np.cos(angle)], axis=1)


def _box(x0: float, y0: float, x1: float, y1: float) -> list[tuple[float, float]]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def _zero(page: Drawing, at: tuple[float, float], level: str, upright: str) -> None:
    x, y = at
    if level:
        page.arrow("zero", (x, y), (x + 34, y))
        page.words.append(Word(x + 40, y - 5, level, "start"))
    page.arrow("zero", (x, y), (x, y - 34))
    page.words.append(Word(x + 7, y - 27, upright, "start"))
    page.circle("origin", (x, y), 5)


def arc_words(bent: Round) -> str:
    """Say how much of the way round the figure's panel takes.

    Examples
    --------
    >>> arc_words(Round(60, 45, 40))
    '60 of 125.66 mm round the face, 172°'
    """
    around = pi * bent.diameter
    return f"{mm(bent.width)} of {around:.2f} mm round the face, {360 * bent.width / around:.0f}°"
