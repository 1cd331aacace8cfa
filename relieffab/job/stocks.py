"""The stock a job is carved from: what it is, and its files, drawn beside all else."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.fittings import Frame, Hole, Keyhole
from relieffab.job.settings import Job
from relieffab.machine import Machine
from relieffab.panel.blank import Drafting, drafting
from relieffab.panel.cad import CadUnavailableError
from relieffab.panel.formats import FRAME, STOCK
from relieffab.stock import Stock

Part = dict[str, Any]


def stock_of(job: Job) -> Stock:
    """Return the slab a job is carved from.

    Raises
    ------
    InputError
        If frame, corners or holes do not fit it or each other, or what is given is of
        none of them.
    """
    for name, what in (("frame_edge", "frame"), ("countersink", "holes")):
        if getattr(job, name) is not None and getattr(job, what) is None:
            raise InputError(f"{name} is given, but no {what}", where=name, hint=f"--{what}, too")
    frame = None if job.frame is None else Frame(job.frame, job.frame_height, job.frame_edge)
    return Stock.zeroed(
        (*job.size, job.thickness),
        job.work_zero,
        job.work_zero_z,
        shape=job.outline,
        corner=job.corner,
        frame=frame,
        holes=tuple(Hole(at, job.hole, job.countersink) for at in job.holes or ()),
        keyholes=tuple(Keyhole(at) for at in job.keyholes or ()),
    )


def machine_of(job: Job) -> Machine:
    """Return the machine of a job; over a raised frame it keeps higher."""
    machine = profiles.machine(job.machine)
    return replace(machine, safe_height=machine.safe_height + stock_of(job).top)


@contextmanager
def stock_files(job: Job, folder: Path) -> Iterator[tuple[Drafting, Part]]:
    """Write stock.step and frame.step beside whatever else is done.

    The part, report.json's `stock`, says whether they came to be: a plain slab
    does without them.
    """
    part: Part = {"file": None, "note": ""}
    with drafting(stock_of(job), folder) as work:
        yield work, part
        try:
            work.finish()
        except CadUnavailableError as missing:
            part["note"] = str(missing)
            return
    part["file"] = STOCK
    if work.stock.frame:
        part["frame"] = FRAME
