"""From a relief to one toolpath a cutter: roughing, finishing, lines, marks."""

from collections.abc import Callable, Sequence
from functools import partial

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.layers.model import Stroke
from relieffab.machine import Machine, Material, cutting
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief
from relieffab.relief.style.model import Marks
from relieffab.stock import Stock
from relieffab.toolpath.bench import Bench
from relieffab.toolpath.check import check, check_stepover
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.finish import scallop_stepover
from relieffab.toolpath.link import Linking, link
from relieffab.toolpath.passes import Pass
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.positions import Position
from relieffab.toolpath.settings import Settings

Stage = Callable[[Cutter, float], list[Pass]]

NAMES = ("rough", "finish", "lines", "marks")

REACH = 6.0
"""Ways shorter than this from cut to cut cost less than a retract, mm."""


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
    position: Position | None = None,
    marks: Sequence[Marks] = (),
    progress: Progress = silent,
) -> tuple[Toolpath, ...]:
    """Plan the carving of a relief.

    One with a chisel's marks is carved without them first, and they are cut last.

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
    position : Position, optional
        Where the machine cannot reach all of the stock: what is cut is within this window.
    marks : sequence of Marks, optional
        Of the relief, one for each cutter that makes them; all of one smooth relief.
    progress : Progress

    Returns
    -------
    tuple of Toolpath
        Those of 'rough', 'finish', 'lines' and 'marks' that have anything to cut; at a position
        there may be none.  A second cutter's marks are 'marks-2'.

    Raises
    ------
    InputError
        If the job cannot be done, or nothing is to be cut.
    """
    cutters = cutters or default_cutters()
    settings = settings or Settings()
    stepover = settings.stepover
    stepover = scallop_stepover(cutters[1], settings.scallop) if stepover is None else stepover
    used = (*cutters, *(one.cutter for one in marks))
    slab = stock or _bare_stock(relief)
    check(relief, machine, used, slab, stepover, position)
    check_stepover(scallop_stepover(cutters[2], settings.scallop), cutters[2])
    uses = [cutting(cutter, material, machine) for cutter in used]
    paths: list[Toolpath] = []

    def tell() -> None:
        progress("toolpaths", len(paths), len(used), "programs")

    terrain = Terrain.of(marks[0].smooth if marks else relief, slab.radius)
    part = _part(terrain, position, used)
    bench = Bench(part, settings, position, tell, slab.face(part.grid.node_axes()[0]))
    stages: list[Stage] = [bench.rough, bench.finish, partial(bench.lines, strokes=strokes)]
    if marks:
        marked = _part(Terrain.of(relief, slab.radius), position, used)
        stages += [partial(bench.marks, marked=marked, lines=one.lines) for one in marks]
    names = (*NAMES, *(f"{NAMES[-1]}-{k}" for k in range(2, len(marks) + 1)))
    for name, cutter, use, stage in zip(names, used, uses, stages, strict=False):
        tell()
        parts = stage(cutter, use.stepdown)
        points, feed = link(parts, Linking(machine, use, REACH, ramp=name == "rough"))
        if len(points):
            paths.append(Toolpath(name, points, feed, cutter, use.rpm))
    progress("toolpaths", len(used), len(used), "programs")
    if not paths and position is None:
        raise InputError(
            "there is nothing to cut: the relief is shallower than the least cut",
            hint="a larger depth",
        )
    return tuple(paths)


def _part(terrain: Terrain, position: Position | None, cutters: Sequence[Cutter]) -> Terrain:
    """Take what cutters may touch from a window, and as much again."""
    if position is None:
        return terrain
    reach = 2 * max(max(cutter.radius, cutter.shank_radius) for cutter in cutters)
    return terrain.within(position.low, position.high, reach)


def _bare_stock(relief: Relief) -> Stock:
    """Stock that just holds the relief, where none is given."""
    x, y = relief.grid.node_axes()
    return Stock(float(x[-1]), float(y[0]), relief.depth + 1.0)
