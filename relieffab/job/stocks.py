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
from relieffab.machine import Machine, turning
from relieffab.panel.blank import Drafting, drafting
from relieffab.panel.cad import CadUnavailableError
from relieffab.panel.formats import FRAME, STOCK
from relieffab.round import Curved, Round
from relieffab.stock import Stock

Part = dict[str, Any]


def round_of(job: Job) -> Round | Curved | None:
    """Return the round stock or curved board that a job's panel is bent over, if any.

    Raises
    ------
    InputError
        If there is no such stock, or it has what only a flat slab has.
    """
    for name, what in (("bore", "round"), ("floor", "bore")):
        if getattr(job, name) is not None and getattr(job, what) is None:
            raise InputError(f"{name} is given, but no {what}", where=name, hint=f"--{what}, too")
    if job.round is not None and job.curved is not None:
        raise InputError("a stock is round or curved, not both", where="curved")
    width, height = job.size
    bent: Round | Curved
    if job.round is not None:
        bent = Round(width, height, job.round, job.bore or 0.0, job.floor or 0.0)
    elif job.curved is not None:
        bent = Curved(width, height, job.thickness, job.curved)
    else:
        return None
    flat = [name for name in ("frame", "holes", "keyholes") if getattr(job, name) is not None]
    flat += ["outline"] if job.outline != "rectangle" else []
    flat += ["corner"] if job.corner else []
    if flat:
        raise InputError(
            f"only a flat panel can have {flat[0]}",
            found=f"{'round' if job.round else 'curved'}, too",
            where=flat[0],
        )
    return bent


def stock_of(job: Job) -> Stock:
    """Return the slab a job is carved from; of a round stock, its face laid out flat.

    Raises
    ------
    InputError
        If frame, corners or holes do not fit it or each other, or what is given is of
        none of them.
    """
    bent = round_of(job)
    for name, what in (("frame_edge", "frame"), ("countersink", "holes")):
        if getattr(job, name) is not None and getattr(job, what) is None:
            raise InputError(f"{name} is given, but no {what}", where=name, hint=f"--{what}, too")
    frame = None if job.frame is None else Frame(job.frame, job.frame_height, job.frame_edge)
    return Stock.zeroed(
        (*job.size, job.thickness if bent is None else bent.wall),
        job.work_zero,
        job.work_zero_z,
        shape=job.outline,
        corner=job.corner,
        frame=frame,
        holes=tuple(Hole(at, job.hole, job.countersink) for at in job.holes or ()),
        keyholes=tuple(Keyhole(at) for at in job.keyholes or ()),
    )


def milled_of(job: Job) -> Stock:
    """Return the stock as it lies on the machine: a round one along X, its face laid out flat."""
    bent, flat = round_of(job), stock_of(job)
    if bent is None:
        return flat
    if isinstance(bent, Curved):
        board = (bent.breadth, bent.height, bent.thickness)
        return Stock.zeroed(board, job.work_zero, job.work_zero_z, curve=bent.radius)
    size = (flat.height, flat.width, flat.thickness)
    radius = bent.diameter / 2
    return Stock.zeroed(size, job.work_zero, job.work_zero_z, radius=radius)


def machine_of(job: Job) -> Machine:
    """Return the machine of a job; over a raised frame it keeps higher.

    For a round stock its Y is the rotary axis, in mm on the face.

    Raises
    ------
    InputError
        If there is none, or it has no room.
    """
    machine = profiles.machine(job.machine)
    if isinstance(bent := round_of(job), Round):
        return turning(machine, bent.diameter / 2)
    return replace(machine, safe_height=machine.safe_height + stock_of(job).top)


@contextmanager
def stock_files(job: Job, folder: Path) -> Iterator[tuple[Drafting, Part]]:
    """Write stock.step and frame.step beside whatever else is done.

    The part, report.json's `stock`, says whether they came to be: all but a shaped slab
    does without them.
    """
    part: Part = {"file": None, "note": ""}
    with drafting(round_of(job) or stock_of(job), folder) as work:
        yield work, part
        try:
            work.finish()
        except CadUnavailableError as missing:
            part["note"] = str(missing)
            return
    part["file"] = STOCK
    if isinstance(work.stock, Stock) and work.stock.frame:
        part["frame"] = FRAME
