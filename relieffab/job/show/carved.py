"""A program, run on a virtual stock that is lit as it leaves it."""

from pathlib import Path

import numpy as np

from relieffab.gcode.estimate import estimate
from relieffab.gcode.simulate import simulate
from relieffab.grid import Grid
from relieffab.job.show.lit import Lit
from relieffab.job.show.maker import Run, run_of
from relieffab.job.show.shown import Shown, stock_facts
from relieffab.picture.stone import shade
from relieffab.progress import Progress, silent

PIXELS = 1024  # along the stock's longer side


def show_program(
    path: Path,
    lit: Lit,
    *,
    cutter: str | None = None,
    machine: str | None = None,
    progress: Progress = silent,
) -> Shown:
    """Carve a stock by a program, and by those of its job that come before it.

    Parameters
    ----------
    path : Path
    lit : Lit
    cutter, machine : str, optional
        Names of profiles, for a program that does not tell what it was made for.
    progress : Progress
        Told of mm run.
    """
    run = run_of(path, cutter=cutter, machine=machine)
    stock = run.stock
    grid = Grid.on_panel((stock.width, stock.height), (PIXELS, PIXELS))
    carved = simulate(run.programs, run.cutters, grid, stock, refine=1, progress=progress)
    heights = carved.heights.astype(float)
    deepest = float((stock.face(carved.grid.node_axes()[0]) - heights).max())
    if stock.radius:  # its relief upright, as `relieffab.relief.laid.upright` lays it
        heights = heights.T
    image = shade(heights, carved.grid.pitch, lit.light, texture=lit.texture)
    before = [one.name for one in run.programs if one.name != path.name]
    notes = list(carved.crashes)
    if before:
        notes.append("carved before it: " + ", ".join(dict.fromkeys(before)))
    return Shown("program", _facts(run, deepest), image, notes=tuple(notes))


def _facts(run: Run, deepest: float) -> dict[str, object]:
    boxes = np.array([part.bounds for part in run.asked])
    stock = run.stock
    return {
        "cutters": [cutter.name for cutter in run.cutters[-len(run.asked) :]],
        "machine": run.machine.name,
        **stock_facts(stock),
        "work_zero_mm": list(stock.work_zero),
        "bounds_mm": [
            boxes[:, 0].min(axis=0).round(4).tolist(),
            boxes[:, 1].max(axis=0).round(4).tolist(),
        ],
        "lines": run.asked[0].line_count,
        "seconds": round(sum(estimate(part, run.machine) for part in run.asked), 1),
        "cut_mm": round(sum(part.cutting_length for part in run.asked), 1),
        "deepest_mm": round(deepest, 4),
    }
