"""Program: what a text of G-code makes the machine do."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.stock import Stock

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Program:
    """The motion a program of G-code commands; arrays are read-only.

    Arcs are chords here.  The first point is where the position first becomes
    known on all axes, reached by a rapid from wherever the machine stands.

    Parameters
    ----------
    name : str
        For messages: a file's name, usually.
    points : (n, 3) ndarray
        Positions of the cutter's tip in work coordinates, mm.
    feed : (n,) ndarray
        Of the move that ends at each point, mm/min; infinite for a rapid.
    line : (n,) ndarray of int
        Number of the text's line that commands each move, from 1.
    spindle : (n,) ndarray
        The S value while each move is made; 0 while the spindle stands.
    dwell : (n + 1,) ndarray
        Seconds waited before each move, and after the last.
    line_count : int
        Lines of the text.
    sent : (n,) ndarray of int
        Characters of that line as they are sent, its end included.
    tool : (n,) ndarray of int
        Number of the cutter that makes each move; 0 before any was called for.
    blind_line : int
        Line of the first move sideways at a height not known yet; 0 if none.
    """

    name: str
    points: Floats
    feed: Floats
    line: NDArray[np.int64]
    spindle: Floats
    dwell: Floats
    line_count: int
    sent: NDArray[np.int64]
    tool: NDArray[np.int64]
    blind_line: int = 0

    def __post_init__(self) -> None:
        count = len(self.points)
        shapes = {"points": (count, 3), "feed": (count,), "line": (count,)}
        shapes |= {"spindle": (count,), "dwell": (count + 1,), "sent": (count,), "tool": (count,)}
        for name, want in shapes.items():
            array = getattr(self, name)
            if array.shape != want:
                raise InputError(
                    f"the program's {name} do not fit its moves",
                    expected=f"shape {want}",
                    found=f"{array.shape}",
                    where=self.name,
                )
            array.flags.writeable = False
        if not count:
            raise InputError("the program moves nothing", where=self.name)
        if not np.isfinite(self.points).all():
            raise InputError("the program goes to no finite place", where=self.name)

    @property
    def rapid(self) -> NDArray[np.bool_]:
        """Whether each move is a rapid."""
        return np.isinf(self.feed)

    @property
    def lengths(self) -> Floats:
        """Length of the move that ends at each point, mm; 0 for the first."""
        steps = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        return np.concatenate([[0.0], steps])

    @property
    def cutting_length(self) -> float:
        """Length of all moves at a feed, mm."""
        return float(self.lengths[~self.rapid].sum())

    @property
    def bounds(self) -> Floats:
        """Least and greatest X, Y, Z as a (2, 3) array, work coordinates, mm."""
        return np.array([self.points.min(axis=0), self.points.max(axis=0)])

    def by_tool(self) -> tuple["Program", ...]:
        """Part it where the cutter is changed; each part has the whole's name and lines."""
        breaks = 1 + np.flatnonzero(np.diff(self.tool))
        ends = [0, *breaks.tolist(), len(self.points)]
        return tuple(self._part(a, b) for a, b in pairwise(ends))

    def _part(self, start: int, stop: int) -> "Program":
        last = stop == len(self.points)
        dwell = np.append(self.dwell[start:stop], self.dwell[-1] if last else 0.0)
        return Program(
            self.name,
            self.points[start:stop],
            self.feed[start:stop],
            self.line[start:stop],
            self.spindle[start:stop],
            dwell,
            self.line_count,
            self.sent[start:stop],
            self.tool[start:stop],
            self.blind_line if start == 0 else 0,
        )

    def on_panel(self, stock: Stock) -> Floats:
        """Give the points in panel coordinates, mm."""
        return stock.to_panel(self.points)

    def moved(self, was: Stock, now: Stock) -> "Program":
        """Give the program that goes the same way on a panel that lies elsewhere."""
        return replace(self, points=now.to_work(self.on_panel(was)))
