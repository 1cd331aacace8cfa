"""Lines on the panel turned into cutter locations, close enough that no chord gouges.

A cutter-location surface bends sharply beside a wall, and a flat cutter's jumps.
Lines are sampled evenly, then halved wherever the chord between two samples may
pass below the surface; what doubt remains lifts the samples.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.toolpath.envelope import Terrain, tip_heights

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.intp]

SKIN = 0.003
"""Least distance kept from the surface, mm: more than a program's rounded coordinates lose."""

_SAG = 0.0015
_SHORTEST = 0.002
_GENTLE = 0.5
_LEVEL = 0.05
_HIDDEN = 0.0005
_SHOWN = 0.0001


@dataclass(frozen=True, eq=False)
class Trace:
    """Runs of samples, one after another.

    Parameters
    ----------
    xy : (n, 2) ndarray
        The cutter's axis on the panel, mm.
    z : (n,) ndarray
        Height of the tip, mm.
    run : (n,) ndarray of int
        Which run each sample belongs to, ascending.
    corner : (n,) ndarray of bool
        Where the line may turn.
    top : (n,) ndarray, optional
        Height at which the cutter would first touch the stock, mm; NaN where nobody
        has looked yet.
    """

    xy: Floats
    z: Floats
    run: Ints
    corner: Bools
    top: Floats | None = None

    def __len__(self) -> int:
        return len(self.z)

    def pick(self, where: Bools) -> "Trace":
        """Keep some samples."""
        top = None if self.top is None else self.top[where]
        return Trace(self.xy[where], self.z[where], self.run[where], self.corner[where], top)

    def clipped(self, where: Bools) -> "Trace":
        """Keep some samples; a run ends where the next sample of it is gone."""
        parted = ~(self.joined & where[1:] & where[:-1])
        run = np.cumsum(np.concatenate([[0], parted])).astype(np.intp)
        return replace(self, run=run[: len(self)]).pick(where)

    def turned(self) -> "Trace":
        """Go along every run the other way, in the order they are in."""
        index = np.lexsort((-np.arange(len(self)), self.run))
        top = None if self.top is None else self.top[index]
        return Trace(self.xy[index], self.z[index], self.run[index], self.corner[index], top)

    @property
    def joined(self) -> Bools:
        """(n - 1,) whether each sample and the next are of one run."""
        return self.run[1:] == self.run[:-1]

    @property
    def steps(self) -> Floats:
        """(n - 1,) distance on the panel from each sample to the next, mm."""
        gaps = np.diff(self.xy, axis=0)
        return np.hypot(gaps[:, 0], gaps[:, 1])


def sample(lines: Sequence[Floats], step: float) -> Trace:
    """Set samples along lines, at every vertex and at most `step` apart; z is 0 yet.

    Parameters
    ----------
    lines : sequence of (k, 2) ndarray
        X and Y, mm.
    step : float
        mm.
    """
    xy, run, corner = [np.zeros((0, 2))], [np.zeros(0, np.intp)], [np.zeros(0, bool)]
    for number, line in enumerate(lines):
        lengths = np.hypot(*np.diff(line, axis=0).T)
        pieces = np.maximum(np.ceil(lengths / step - 1e-9), 2).astype(int)
        ends = np.concatenate([[0], np.cumsum(pieces)])
        places = np.arange(ends[-1] + 1)
        at = [np.interp(places, ends, line[:, axis]) for axis in (0, 1)]
        xy.append(np.stack(at, axis=1))
        run.append(np.full(len(places), number, np.intp))
        corner.append(np.isin(places, ends))
    points = np.concatenate(xy)
    return Trace(points, np.zeros(len(points)), np.concatenate(run), np.concatenate(corner))


def follow(
    terrain: Terrain,
    cutter: Cutter,
    trace: Trace,
    *,
    allowance: float = SKIN,
    dropped: bool = False,
) -> Trace:
    """Set a trace at its cutter locations and refine it until no chord can gouge.

    Parameters
    ----------
    terrain : Terrain
    cutter : Cutter
    trace : Trace
    allowance : float
        mm.
    dropped : bool
        Whether `z` holds the cutter locations already.

    Returns
    -------
    Trace
        With samples added; `z` nowhere below the cutter-location surface, nor
        is any straight line between neighbours, to within micrometres sideways.
    """
    if not dropped:
        trace = replace(trace, z=tip_heights(terrain, cutter, *trace.xy.T, allowance=allowance))
    proved = np.zeros(max(len(trace) - 1, 0), bool)
    # What a ball may meet between two samples shows beside them; other shapes hide it.
    gentle, seen = (_GENTLE, _SHOWN) if cutter.shape == "ball" else (_LEVEL, 0.0)
    while len(trace) > 1:
        steps = trace.steps
        # Where the way is steep a bend hides more height.
        slope = np.abs(np.diff(trace.z)) / np.maximum(steps, _SHORTEST)
        long = trace.joined & (steps > _SHORTEST)
        doubt = _doubt(trace) * np.maximum(slope, 1.0)
        split = long & (doubt > _SAG)
        looking = not split.any()
        if looking:
            split = long & (slope > gentle) & (doubt >= seen) & ~proved
            if not split.any():
                return _lifted(trace)
        at = np.flatnonzero(split)
        middle = 0.5 * (trace.xy[at] + trace.xy[at + 1])
        z = tip_heights(terrain, cutter, *middle.T, allowance=allowance)
        if looking:
            above = z - 0.5 * (trace.z[at] + trace.z[at + 1]) > _HIDDEN
            proved[at[~above]] = True
            at, middle, z = at[above], middle[above], z[above]
        proved[at] = False
        proved = np.insert(proved, at, False)
        trace = Trace(
            np.insert(trace.xy, at + 1, middle, axis=0),
            np.insert(trace.z, at + 1, z),
            np.insert(trace.run, at + 1, trace.run[at]),
            np.insert(trace.corner, at + 1, False),
            None if trace.top is None else np.insert(trace.top, at + 1, np.nan),
        )
    return trace


def _doubt(trace: Trace) -> Floats:
    """Bound how far the surface may rise above the chord of each interval, mm.

    Where it is concave the neighbouring chords, prolonged, pass above it; where
    one side bends much more than the other, a bend may hide inside, and a quarter
    of that side's rise is taken.  Beyond a run's
    end or a corner the surface is taken to be level.
    """
    steps, joined = np.maximum(trace.steps, 1e-12), trace.joined
    slope = np.diff(trace.z) / steps
    smooth = joined[1:] & joined[:-1] & ~trace.corner[1:-1]
    before = np.insert(np.where(smooth, slope[:-1], 0.0), 0, 0.0) - slope
    after = slope - np.append(np.where(smooth, slope[1:], 0.0), 0.0)
    left, right = before.clip(0), after.clip(0)
    both = left * right / np.maximum(left + right, 1e-12)
    one = 0.25 * (np.maximum(left, right) - 2 * np.minimum(left, right))
    return np.where(joined, np.maximum(both, one) * steps, 0.0)


def _lifted(trace: Trace) -> Trace:
    """Raise the samples by the doubt that is left; across a jump, to its upper side."""
    doubt = _doubt(trace)
    pair_top = np.maximum(trace.z[1:], trace.z[:-1])
    jump = doubt > _SAG
    z = trace.z.copy()
    for side in (slice(None, -1), slice(1, None)):
        raised = np.where(jump, pair_top, trace.z[side] + doubt)
        z[side] = np.maximum(z[side], raised)
    return replace(trace, z=z)
