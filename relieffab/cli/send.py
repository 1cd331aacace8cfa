"""send: a program to a machine, seen through."""

import json
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from relieffab import units
from relieffab.cli import console
from relieffab.cli.carving import intentions, status_line
from relieffab.cli.options import Json
from relieffab.errors import InputError

if TYPE_CHECKING:
    from relieffab.cli.jobs import Kept
    from relieffab.grbl.job import Job, Plan
    from relieffab.grbl.program import Program
    from relieffab.grbl.sender import SendReport


def send(
    program: Annotated[Path | None, Parameter(help="G-code file")] = None,
    /,
    *,
    port: Annotated[
        str | None, Parameter(help="serial port, or sim:// for the simulated machine")
    ] = None,
    baud: Annotated[int, Parameter(help="bits a second")] = 115200,
    list_ports: Annotated[
        bool, Parameter(name="--list", negative="", help="list the serial ports, and stop")
    ] = False,
    check: Annotated[
        bool, Parameter(negative="", help="only let the machine read the program ($C)")
    ] = False,
    trace: Annotated[
        bool, Parameter(negative="", help="only trace its outline in the air, spindle off")
    ] = False,
    probe: Annotated[
        str | None, Parameter(help="only set Z by a touch plate this thick, below the tool")
    ] = None,
    home: Annotated[bool, Parameter(negative="", help="home the machine first ($H)")] = False,
    unlock: Annotated[
        bool,
        Parameter(negative="", help="end an alarm first ($X): the position is right"),
    ] = False,
    resume: Annotated[
        bool, Parameter(negative="", help="go on where this program was interrupted")
    ] = False,
    from_line: Annotated[int | None, Parameter(help="go on at this line of the file")] = None,
    from_time: Annotated[
        str | None, Parameter(help="go on at this time of the job: 90, 1:30 or 1:30:00")
    ] = None,
    zero_set: Annotated[
        bool, Parameter(negative="", help="work zero was set again before going on")
    ] = False,
    log: Annotated[Path | None, Parameter(help="file for the log of the job")] = None,
    yes: Annotated[bool, Parameter(negative="", help="do not ask before anything moves")] = False,
    as_json: Json = False,
) -> int:
    """Stream a program to a Grbl machine and see it through."""
    if list_ports:
        return _list(as_json=as_json)
    if program is None or port is None:
        raise InputError("send needs a program and --port", hint="relieffab send --list")
    if not program.is_file():
        raise InputError("there is no such program", where=str(program))
    asked = [check, trace, probe is not None, resume or from_line is not None or bool(from_time)]
    if sum(asked) > 1 or (from_line is not None and from_time):
        raise InputError("of --check, --trace, --probe, --resume, --from-line and --from-time, one")
    for note in _certified(program):
        console.message(f"note: {note}")
    whole = _read(program)
    job, kept = _wanted(
        whole, log, check=check, trace=trace, probe=probe,
        resume=(from_line, _seconds(from_time), zero_set) if asked[3] else None,
    )  # fmt: skip
    job = replace(job, home=home, unlock=unlock)
    report = _run(job, port, baud, kept, ask=not yes)
    what = "traced" if trace else "probed" if probe is not None else "carved"
    return _tell(report, as_json=as_json, check=check, what=what)


def _certified(program: Path) -> list[str]:
    """Ask for the program's certificate; one changed since is judged, which loads much."""
    from relieffab.job.certificate import check_certificate

    notes = check_certificate(program)
    if notes is None:
        from relieffab.job.proof import judged_again

        notes = judged_again(program)
    return notes


def stream(program: str, url: str) -> "SendReport":
    """Send a text through a port with a line that counts the millimetres cut."""
    from relieffab.grbl.job import Job
    from relieffab.grbl.program import prepare

    return _run(Job(prepare(program)), url, 115200, None, ask=False)


