"""A drawing cut into pages that overlap, to be glued together again."""

import math
from dataclasses import dataclass

from relieffab.errors import InputError

PAPERS = {"a4": (210.0, 297.0), "letter": (215.9, 279.4)}
"""Width and height, mm."""
EDGE = 10.0  # mm at each side that printers leave white
OVERLAP = 10.0  # mm that neighbours share
MOST = 26  # pages across or down: the letters of the alphabet


@dataclass(frozen=True)
class Page:
    """One page of a tiling.

    Parameters
    ----------
    name : str
        Column letter and row number; A1 is the far left one.
    x, y : float
        What of the drawing lies in the lower left corner of the page's window, mm.
    """

    name: str
    x: float
    y: float


@dataclass(frozen=True)
class Tiling:
    """Pages over a drawing.

    Parameters
    ----------
    paper : tuple of float
        Width and height of a page as it is turned, mm.
    window : tuple of float
        Width and height of the drawing that one page shows, mm.
    counts : tuple of int
        Pages across and down.
    start : tuple of float
        X and Y of the drawing at the lower left corner of the lowest left window, mm.
    """

    paper: tuple[float, float]
    window: tuple[float, float]
    counts: tuple[int, int]
    start: tuple[float, float]

    def _at(self, axis: int, k: float) -> float:
        return self.start[axis] + k * (self.window[axis] - OVERLAP)

    def pages(self) -> list[Page]:
        """All pages, row by row from the far left one."""
        across, down = self.counts
        return [
            Page(_name(col, row), self._at(0, col), self._at(1, down - 1 - row))
            for row in range(down)
            for col in range(across)
        ]

    @property
    def last(self) -> str:
        """The name of the near right page."""
        return _name(self.counts[0] - 1, self.counts[1] - 1)

    def joints(self) -> list[tuple[float, float]]:
        """Places in the middle of overlaps, two a page and side: both neighbours show them."""
        across, down = self.counts
        quarter = tuple(side / 4 for side in self.window)
        places = []
        for col in range(across):
            for row in range(down):
                x, y = self._at(0, col), self._at(1, row)
                for k in (1, 3):
                    if col > 0:
                        places.append((x + OVERLAP / 2, y + k * quarter[1]))
                    if row > 0:
                        places.append((x + k * quarter[0], y + OVERLAP / 2))
        return places


def _name(col: int, row: int) -> str:
    return f"{chr(ord('A') + col)}{row + 1}"


def tile(low: tuple[float, float], high: tuple[float, float], paper: str, foot: float) -> Tiling:
    """Cover a rectangle with the fewest pages, upright ones where both ways need as many.

    Parameters
    ----------
    low, high : tuple of float
        The rectangle's corners, mm; it lies in the middle of the pages.
    paper : str
        One of `PAPERS`.
    foot : float
        Height below the window that each page keeps for other things, mm.

    Raises
    ------
    InputError
        If that takes more than 26 pages either way.
    """
    size = tuple(high[k] - low[k] for k in (0, 1))
    wide, tall = PAPERS[paper]
    choices = []
    for turned in ((wide, tall), (tall, wide)):
        window = turned[0] - 2 * EDGE, turned[1] - 2 * EDGE - foot
        counts = tuple(
            max(1, math.ceil((size[k] - OVERLAP) / (window[k] - OVERLAP) - 1e-9)) for k in (0, 1)
        )
        covered = (counts[k] * (window[k] - OVERLAP) + OVERLAP for k in (0, 1))
        start = (low[k] - (all_ - size[k]) / 2 for k, all_ in enumerate(covered))
        choices.append(Tiling(turned, window, (counts[0], counts[1]), (next(start), next(start))))
    best = min(choices, key=lambda one: one.counts[0] * one.counts[1])
    if max(best.counts) > MOST:
        raise InputError(
            "the template has too many pages",
            expected=f"at most {MOST} across and down",
            found=f"{best.counts[0]} x {best.counts[1]} of {paper}",
            hint="a smaller --size of the relief",
        )
    return best
