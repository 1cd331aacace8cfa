"""What is said of a job before and while it runs, on stderr."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from relieffab.cli import console
from relieffab.cli.interrupt import raise_if_asked

if TYPE_CHECKING:
    from relieffab.grbl.job import Job, Plan
    from relieffab.grbl.view import View


def intentions(job: "Job", plan: "Plan") -> Iterator[str]:
    """Say what will happen, a line at a time."""
    program = job.program
    if job.home:
        yield "home     the machine runs to its switches first"
    for note in plan.notes:
        yield f"note: {note}"
    ranges = [
        f"{name} {low:.3f}..{high:.3f}"
        for name, low, high in zip("XYZA", *program.bounds, strict=False)
        if low is not None and high is not None
    ]
    if job.check:
        yield f"check    {len(program):,} lines are read, nothing moves"
        return
    yield f"program  {len(program):,} lines, {program.cut_mm:,.0f} mm to cut" + (
        f", {'  '.join(ranges)} mm" + " and degrees" * ("A" in program.codes) if ranges else ""
    )
    left = plan.table.total - plan.table.at(plan.first)
    yield f"time     about {clock(left)}"
    if plan.entry is not None:
        x, y, z, *turn = plan.entry.position
        places = [("X", x), ("Y", y), *(("A", angle) for angle in turn)]
        where = " ".join(f"{name}{value:g}" for name, value in places if value is not None)
        yield (
            f"resume   at line {plan.number}: up to Z{plan.entry.height:g}, across to {where}, "
            f"spindle on, slowly down to Z{z:g}"
        )


def clock(seconds: float) -> str:
    """Write seconds as 1:02:03."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"


@contextmanager
def status_line() -> "Iterator[Callable[[View], None]]":
    """Show the job on one line of stderr; where that is no terminal, only what stops it."""
    terminal, last = sys.stderr.isatty(), ""

    def show(view: "View") -> None:
        nonlocal last
        raise_if_asked()
        if terminal:
            print(f"\r\x1b[2K{_summary(view)}", end="", file=sys.stderr, flush=True)
        elif view.meaning and view.meaning != last:
            console.message(f"{view.state:<8} {view.meaning}")
        last = view.meaning

    try:
        yield show
    finally:
        if terminal:
            print(file=sys.stderr)


def _summary(view: "View") -> str:
    if view.meaning:
        return f"{view.state}: {view.meaning}"
    where = ",".join(f"{value:.2f}" for value in view.position or ())
    percent = 100 * view.cut_mm / view.total_mm if view.total_mm else 100
    left = "" if view.left_s is None else f"  {clock(view.left_s)} left"
    over = "" if view.overrides == (100, 100, 100) else "  {}/{}/{} %".format(*view.overrides)
    return (
        f"{view.state:<5} {view.cut_mm:,.0f} of {view.total_mm:,.0f} mm ({percent:.0f} %){left}  "
        f"{where}  F{view.feed:.0f} S{view.speed:.0f}{over}  buffer {view.fill:.0%}"
    )
