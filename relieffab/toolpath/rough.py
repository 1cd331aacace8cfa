"""Roughing: most of the stock, in levels, with an allowance left for finishing."""

from math import ceil

from relieffab.cutter import Cutter
from relieffab.toolpath.envelope import Places, Terrain
from relieffab.toolpath.passes import Ground, Pass, Work, one_pass
from relieffab.toolpath.positions import Position
from relieffab.toolpath.trace import sample
from relieffab.toolpath.waterline import offsets

STEPOVER = 0.4
"""Of the cutter's diameter: between two lines nothing stays, in corners little."""

_TOLERANCE = 0.02
_LEAST = 0.1
_LATTICE = 0.05
_SLIVER = 0.02


def rough_work(
    relief: Terrain, stock: Terrain, cutter: Cutter, stepdown: float, allowance: float
) -> Work:
    """Set a roughing cutter before the whole slab.

    Parameters
    ----------
    relief, stock : Terrain
        What is wanted, and the uncut stock.
    cutter : Cutter
    stepdown, allowance : float
        mm.
    """
    step = min(relief.grid.pitch, allowance)
    ground = Ground(relief, cutter, allowance)
    return Work(ground, stock, stepdown, _TOLERANCE, _LEAST, step)


def rough_passes(
    work: Work, *, reverse: bool = False, position: Position | None = None
) -> list[Pass]:
    """Clear level after level, each from the middle of its patches outwards.

    A level is cleared where something stands above it, and nowhere else; where the
    relief itself lies between this level and the last, the cutter follows it.

    Parameters
    ----------
    work : Work
    reverse : bool
        Conventional milling instead of climb milling.
    position : Position, optional
        Whose window the cutter's axis keeps to.
    """
    grid, step = work.relief.grid, _LATTICE * work.cutter.diameter
    rows, count = (ceil(side * grid.pitch / step) + 1 for side in grid.shape)
    places = Places(grid.origin, 0.0, step, step, rows, count)
    above = work.top(places) - work.ground.low(places)
    if position is not None:
        above[~position.holds(*places.xy())] = 0.0
    found: list[Pass] = []
    while above.max() > max(work.least, (len(found) + _SLIVER) * work.stepdown):
        worth = max(work.least, len(found) * work.stepdown)
        lines = offsets(above > worth, places, STEPOVER * work.cutter.diameter)
        lines = [line[::-1] for line in lines] if reverse else lines
        trace = sample(lines, work.step)
        if position is not None:
            trace = trace.clipped(position.holds(*trace.xy.T))
        low, top = work.follow(trace)
        found.append(one_pass(work, low, top, len(found) + 1, fixed=True))
    return found
