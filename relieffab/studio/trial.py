"""Trial: the programs of a preview, written and carried out on a virtual stock."""

import tempfile
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.estimate import move_ends
from relieffab.gcode.program import Program
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import Verification, verify
from relieffab.job import chain, programs
from relieffab.job.settings import Job
from relieffab.progress import Progress
from relieffab.studio.preview import Solved
from relieffab.toolpath.positions import Position

Floats = NDArray[np.float64]

STATES = 48
"""Stocks kept between the first move and the last."""


@dataclass(frozen=True, eq=False)
class Run:
    """One program as it runs on the panel.

    Parameters
    ----------
    name : str
        rough, finish or lines.
    cutter : Cutter
    points : (n, 3) ndarray
        Panel mm.
    ends : (n,) ndarray
        When each move ends, seconds since the first program started.
    rapid : (n,) ndarray of bool
    part : dict
        What report.json holds of it.
    """

    name: str
    cutter: Cutter
    points: Floats
    ends: Floats
    rapid: NDArray[np.bool_]
    part: dict[str, Any]


@dataclass(frozen=True, eq=False)
class Tried:
    """Programs and what they leave."""

    runs: tuple[Run, ...]
    verdict: Verification
    notes: tuple[str, ...]
    states: "States"


class Trial:
    """The last trial of a session."""

    def __init__(self) -> None:
        self.last: Tried | None = None

    def carry_out(self, solved: Solved, job: Job, progress: Progress) -> Tried:
        """Plan, write, read back, judge and simulate the programs of a relief."""
        chain.check(job)
        relief, strokes = solved.relief, solved.view.layers.strokes
        planned = chain.plan_paths(relief, strokes, job, progress)
        report = {"model": {"name": job.model}, "settings": {}}
        setup = chain.setup_of(job, relief.depth)
        with tempfile.TemporaryDirectory(prefix="relieffab-") as name:
            folder = Path(name)
            progress("programs", 0, 1)
            parts = programs.write(planned, relief, job, report, folder)
            progress("programs", 1, 1)
            texts = {
                part["file"]: (folder / part["file"]).read_text(encoding="ascii")
                for part in parts["programs"]
            }
        whole = [
            read_program(text, name=file, dialect=setup.post.dialect)
            for file, text in texts.items()
        ]
        cutters = [Cutter(**part["cutter"]) for part in parts["programs"]]
        positions = [_position(part) for part in parts["programs"]]
        verdict = verify(
            whole, cutters, relief, setup, positions=positions, refine=1, progress=progress
        )
        runs = _runs(whole, cutters, positions, parts["programs"], setup)
        states = States(runs, Slab.whole(relief.grid, setup.stock), progress)
        notes = (*parts["material"]["notes"],)
        self.last = Tried(runs, verdict, notes, states)
        return self.last

    def carved(self, at: float) -> Slab:
        """Give the stock as it is at a moment of the last trial."""
        if self.last is None:
            raise InputError("there are no toolpaths yet", hint="ask for toolpaths first")
        return self.last.states.at(at)


def _position(part: dict[str, Any]) -> Position | None:
    return Position.of(part["position"]) if part.get("position") else None


def _runs(
    whole: list[Program],
    cutters: list[Cutter],
    positions: list[Position | None],
    parts: list[dict[str, Any]],
    setup: Setup,
) -> tuple[Run, ...]:
    runs, start = [], 0.0
    each = [part for program in whole for part in program.by_tool()]
    for program, cutter, position, part in zip(each, cutters, positions, parts, strict=True):
        ends = start + move_ends(program, setup.machine)
        points = program.on_panel(setup.at(position).stock)
        kind = part["file"].removesuffix(".nc").rpartition("-")[2]
        runs.append(Run(kind, cutter, points, ends, program.rapid, part))
        start = float(ends[-1]) + float(program.dwell[-1])
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
                slab.cut(run.points[first : last + 1], run.cutter)
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
        slab.cut(way, run.cutter)
        return slab