def _list(*, as_json: bool) -> int:
    from relieffab.grbl.port import ports

    found = ports()
    if as_json:
        print(json.dumps([asdict(one) for one in found], indent=2))
    for one in [] if as_json else found:
        print(f"{one.device:<20} {one.description}")
    if not found:
        console.message("no serial port found: plug the machine in")
    return 0


def _read(path: Path) -> "Program":
    from relieffab.grbl.program import prepare

    with path.open(encoding="latin-1", newline="") as file:
        return prepare(file)


def _wanted(
    program: "Program", log: Path | None,
    *, check: bool, trace: bool, probe: str | None,
    resume: tuple[int | None, float | None, bool] | None,
) -> "tuple[Job, Kept | None]":  # fmt: skip
    """Make a job of what the flags ask for; only carving is kept."""
    from relieffab.cli.jobs import Kept
    from relieffab.grbl.before import outline, touch
    from relieffab.grbl.job import Job, Resume
    from relieffab.grbl.program import prepare

    if trace:
        return Job(prepare(outline(program)), resumable=False), None
    if probe is not None:
        return Job(prepare(touch(units.length(probe))), resumable=False), None
    if check:
        return Job(program, check=True), None
    kept = Kept(program, log)
    record = kept.read()
    if resume is None:
        return Job(program), kept
    if record is None and resume[:2] == (None, None):
        raise InputError(
            "this program was not interrupted", hint="name a place with --from-line or --from-time"
        )
    return Job(program, resume=Resume(record, *resume)), kept


def _seconds(text: str | None) -> float | None:
    """Read 90, 1:30 or 1:30:00."""
    if text is None:
        return None
    parts = text.split(":")
    if len(parts) > 3 or not all(part.replace(".", "", 1).isdigit() for part in parts):
        raise InputError("this is not a time", expected="90, 1:30 or 1:30:00", found=text)
    total = 0.0
    for part in parts:
        total = total * 60 + float(part)
    return total


def _run(job: "Job", url: str, baud: int, kept: "Kept | None", *, ask: bool) -> "SendReport":
    from relieffab.cli.keyboard import keyboard
    from relieffab.grbl.joblog import Log
    from relieffab.grbl.port import open_port
    from relieffab.grbl.sender import Company
    from relieffab.grbl.sender import send as send_job

    with ExitStack() as stack:
        port = stack.enter_context(open_port(url, baud=baud))
        show = stack.enter_context(status_line())
        keys = stack.enter_context(keyboard())
        file = stack.enter_context(kept.log.open("w", encoding="ascii")) if kept else None
        company = Company(
            show=show,
            confirm=lambda plan: _confirm(job, plan, keys if ask else None),
            typed=keys,
            keep=kept.keep if kept else None,
            log=(lambda digest, now: Log(file, digest, now)) if file else None,
        )
        return send_job(job, port, company)


def _confirm(job: "Job", plan: "Plan", keys: Callable[[], str] | None) -> bool:
    """Say what will happen; at a terminal, wait for a yes."""
    for text in intentions(job, plan):
        console.message(text)
    if keys is None:
        return True
    from relieffab.grbl.realtime import HELP

    console.message("first?   --check, --trace and --probe try it without cutting")
    console.message(f"keys     {HELP}")
    console.message("start?   y starts, any other key leaves the machine alone")
    while not (typed := keys()):
        _rest()
    return typed[0] in "yY"


def _rest() -> None:
    import time

    time.sleep(0.05)


def _tell(report: "SendReport", *, as_json: bool, check: bool, what: str) -> int:
    for error in report.errors:
        console.message(f"finding: {error}")
    if as_json:
        print(json.dumps(asdict(report), indent=2))
    elif check:
        print(f"the machine read {report.lines:,} lines, {len(report.errors)} refused")
    else:
        print(f"{what} {report.cut_mm:,.0f} mm in {report.lines:,} lines")
    return 1 if report.errors else 0
