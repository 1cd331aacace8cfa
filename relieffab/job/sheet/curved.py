"""A board whose face is curved: seen from the near side."""

from math import sin

import numpy as np

from relieffab.job.sheet.drawing import Drawing, Word
from relieffab.job.sheet.words import mm
from relieffab.round import Curved

WIDE, TALL = 300.0, 150.0  # pixels
LEFT, ABOVE = 76.0, 30.0
ARC = 65  # points


def draw(board: Curved, depth: float) -> Drawing:
    """Draw a curved board from its near side, to scale.

    Parameters
    ----------
    board : Curved
    depth : float
        Of the relief, mm; 0 where there is none.
    """
    half = board.width / board.radius / 2
    chord = 2 * board.radius * sin(half)
    scale = min(WIDE / chord, TALL / board.thickness)
    page = Drawing(
        chord * scale + 190, board.thickness * scale + 74, "The board from the near side"
    )
    middle, foot = LEFT + chord * scale / 2, ABOVE + board.thickness * scale
    angle = np.linspace(-half, half, ARC)

    def face(under: float, reach: float = 1.0) -> np.ndarray:
        away = (board.radius - under) * scale
        x, down = away * np.sin(reach * angle), away * np.cos(reach * angle)
        return np.stack([middle + x, ABOVE + board.radius * scale - down], axis=1)

    top, right = face(0.0), middle + chord * scale / 2
    page.polyline("stock", [*top, (right, foot), (LEFT, foot)], closed=True)
    if depth:
        page.polyline("cut", [*face(0.0, 0.8), *face(depth, 0.8)[::-1]], closed=True)
        page.words.append(Word(middle, ABOVE - 8, f"{mm(depth)} mm deep"))
    page.down(ABOVE, foot, 0.3 * LEFT, f"{mm(board.thickness)} mm", from_x=middle)
    sides = float(top[-1, 1])
    page.down(sides, foot, right + 22, f"{mm(round(board.wall, 2))} mm", from_x=right)
    page.across(LEFT, right, foot + 22, f"{mm(round(chord, 2))} mm", from_y=foot)
    words = f"face: {mm(board.width)} mm along the curve, radius {mm(board.radius)} mm"
    page.words.append(Word(page.width / 2, foot + 40, words))
    return page
