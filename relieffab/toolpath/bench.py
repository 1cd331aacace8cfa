"""The bench: one relief, and what still stands of the slab as cutter follows cutter."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.layers.model import Stroke
from relieffab.toolpath import remains
from relieffab.toolpath.engrave import stroke_trace
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.finish import finish_rows, scallop_stepover
from relieffab.toolpath.passes import Ground, Pass, Work, passes
from relieffab.toolpath.pencil import creases
from relieffab.toolpath.positions import Position
from relieffab.toolpath.rough import rough_passes, rough_work
from relieffab.toolpath.settings import Settings
from relieffab.toolpath.strips import strips
from relieffab.toolpath.trace import SKIN, Trace, sample
from relieffab.toolpath.waterline import waterlines

Floats = NDArray[np.float64]

_LEAST = 0.01
_LEAST_LINE = 0.02
_LEAST_MARK = 0.01
_SHARE = 0.6


class Bench:
    """A relief to be carved and the stock it is carved from.

    Parameters
    ----------
    relief : Terrain
    settings : Settings
    position : Position, optional
        Whose window the cutter's axis keeps to.
    tell : callable, optional
        Called before each cut; work is cancelled by raising from it.
    face : (cols + 1,) ndarray, optional
        Of the uncut stock along X, at nodes, mm; level if not given.

    Attributes
    ----------
    left : (rows + 1, cols + 1) ndarray
        What still stands at the relief's nodes, mm.
    """

    def __init__(
        self,
        relief: Terrain,
        settings: Settings,
        position: Position | None = None,
        tell: Callable[[], None] = lambda: None,
        face: Floats | None = None,
    ) -> None:
        self.relief = relief
        self.settings = settings
        self.position = position
        self.tell = tell
        self.left: Floats = np.zeros(relief.heights.shape)
        if face is not None:
            self.left += face
        self._ground: Ground | None = None

    def rough(self, cutter: Cutter, stepdown: float) -> list[Pass]:
        """Clear most of the stock, level by level."""
        work = rough_work(self.relief, self._standing, cutter, stepdown, self.settings.allowance)
        parts = rough_passes(work, reverse=self._turns, position=self.position)
        for part in parts:
            tips = np.concatenate(
                [np.zeros((0, 3)), *(_dense(run, work.step) for run in part.runs)]
            )
            self.left = remains.after(self.left, self.relief.grid, cutter, tips)
        return parts

    @property
    def _turns(self) -> bool:
        """Whether ways are turned: for conventional milling, or climb milling mirrored."""
        conventional = self.settings.milling == "conventional"
        return conventional != bool(self.relief.radius)

    def finish(self, cutter: Cutter, stepdown: float) -> list[Pass]:
        """Cut the surface: rows, steep walls along their heights, creases."""
        least = min(_LEAST, self.settings.rest)
        parts = self._surface(cutter, stepdown, least)
        work = self._work(cutter, stepdown, self.settings.rest)
        return parts + self._cut(work, sample(creases(work), work.step))

    def lines(self, cutter: Cutter, stepdown: float, *, strokes: Sequence[Stroke]) -> list[Pass]:
        """Go over the drawing, then over what the cutter before could not reach."""
        work = self._work(cutter, stepdown, _LEAST_LINE)
        parts = self._cut(work, stroke_trace(strokes, work))
        work = self._work(cutter, stepdown, self.settings.rest)
        apart = scallop_stepover(cutter, self.settings.scallop)
        ways = creases(work) + strips(work, apart)
        return parts + self._cut(work, sample(ways, work.step))

    def marks(
        self, cutter: Cutter, stepdown: float, *, marked: Terrain, lines: Sequence[Floats]
    ) -> list[Pass]:
        """Cut a chisel's marks, each in one go along its line, into what is finished."""
        work = self._work(cutter, stepdown, _LEAST_MARK)
        work = replace(work, ground=Ground(marked, cutter, SKIN))
        return self._cut(work, sample(lines, work.step))

    def _surface(self, cutter: Cutter, stepdown: float, least: float) -> list[Pass]:
        settings, parts = self.settings, list[Pass]()
        one_way = settings.milling != "either"
        turn = one_way and self._turns
        for angle in (0.0, 90.0)[: 2 if settings.crossed else 1]:
            work = self._work(cutter, stepdown, least)
            graded = finish_rows(work, settings.angle + angle, settings.stepover, settings.scallop)
            trace = graded.rows.turned() if turn else graded.rows
            parts += self._cut(work, trace, dropped=True, fixed=one_way)
            work = self._work(cutter, stepdown, least)
            apart = scallop_stepover(cutter, settings.scallop)
            walls = waterlines(work, graded.steep, apart)
            parts += self._cut(work, sample(walls, work.step))
        return parts

    @property
    def _standing(self) -> Terrain:
        return Terrain.over(self.relief.grid, self.left, self.relief.radius)

    def _work(self, cutter: Cutter, stepdown: float, least: float) -> Work:
        """Set a cutter before what is left."""
        grid = self.relief.grid
        # The skin makes every bump wider than this, so that none passes between two samples.
        narrow = cutter.points[1][0] if cutter.shape == "form" else cutter.arc_end
        step = min(grid.pitch / 2, 0.2 * max(narrow, 0.1))
        tolerance = self.settings.tolerance
        if self._ground is None or self._ground.cutter != cutter:
            self._ground = Ground(self.relief, cutter, SKIN)
        return Work(self._ground, self._standing, stepdown, tolerance, least, step)

    def _cut(
        self, work: Work, trace: Trace, *, dropped: bool = False, fixed: bool = False
    ) -> list[Pass]:
        """Cut along a trace, and remember what is left after all its passes."""
        self.tell()
        if self.position is not None:
            trace = trace.clipped(self.position.holds(*trace.xy.T))
        if len(trace) == 0:
            return []
        low, top = work.follow(trace, dropped=dropped)
        raised = replace(low, z=low.z + work.tolerance)
        worth, self.left = remains.worthwhile(
            self.left, work.relief.grid, work.cutter, raised, least=_SHARE * work.least
        )
        # What is not worth a move counts as cut already.
        return list(passes(work, low, np.where(worth, top, low.z), fixed=fixed))


def _dense(run: Floats, step: float) -> Floats:
    """Set places along a run at most a step apart."""
    lengths = np.hypot(*np.diff(run[:, :2], axis=0).T)
    at = np.concatenate([[0.0], np.cumsum(lengths)])
    places = np.union1d(at, np.arange(0.0, at[-1], step))
    return np.column_stack([np.interp(places, at, run[:, k]) for k in range(3)])
