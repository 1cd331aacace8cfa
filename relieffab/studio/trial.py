"""Trial: the programs of a preview, carried out on a virtual stock."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.gcode.estimate import move_ends
from relieffab.gcode.pacing import Paced
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import Verification, verify
from relieffab.job import milling, programs
from relieffab.job.settings import Job
from relieffab.progress import Progress
from relieffab.stock import Stock
from relieffab.studio.solved import Solved
from relieffab.toolpath.path import Toolpath

Floats = NDArray[np.float64]

STATES = 48
"""Stocks kept between the first move and the last."""


@dataclass(frozen=True, eq=False)
class Run:
    """One program as it runs on the panel.

    Parameters
    ----------
    file : str
        That the job will write.
    path : Toolpath
    points : (n, 3) ndarray
        Panel mm.
    ends : (n,) ndarray
        When each move ends, seconds since the first program started.
    seconds : float
        Of this program.
    rapid : (n,) ndarray of bool
    lines : int
        Of its text, comments aside.
    placing : str
        How the stock lies; empty where it is not moved.
    """

    file: str
    path: Toolpath
    points: Floats
    ends: Floats
    seconds: float
    rapid: NDArray[np.bool_]
    lines: int
    placing: str


@dataclass(frozen=True, eq=False)
class Tried:
    """Programs and what they leave.

    Parameters
    ----------
    runs : tuple of Run
    verdict : Verification
    notes : tuple of str
        What a person should know.
    states : States
    stock : Stock
    """

    runs: tuple[Run, ...]
    verdict: Verification
    notes: tuple[str, ...]
    states: "States"
    stock: Stock


class Trial:
    """The last trial of a session."""

    def __init__(self) -> None:
        self.last: Tried | None = None

    def carry_out(self, solved: Solved, job: Job, progress: Progress) -> Tried:
        """Plan the programs of a relief, judge them and carve a virtual stock."""
        milling.check(job)
        if job.round is not None:
            raise InputError(
                "the programs of a round stock are not shown here",
                where="round",
                hint="Export makes them, and judges them",
            )
        relief, strokes = solved.relief, solved.view.layers.strokes
        marks = [solved.marks] if solved.marks else []
        planned = milling.plan_paths(relief, strokes, job, progress, marks=marks)
        whole = milling.setup_of(job, relief.depth)
        slab = Slab.whole(relief.grid, whole.stock)
        fitted = [
            (whole.at(position), one)
            for position, paths in planned
            for one in programs.fitted_to(paths, whole.at(position), slab, progress)
        ]
        verdict = verify(
            [one.program for _, one in fitted],
            [one.path.cutter for _, one in fitted],
            relief,
            whole,
            positions=[setup.position for setup, _ in fitted],
            refine=1,
            progress=progress,
        )
        runs = _runs(fitted)
        notes = programs.notes_on(whole, [one for _, one in fitted])
        self.last = Tried(runs, verdict, tuple(notes), States(runs, slab, progress), whole.stock)
        return self.last

    def carved(self, at: float) -> tuple[Slab, Stock]:
        """Give what is left at a moment of the last trial, and of what stock.

        Raises
        ------
        InputError
            If there was none yet.
        """
        if self.last is None:
            raise InputError("there are no toolpaths yet", hint="ask for toolpaths first")
        return self.last.states.at(at), self.last.stock


def _runs(fitted: Sequence[tuple[Setup, Paced]]) -> tuple[Run, ...]:
    runs, start = [], 0.0
    for setup, one in fitted:
        program, path = one.program, one.path
        ends = move_ends(program, setup.machine)
        seconds = float(ends[-1] + program.dwell[-1])
        runs.append(
            Run(
                programs.file_name(setup, path),
                path,
                program.on_panel(setup.stock),
                start + ends,
                seconds,
                program.rapid,
                program.line_count,
                setup.position.placing if setup.position else "",
            )
        )
        start += seconds
    return tuple(runs)


class States:
    """The stock at any moment, from states kept between.

    Parameters
    ----------
    runs : tuple of Run
    slab : Slab
        Untouched.
    progress : Progress
    """

    def __init__(self, runs: tuple[Run, ...], slab: Slab, progress: Progress) -> None:
        self._runs = runs
        self.seconds = float(runs[-1].ends[-1])
        self._kept: list[tuple[int, int, Slab]] = []
        slab = slab.copy()
        for k, run in enumerate(runs):
            share = (run.ends[-1] - run.ends[0]) / max(self.seconds, 1e-9)
            count = max(2, round(STATES * share) + 1)
            marks = np.unique(np.linspace(0, len(run.points) - 1, count).astype(int)).tolist()
            for first, last in pairwise(marks):
                self._kept.append((k, first, slab.copy()))
                slab.cut(run.points[first : last + 1], run.path.cutter)
                progress("simulation", float(run.ends[last]), self.seconds, "s")
        self._kept.append((len(runs) - 1, len(runs[-1].points) - 1, slab.copy()))

    def at(self, seconds: float) -> Slab:
        """Give the stock at a moment; a slab of its own."""
        before = [
            (k, first, slab)
            for k, first, slab in self._kept
            if self._runs[k].ends[first] <= seconds
        ]
        k, first, slab = (before or self._kept)[-1 if before else 0]
        run, slab = self._runs[k], slab.copy()
        last = int(np.searchsorted(run.ends, seconds, side="right")) - 1
        way = run.points[first : max(last, first) + 1]
        if 0 <= last < len(run.points) - 1:
            span = run.ends[last + 1] - run.ends[last]
            share = (seconds - run.ends[last]) / span if span > 0 else 1.0
            way = np.concatenate(
                [way, [run.points[last] + share * (run.points[last + 1] - run.points[last])]]
            )
        slab.cut(way, run.path.cutter)
        return slab
