"""The stock from the side: its thickness, frame and depth, Z of work zero, the safe height."""

from collections.abc import Mapping
from typing import Any

from relieffab.job.sheet.drawing import Drawing, Word
from relieffab.job.sheet.words import mm
from relieffab.stock import Stock

SLAB = 92.0  # pixels of the stock's thickness
LEFT, RIGHT, WIDTH = 96.0, 366.0, 470.0


def draw(stock: Stock, depth: float, machine: Mapping[str, Any] | None) -> Drawing:
    """Draw a stock from the operator's side, heights to scale, widths not.

    Parameters
    ----------
    stock : Stock
    depth : float
        Of the relief, mm; 0 where there is none.
    machine : mapping or None
        report.json's.
    """
    safe = machine["safe_height"] if machine else 0.0
    scale = SLAB / stock.thickness
    above = min(max(stock.top, safe) * scale, SLAB)
    face = 26 + above
    foot = face + SLAB
    page = Drawing(WIDTH, foot + 26, "The stock from the side")
    _profile(page, stock, face, depth, scale)
    page.down(face, foot, 0.35 * LEFT, f"{mm(stock.thickness)} mm", from_x=LEFT)
    if depth:
        deep = face + depth * scale
        page.down(face, deep, RIGHT + 22, f"{mm(depth)} mm deep", from_x=RIGHT - 30)
    if safe:
        high = face - above
        page.polyline("travel", [(LEFT - 20, high), (RIGHT + 20, high)])
        words = f"rapids at Z {mm(safe - stock.work_zero[2])}"
        page.words.append(Word(LEFT - 20, high - 5, words, "start"))
    zero = face - stock.work_zero[2] * scale
    page.arrow("zero", (LEFT - 14, zero), (LEFT - 14, zero - 30))
    page.circle("origin", (LEFT - 14, zero), 5)
    page.words.append(Word(LEFT - 24, zero - 4, "Z 0", "end"))
    return page


def _profile(page: Drawing, stock: Stock, face: float, depth: float, scale: float) -> None:
    """Draw the slab cut through, frame and relief included."""
    foot, wide = face + SLAB, RIGHT - LEFT
    rim = LEFT + 26, RIGHT - 26
    corners = [(LEFT, foot), (LEFT, face), (RIGHT, face), (RIGHT, foot)]
    if stock.frame:
        # Beyond the picture's top a frame is drawn as far as there is room.
        level = max(face - stock.frame.height * scale, 8.0)
        corners[1:3] = [
            *[(LEFT, level), (rim[0], level), (rim[0], face)],
            *[(rim[1], face), (rim[1], level), (RIGHT, level)],
        ]
    page.polyline("stock", corners, closed=True)
    if depth:
        deep = min(depth * scale, SLAB - 4)
        inner = LEFT + 0.2 * wide, RIGHT - 0.2 * wide
        page.polyline(
            "cut",
            [
                (inner[0], face),
                (inner[0] + 4, face + deep),
                (inner[1] - 4, face + deep),
                (inner[1], face),
            ],
            closed=True,
        )
