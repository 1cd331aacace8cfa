"""Depth in passes: no cut takes more than the stepdown from what still stands."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.toolpath.envelope import Places, Terrain, nodes, tip_heights, tip_surface
from relieffab.toolpath.simplify import simplify
from relieffab.toolpath.trace import Trace, follow, sample

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Ground:
    """What one cutter goes no lower than: a relief, and a distance from it.

    Parameters
    ----------
    relief : Terrain
        What is wanted.
    cutter : Cutter
    allowance : float
        Distance kept from the relief on every side, mm.
    """

    relief: Terrain
    cutter: Cutter
    allowance: float

    def low(self, places: Places) -> Floats:
        """(rows, count) cutter locations at rows of places, mm."""
        return tip_surface(self.relief, self.cutter, places, allowance=self.allowance)

    @cached_property
    def low_at_nodes(self) -> Floats:
        """(rows + 1, cols + 1) cutter locations at the relief's nodes, mm."""
        return self.low(nodes(self.relief.grid))


@dataclass(frozen=True, eq=False)
class Work:
    """One cutter before one relief, with the stock as it stands by then.

    Parameters
    ----------
    ground : Ground
    stock : Terrain
        What still stands.
    stepdown : float
        Deepest single pass, mm.
    tolerance : float
        Of simplification, mm.
    least : float
        Cuts shallower than this are not worth a move, mm.
    step : float
        Distance of samples along a line, mm.
    """

    ground: Ground
    stock: Terrain
    stepdown: float
    tolerance: float
    least: float
    step: float

    @property
    def relief(self) -> Terrain:
        """What is wanted."""
        return self.ground.relief

    @property
    def cutter(self) -> Cutter:
        """What cuts."""
        return self.ground.cutter

    def top(self, places: Places) -> Floats:
        """(rows, count) heights at which the cutter would first touch the stock, mm."""
        if not self.stock.heights.any():
            return np.zeros((places.rows, places.count))
        return tip_surface(self.stock, self.cutter, places)

    def follow(self, trace: Trace, *, dropped: bool = False) -> tuple[Trace, Floats]:
        """Set a trace at its cutter locations, where it is not `dropped` there already.

        Returns
        -------
        Trace
            Refined.
        ndarray
            (n,) height at which the cutter would first touch the stock, mm.
        """
        allowance = self.ground.allowance
        low = follow(self.relief, self.cutter, trace, allowance=allowance, dropped=dropped)
        top = np.full(len(low), np.nan) if low.top is None else low.top.copy()
        new = np.isnan(top)
        if not self.stock.heights.any():
            top[new] = 0.0
        else:
            top[new] = tip_heights(self.stock, self.cutter, *low.xy[new].T)
        return low, top

    def level(self, low: Trace, top: Floats, number: int) -> Trace:
        """Hold a trace above what pass `number` (from 1) may reach."""
        return replace(low, z=np.maximum(low.z, top - number * self.stepdown))


@dataclass(frozen=True, eq=False)
class Pass:
    """Runs cut one after another at one depth.

    Parameters
    ----------
    work : Work
    number : int
        From 1.
    runs : list of (k, 3) ndarray
        Positions of the tip, mm.
    ceiling : (runs, 2) ndarray
        Where the stock may still stand at each run's start and end, mm.
    fixed : bool
        Whether the runs keep their order and direction.
    """

    work: Work
    number: int
    runs: list[Floats]
    ceiling: Floats
    fixed: bool = False


def passes(work: Work, low: Trace, top: Floats, *, fixed: bool = False) -> Iterator[Pass]:
    """Cut a followed trace into passes, the highest first."""
    above = top - low.z
    number = 1
    while (above > _worth(work, number)).any():
        # A sliver under a fiftieth of the stepdown rides along with the pass before it.
        if number > 1 and above.max() < (number - 1 + 0.02) * work.stepdown:
            return
        yield one_pass(work, low, top, number, fixed=fixed)
        number += 1


def _worth(work: Work, number: int) -> float:
    """Least height of stock over the relief that a pass is worth a move for, mm."""
    return max(work.least, (number - 1) * work.stepdown * (1 + 1e-9))


def one_pass(work: Work, low: Trace, top: Floats, number: int, *, fixed: bool = False) -> Pass:
    """Take from a followed trace what pass `number` has to cut."""
    picked = _with_neighbours(top - low.z > _worth(work, number), low.joined)
    run = np.cumsum(np.insert(~(low.joined & picked[1:] & picked[:-1]), 0, True), dtype=np.intp)
    part = replace(work.level(low, top, number), run=run).pick(picked)
    before = (top - (number - 1) * work.stepdown)[picked]
    breaks = np.diff(part.run) > 0
    starts, ends = np.insert(breaks, 0, True), np.append(breaks, True)
    if not picked.any():
        return Pass(work, number, [], np.zeros((0, 2)), fixed)
    ceiling = np.column_stack([before[starts], before[ends]])
    return Pass(work, number, runs_of(simplify(part, work.tolerance)), ceiling, fixed)


def runs_of(trace: Trace) -> list[Floats]:
    """List the runs of a trace as (k, 3) arrays."""
    points = np.column_stack([trace.xy, trace.z])
    return np.split(points, np.flatnonzero(~trace.joined) + 1)


def at_depth(part: Pass, lines: list[Floats]) -> list[Floats]:
    """Follow lines that are none of the runs at the pass's depth.

    Parameters
    ----------
    part : Pass
    lines : list of (k, 2) ndarray
        X and Y, mm.

    Returns
    -------
    list of (k, 3) ndarray
    """
    if not lines:
        return []
    work = part.work
    low, top = work.follow(sample(lines, work.step))
    return runs_of(simplify(work.level(low, top, part.number), work.tolerance))


def _with_neighbours(picked: Bools, joined: Bools) -> Bools:
    """Add the sample before and after every run of picked ones."""
    wider = picked.copy()
    wider[1:] |= picked[:-1] & joined
    wider[:-1] |= picked[1:] & joined
    return wider
