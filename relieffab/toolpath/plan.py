"""From a relief to one toolpath a cutter: roughing, finishing, lines."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.layers.model import Stroke
from relieffab.machine import Cutting, Machine, Material, cutting
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath import remains
from relieffab.toolpath.check import check, check_stepover
from relieffab.toolpath.engrave import stroke_trace
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.finish import finish_rows, scallop_stepover
from relieffab.toolpath.link import Linking, link
from relieffab.toolpath.passes import Pass, Work, passes
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.rough import STEPOVER, rough_rows, rough_work
from relieffab.toolpath.trace import SKIN, Trace

Floats = NDArray[np.float64]

NAMES = ("rough", "finish", "lines")


@dataclass(frozen=True)
class Settings:
    """How finely to carve; every length in mm.

    Parameters
    ----------
    stepover : float, optional
        Between finishing rows; from the scallop height where not given.
    scallop : float
        Height of the ridges between rows on flat ground.
    allowance : float
        What roughing leaves for finishing, on every side.
    tolerance : float
        Largest distance of simplified paths from the exact ones, upwards only.
    rest : float
        What the finishing cutter may leave before the finest one cuts again.
    """

    stepover: float | None = None
    scallop: float = 0.01
    allowance: float = 0.3
    tolerance: float = 0.004
    rest: float = 0.05

    def __post_init__(self) -> None:
        for name in ("scallop", "allowance", "tolerance", "rest"):
            value = getattr(self, name)
            if not 0 < value <= 5:
                raise InputError(f"{name} cannot be {value:g} mm", expected="more than 0, up to 5")


def default_cutters() -> tuple[Cutter, Cutter, Cutter]:
    """Return the cutters of roughing, finishing and lines."""
    return (
        profiles.cutter("flat-3.175"),
        profiles.cutter("tapered-ball-1"),
        profiles.cutter("tapered-ball-0.5"),
    )


def plan(
    relief: Relief,
    strokes: Sequence[Stroke],
    machine: Machine,
    material: Material,
    *,
    cutters: tuple[Cutter, Cutter, Cutter] | None = None,
    stock: Stock | None = None,
    settings: Settings | None = None,
    progress: Progress = silent,
) -> tuple[Toolpath, ...]:
    """Plan the carving of a relief.

    Parameters
    ----------
    relief : Relief
    strokes : sequence of Stroke
        Lines to go over with the finest cutter.
    machine : Machine
    material : Material
    cutters : tuple of Cutter, optional
        For roughing, finishing and lines.
    stock : Stock, optional
        The slab; by default as large as the relief's grid and thick enough.
    settings : Settings, optional
    progress : Progress

    Returns
    -------
    tuple of Toolpath
        Those of 'rough', 'finish' and 'lines' that have anything to cut.

    Raises
    ------
    InputError
        If the job cannot be done, or nothing is to be cut.
    """
    cutters = cutters or default_cutters()
    settings = settings or Settings()
    stepover = settings.stepover
    stepover = scallop_stepover(cutters[1], settings.scallop) if stepover is None else stepover
    check(relief, machine, cutters, stock or _bare_stock(relief), stepover)
    terrain = Terrain.of(relief)
    uses = [cutting(cutter, material, machine) for cutter in cutters]
    paths = []
    left = np.zeros(relief.grid.node_shape)

    progress("toolpaths", 0, 3, "programs")
    work = rough_work(terrain, cutters[0], uses[0].stepdown, settings.allowance)
    parts, left = _cut(work, rough_rows(work), left)
    reach = 1.5 * STEPOVER * work.cutter.diameter
    paths += _toolpath("rough", cutters[0], parts, Linking(machine, uses[0], reach, ramp=True))

    progress("toolpaths", 1, 3, "programs")
    work = _fine_work(terrain, left, cutters[1], uses[1], settings)
    work = replace(work, least=min(0.01, settings.rest))
    parts, left = _cut(work, finish_rows(work, stepover), left)
    paths += _toolpath(
        "finish", cutters[1], parts, Linking(machine, uses[1], max(1.0, 2 * stepover))
    )

    progress("toolpaths", 2, 3, "programs")
    work = _fine_work(terrain, left, cutters[2], uses[2], settings)
    along, left = _cut(replace(work, least=0.02), stroke_trace(strokes, work), left)
    work = replace(work, stock=Terrain.over(relief.grid, left))
    stepover = scallop_stepover(cutters[2], settings.scallop)
    check_stepover(stepover, cutters[2])
    across, left = _cut(work, finish_rows(work, stepover), left)
    parts = [*along, *across]
    paths += _toolpath(
        "lines", cutters[2], parts, Linking(machine, uses[2], max(1.0, 2 * stepover))
    )
    progress("toolpaths", 3, 3, "programs")
    if not paths:
        raise InputError(
            "there is nothing to cut: the relief is shallower than the least cut",
            hint="a larger depth",
        )
    return tuple(paths)


def _bare_stock(relief: Relief) -> Stock:
    """Stock that just holds the relief, where none is given."""
    x, y = relief.grid.node_axes()
    return Stock(float(x[-1]), float(y[0]), relief.depth + 1.0)


def _fine_work(
    terrain: Terrain, left: Floats, cutter: Cutter, use: Cutting, settings: Settings
) -> Work:
    """Set a finishing cutter before what is left."""
    stock = Terrain.over(terrain.grid, left)
    # The skin makes every bump wider than this, so that none passes between two samples.
    step = min(terrain.grid.pitch / 2, 0.2 * max(cutter.arc_end, 0.1))
    return Work(
        terrain,
        stock,
        cutter,
        use.stepdown,
        SKIN,
        settings.tolerance,
        settings.rest,
        step,
    )


def _cut(work: Work, trace: Trace, left: Floats) -> tuple[list[Pass], Floats]:
    """Cut along a trace; what is left after all its passes."""
    if len(trace) == 0:
        return [], left
    low, top = work.follow(trace)
    cut = top - low.z > work.least
    tips = np.column_stack([low.xy, low.z + work.tolerance])[cut]
    left = remains.after(left, work.relief.grid, work.cutter, tips)
    return list(passes(work, low, top)), left


def _toolpath(name: str, cutter: Cutter, parts: list[Pass], linking: Linking) -> list[Toolpath]:
    points, feed = link(parts, linking)
    if len(points) == 0:
        return []
    return [Toolpath(name, points, feed, cutter, linking.cutting.rpm)]
