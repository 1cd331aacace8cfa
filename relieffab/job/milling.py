"""How a job is milled: its cutters, its setup, its positions, its toolpaths."""

from collections.abc import Sequence
from typing import cast

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.fittings import PLACES
from relieffab.gcode.setup import Setup
from relieffab.gcode.write import check_change
from relieffab.job import reliefs, solids, styles
from relieffab.job.settings import Job
from relieffab.job.stocks import machine_of, milled_of, round_of, stock_of
from relieffab.layers.model import Stroke
from relieffab.progress import Progress, silent
from relieffab.relief.laid import laid, laid_marks, laid_strokes
from relieffab.relief.model import Relief
from relieffab.relief.style.model import Marks
from relieffab.toolpath.check import check_stepover, check_tools
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.plan import plan
from relieffab.toolpath.positions import Position, positions
from relieffab.toolpath.settings import Milling, Settings

Planned = tuple[Position | None, tuple[Toolpath, ...]]
"""What is cut at a position; at None where the stock stays where it is."""


def cutters_of(job: Job) -> tuple[Cutter, Cutter, Cutter]:
    """Return the cutters of roughing, finishing and lines."""
    return profiles.cutter(job.rough), profiles.cutter(job.finish), profiles.cutter(job.lines)


def all_cutters_of(job: Job, marks: Sequence[Marks] | None = None) -> tuple[Cutter, ...]:
    """Return the cutters of all programs, those of marks too: the job's style's if not given."""
    if marks is not None:
        return (*cutters_of(job), *(one.cutter for one in marks))
    style = styles.style_of(job)
    return cutters_of(job) if style.plain else (*cutters_of(job), style.tool)


def setup_of(job: Job, depth: float) -> Setup:
    """Return what the programs of a relief are written for, and judged by."""
    machine, material = machine_of(job), profiles.material(job.material)
    stock = milled_of(job)
    return Setup(machine, material, stock, stock.lowest(depth), job.units)


def positions_of(job: Job, marks: Sequence[Marks] | None = None) -> tuple[Position | None, ...]:
    """Return how the stock lies, time after time; (None,) where it need not be moved."""
    if job.positions is None:
        return (None,)
    if round_of(job) is not None:
        raise InputError("only a flat panel is cut at several positions", where="positions")
    found = positions(
        stock_of(job),
        machine_of(job),
        all_cutters_of(job, marks),
        job.positions,
        overlap=job.overlap,
        zero=PLACES[job.work_zero],
    )
    return found or (None,)


def cut_settings(job: Job) -> Settings:
    """Return how finely a job is cut, and which way round."""
    angle, crossed = job.rows
    milling = cast(Milling, job.milling)
    return Settings(job.stepover, job.scallop, angle=angle, crossed=crossed, milling=milling)


def check(job: Job, marks: Sequence[Marks] | None = None) -> None:
    """Refuse what can be seen to fail before any work is done.

    Parameters
    ----------
    job : Job
    marks : sequence of Marks, optional
        Of a relief that is there already.

    Raises
    ------
    InputError
        If a profile is unknown, or machine, cutters, stock and depth do not fit.
    """
    styles.check(job)
    reliefs.carving_of(job)
    solids.check(job)
    cutters = all_cutters_of(job, marks)
    setup = setup_of(job, job.depth)
    check_change(len(cutters) if job.cutter_change == "pause" else 1, setup)
    for position in positions_of(job, marks):
        check_tools(setup.machine, cutters, setup.stock, setup.depth, position)
    cut_settings(job)
    if job.stepover is not None:
        check_stepover(job.stepover, cutters[1])


def plan_paths(
    relief: Relief,
    strokes: Sequence[Stroke],
    job: Job,
    progress: Progress = silent,
    *,
    marks: Sequence[Marks] = (),
) -> tuple[Planned, ...]:
    """Plan the toolpaths of a job, position after position."""
    stock = milled_of(job)
    milled, lines = laid(relief, stock), laid_strokes(strokes, relief, stock)
    planned = [
        (
            position,
            plan(
                milled,
                lines,
                machine_of(job),
                profiles.material(job.material),
                cutters=cutters_of(job),
                stock=stock,
                settings=cut_settings(job),
                position=position,
                marks=[laid_marks(one, relief, stock) for one in marks],
                progress=progress,
            ),
        )
        for position in positions_of(job, marks)
    ]
    cut = tuple((position, paths) for position, paths in planned if paths)
    if not cut:
        raise InputError(
            "there is nothing to cut: the relief is shallower than the least cut",
            hint="a larger depth",
        )
    return cut
