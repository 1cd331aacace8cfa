"""Limits: how far a program may go; the one place that says so.

The writer refuses to write what breaks them, and the verifier reports it of a
text that somebody else wrote.  Both ask of the text as it is read back, and of a
stock cut by it: no option of planning or writing comes between.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.machine import Machine
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

Floats = NDArray[np.float64]

SLACK = 1e-6  # mm, for the arithmetic of offsets and units
OVER = 1.1
"""Of the stepdown a pass may take: the pass before was simplified upwards, by more where steep."""


@dataclass(frozen=True)
class Limits:
    """What bounds one cutter's motion.

    Parameters
    ----------
    depth : float
        Of the relief, positive, mm.
    stepdown : float
        Deepest single pass in this material, mm.
    cutter : Cutter
    stock : Stock
    machine : Machine
    position : Position, optional
        Whose window the motion keeps to.
    """

    depth: float
    stepdown: float
    cutter: Cutter
    stock: Stock
    machine: Machine
    position: Position | None = None

    @property
    def deepest_pass(self) -> float:
        """Most a move may take of what stands, mm."""
        return self.stepdown * OVER + 0.01

    def findings(
        self, points: Floats, feed: Floats, bites: Floats, line: NDArray[np.int64] | None = None
    ) -> tuple[str, ...]:
        """List every limit the motion breaks, one sentence each.

        Parameters
        ----------
        points : (n, 3) ndarray
            Positions of the tip, panel mm.
        feed : (n,) ndarray
            Of the move to each point, mm/min; infinite for a rapid.
        bites : (n,) ndarray
            Deepest bite of the move to each point into what stands by then, mm.
        line : (n,) ndarray of int, optional
            Lines of the text, to say where.
        """
        point = "move" if line is None else "line"
        number = np.arange(len(points)) if line is None else line
        found = [*self._depths(points), *self._passes(bites), *self._places(points, feed)]
        found += self._feeds(points, feed)
        return tuple(
            f"{text} ({np.count_nonzero(bad)} moves, first at {point} {number[bad.argmax()]})"
            for bad, text in found
            if bad.any()
        ) + travel_findings(points, self.machine)

    def _depths(self, points: Floats) -> Iterator[tuple[NDArray[np.bool_], str]]:
        z = points[:, 2]
        lowest = f"Z reaches {z.min():.3f} mm"
        bounds = {
            f"below the relief's depth of {self.depth:g} mm": self.depth,
            f"below the cutter's flutes of {self.cutter.flute_length:g} mm": (
                self.stock.lowest(self.cutter.flute_length)
            ),
            f"through the stock of {self.stock.thickness:g} mm": self.stock.thickness,
        }
        for words, bound in bounds.items():
            yield z < -bound - SLACK, f"cuts {words}: {lowest}"

    def _passes(self, bites: Floats) -> Iterator[tuple[NDArray[np.bool_], str]]:
        yield (
            bites > self.deepest_pass,
            f"takes {bites.max():.3f} mm at once, where {self.cutter.name} may take "
            f"{self.stepdown:.3g} mm",
        )

    def _places(self, points: Floats, feed: Floats) -> Iterator[tuple[NDArray[np.bool_], str]]:
        x, y, z = points.T
        below = z < -SLACK
        size = self.stock.width, self.stock.height
        outside = (x < -SLACK) | (x > size[0] + SLACK)
        if not self.stock.all_round:
            outside |= (y < -SLACK) | (y > size[1] + SLACK)
        # A move is below the face outside the stock if either of its ends is.
        low = below & outside
        low[1:] |= below[:-1] & outside[1:]
        yield low, f"cuts outside the stock of {size[0]:g} x {size[1]:g} mm"
        if self.position is not None:
            (x0, y0), (x1, y1) = self.position.low, self.position.high
            past = (x < x0 - SLACK) | (x > x1 + SLACK) | (y < y0 - SLACK) | (y > y1 + SLACK)
            yield past, f"leaves the window of position {self.position.number}"
        yield self._in_frame(points), "runs into the raised frame"
        sideways = np.zeros(len(points), bool)
        sideways[1:] = (np.abs(np.diff(points[:, :2], axis=0)) > SLACK).any(axis=1) & below[:-1]
        yield np.isinf(feed) & (below | sideways), "a rapid goes below the panel's face"

    def _in_frame(self, points: Floats) -> NDArray[np.bool_]:
        """Say which moves are lower than a raised frame, and not well inside it.

        Outlines bulge nowhere inwards: a move stays inside if its ends are.
        """
        frame = self.stock.frame
        if frame is None or frame.height < 0:
            return np.zeros(len(points), bool)
        x, y, z = points.T
        low = z < self.stock.top - SLACK
        keep = frame.width + self.cutter.radius - SLACK
        outside = ~self.stock.outline.inside(x, y, by=keep)
        for either in (low, outside):
            either[1:] |= either[:-1].copy()
        return low & outside

    def _feeds(self, points: Floats, feed: Floats) -> Iterator[tuple[NDArray[np.bool_], str]]:
        # Along X and Y the feed itself must be one the axis can follow.  A slope
        # may ask more of Z than it can: the controller then slows the whole move.
        step = np.abs(np.diff(points, axis=0, prepend=points[:1])) > SLACK
        rate = np.where(step, np.asarray(self.machine.max_rate), np.inf)
        ceiling = np.where(step[:, :2].any(axis=1), rate[:, :2].min(axis=1), rate[:, 2])
        fast = np.isfinite(feed) & (feed > ceiling * (1 + 1e-9))
        yield fast, f"a feed is above the machine's {self.machine.max_rate} mm/min"


def travel_findings(points: Floats, machine: Machine) -> tuple[str, ...]:
    """Say which axes would have to move further than the machine can.

    Parameters
    ----------
    points : (n, 3) ndarray
        mm, in any one coordinate system.
    """
    span = np.ptp(points, axis=0)
    return tuple(
        f"moves over {span[k]:.3f} mm of {'XYZ'[k]}, where {machine.name} has {reach:g} mm"
        for k, reach in enumerate(machine.travel)
        if span[k] > reach + SLACK
    )
