"""The stock as it lies on the machine, drawn from above, with work zero and what is cut.

Of a round stock it is the face laid out flat, as the cutter meets it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.job.sheet.drawing import Drawing, Inset, Word
from relieffab.job.sheet.words import mm
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

Floats = NDArray[np.float64]
Box = tuple[Floats, Floats]

LARGEST = 400.0, 330.0  # pixels of the stock, and the machine's travel where that is drawn
LAID_OUT = 300.0, 230.0  # of a round stock's face
MARGIN = 46.0
ROOMY = 1.7  # times the stock's side; a larger travel is not drawn


@dataclass(frozen=True)
class Plan:
    """What is drawn.

    Parameters
    ----------
    stock : Stock
    position : Position or None
        How it lies, where it is moved.
    bounds : (low, high) or None
        Of the programs, panel mm.
    travel : (x, y) or None
        Of the machine, mm.
    picture : (uri, low, high) or None
        The relief from above, and its corners, panel mm.
    letter : {'Y', 'A'}
        The axis across X; A grows against Y.
    """

    stock: Stock
    position: Position | None = None
    bounds: Box | None = None
    travel: Sequence[float] | None = None
    picture: tuple[str, Floats, Floats] | None = None
    letter: str = "Y"


@dataclass(frozen=True)
class Sight:
    """From panel mm to pixels, the operator at the bottom."""

    stock: Stock
    scale: float
    corner: tuple[float, float]

    def __call__(self, points: ArrayLike) -> Floats:
        """Turn places (n, 2) on the panel into pixels."""
        x, y = np.asarray(points, float).reshape(-1, 2).T
        if self.stock.turned:
            x, y = self.stock.width - x, self.stock.height - y
        if self.stock.radius:
            y = self.stock.height - y
        left, near = self.corner
        return np.stack([left + x * self.scale, near - y * self.scale], axis=1)


def bounds_of(parts: Sequence[Mapping[str, Any]], stock: Stock) -> Box | None:
    """Find the box of all that programs of one position do, panel mm."""
    if not parts:
        return None
    boxes = np.array([part["bounds_mm"] for part in parts])
    ends = stock.to_panel(np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]))
    return ends.min(axis=0), ends.max(axis=0)


def lying(stock: Stock, position: Position | None) -> Stock:
    """Give the stock as it lies at a position."""
    if position is None:
        return stock
    zero = (*position.zero, stock.work_zero[2])
    return replace(stock, work_zero=zero, turned=position.turned)


def _reach(plan: Plan) -> Box | None:
    """Place the machine's travel evenly round what is cut, panel mm; None if it is too large."""
    if plan.travel is None or plan.bounds is None or plan.stock.radius:
        return None
    low, high = plan.bounds[0][:2], plan.bounds[1][:2]
    travel = np.asarray(plan.travel[:2], float)
    if (travel > ROOMY * np.array([plan.stock.width, plan.stock.height])).any():
        return None
    spare = (travel - (high - low)) / 2
    return low - spare, high + spare


def draw(plan: Plan) -> Drawing:
    """Draw a stock from above."""
    stock, reach = plan.stock, _reach(plan)
    page, sight = _sheet(plan, reach)
    _stock(page, plan, sight)
    _programs(page, plan, sight, reach)
    _measures(page, stock, sight)
    _zero(page, plan, sight)
    if not stock.radius:
        page.words.append(Word(page.width / 2, page.height - 5, "operator's side"))
    return page


def _sheet(plan: Plan, reach: Box | None) -> tuple[Drawing, Sight]:
    """Lay out an empty page with room for all that is to be drawn."""
    stock = plan.stock
    low, high = np.zeros(2), np.array([stock.width, stock.height])
    if reach is not None:
        low, high = np.minimum(low, reach[0]), np.maximum(high, reach[1])
        if stock.turned:
            low, high = (stock.width, stock.height) - high, (stock.width, stock.height) - low
    scale = float(min((LAID_OUT if stock.radius else LARGEST) / (high - low)))
    wide, tall = (high - low) * scale
    x, y = Sight(stock, scale, (-low[0] * scale, high[1] * scale))(stock.work_zero[:2])[0]
    arrow = _arrow(stock, scale)
    # The arrows of work zero want room, wherever on the stock it is.
    down = plan.letter == "A"
    above = max(MARGIN / 2, 0.0 if down else arrow + 16 - y)
    below = max(0.0, arrow + 8 - (tall - y)) if down else 0.0
    beside = max(MARGIN / 2, arrow + 20 - (wide - x))
    corner = MARGIN - low[0] * scale, above + high[1] * scale
    title = "The face laid out flat" if stock.radius else "The stock from above"
    page = Drawing(MARGIN + wide + beside, above + tall + below + 1.4 * MARGIN, title)
    return page, Sight(stock, scale, corner)


def _box(low: Floats, high: Floats) -> list[tuple[float, float]]:
    return [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]


def _stock(page: Drawing, plan: Plan, sight: Sight) -> None:
    """Draw its outline, what it shows of the relief, frame, holes and keyholes."""
    stock = plan.stock
    page.polyline("stock", sight(stock.outline.polygon()), closed=True)
    if plan.picture is not None:
        uri, low, high = plan.picture
        corners = sight([low[:2], high[:2]])
        (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
        turn = -90 if stock.radius else 180 if stock.turned else 0
        page.insets.append(Inset(x0, y0, x1 - x0, y1 - y0, uri, turn))
    if stock.frame:
        inner = stock.outline.polygon(by=stock.frame.width)
        page.polyline("frame", sight(inner), closed=True)
    for hole in stock.holes:
        at = sight(hole.at)[0]
        page.circle("hole", at, hole.diameter / 2 * sight.scale)
        if hole.countersink:
            page.circle("edge", at, hole.countersink / 2 * sight.scale)
    for key in stock.keyholes:
        end = (key.at[0], key.at[1] - key.travel)
        page.circle("hidden", sight(end)[0], key.head / 2 * sight.scale)
        page.polyline("hidden", sight([key.at, end]))


def _programs(page: Drawing, plan: Plan, sight: Sight, reach: Box | None) -> None:
    """Draw what the programs and the machine reach, and the window of a position."""
    if plan.position is not None:
        window = _box(np.asarray(plan.position.low), np.asarray(plan.position.high))
        page.polyline("window", sight(window), closed=True)
    if plan.bounds is not None:
        page.polyline("bounds", sight(_box(*plan.bounds)), closed=True)
    if reach is not None:
        corners = sight(_box(*reach))
        page.polyline("travel", corners, closed=True)
        x, y = corners.min(axis=0)
        page.words.append(Word(float(x) + 3, float(y) - 4, "travel of the machine", "start"))


def _measures(page: Drawing, stock: Stock, sight: Sight) -> None:
    corners = sight([(0, 0), (stock.width, stock.height)])
    (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
    low, left = page.height - 0.62 * MARGIN, 0.45 * MARGIN
    page.across(x0, x1, low, f"{mm(stock.width)} mm", from_y=y1)
    page.down(y0, y1, left, f"{mm(stock.height)} mm", from_x=x0)


def _arrow(stock: Stock, scale: float) -> float:
    """Length of the axes' arrows, pixels."""
    return min(0.22 * min(LARGEST), 0.4 * scale * min(stock.width, stock.height))


def _zero(page: Drawing, plan: Plan, sight: Sight) -> None:
    """Draw work zero and the ways of the axes from it, as the machine has them."""
    stock = plan.stock
    x, y = sight(stock.work_zero[:2])[0]
    reach = _arrow(stock, sight.scale)
    up = y + reach if plan.letter == "A" else y - reach
    page.arrow("zero", (x, y), (x + reach, y))
    page.arrow("zero", (x, y), (x, up))
    page.circle("origin", (x, y), 5)
    page.words.append(Word(x + reach + 7, y - 4, "X", "start"))
    page.words.append(Word(x + 6, up - 2, plan.letter, "start"))
