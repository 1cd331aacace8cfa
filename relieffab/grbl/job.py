"""What is wanted of the machine, and what will be done about it once it was asked."""

from dataclasses import dataclass

from relieffab.grbl.controller import Controller
from relieffab.grbl.course import moved
from relieffab.grbl.messages import Point, Status
from relieffab.grbl.pace import Timetable
from relieffab.grbl.program import Program, commands
from relieffab.grbl.record import Record
from relieffab.grbl.resume import Entry, entry, zero_lost
from relieffab.grbl.review import review, still_over_axis
from relieffab.grbl.stage import Failure, Fault

_EXPECTED = ("G0", "G17", "G21", "G90", "G94")


@dataclass(frozen=True)
class Resume:
    """Where to take a job up again; the record's line if neither is given.

    Parameters
    ----------
    record : Record or None
        Of the job that was interrupted.
    line : int or None
        Of the source.
    seconds : float or None
        Since the start, by the planner's arithmetic.
    zero_set : bool
        A person says that work zero was set again.
    """

    record: Record | None = None
    line: int | None = None
    seconds: float | None = None
    zero_set: bool = False


@dataclass(frozen=True)
class Job:
    """One program for one machine.

    Parameters
    ----------
    program : Program
    check : bool
        Only let the machine read it ($C); nothing moves.
    attended : bool
        Somebody at the keyboard can end a hold.
    home : bool
        Home the machine first ($H).
    unlock : bool
        End its alarm first ($X): a person says that its position is right.
    resume : Resume or None
    resumable : bool
        It can be taken up again; an outline or a probe is begun anew.
    """

    program: Program
    check: bool = False
    attended: bool = False
    home: bool = False
    unlock: bool = False
    resume: Resume | None = None
    resumable: bool = True


@dataclass(frozen=True)
class Plan:
    """What will happen.

    Parameters
    ----------
    setup : tuple of Program
        What goes before the program, and before the approach to `entry`.
    first, number : int
        The program's first line that is sent: its index, its line in the source.
    table : Timetable
    notes : tuple of str
        What the person should know.
    entry : Entry or None
        Where a job is taken up again.
    position : tuple of float or None
        Where the tool stands, work coordinates, mm, A in degrees.
    """

    setup: tuple[Program, ...]
    first: int
    number: int
    table: Timetable
    notes: tuple[str, ...]
    entry: Entry | None
    position: Point | None


def plan(job: Job, controller: Controller, status: Status) -> Plan | Failure:
    """Decide what to send to a machine that stands still, or why nothing may be sent."""
    setup = _setup(job, controller)
    found = review(job.program, controller)
    if found.refusals and not job.check:
        return Failure(
            Fault.MISFIT,
            "the program and the machine do not fit",
            found="; ".join(found.refusals),
            hint="move work zero, turn the job, or change what is named",
        )
    if job.home and still_over_axis(job.program):
        return Failure(
            Fault.MISFIT,
            "homing would take Y away from the axis, and the program never moves it back",
            hint="home first, bring the cutter over the axis, then send without --home",
        )
    if job.check and controller.zero_forgotten:
        return Failure(
            Fault.MISFIT,
            "check mode would move work zero",
            found="an offset by G92 or a tool length, which the reset at its end forgets",
            hint="store work zero by G10 L20 first",
        )
    table = Timetable(job.program, controller.limits)
    position, machine = _places(controller, status)
    point: Entry | None = None
    if job.resume is not None:
        lost = zero_lost(job.resume.record, machine, controller.work_zero, homed=job.home)
        if lost and not job.resume.zero_set:
            return Failure(
                Fault.MISFIT,
                "the job cannot be taken up again where it stopped",
                found=lost,
                hint="set work zero again, then say so with --zero-set",
            )
        point = _entry(job.program, job.resume, table)
    first, number = (point.index, point.number) if point else (0, 1)
    notes = (*found.refusals, *found.notes)
    return Plan(tuple(setup), first, number, table, notes, point, position)


def _setup(job: Job, controller: Controller) -> list[Program]:
    """Bring the machine to the state that a program may expect, that of a reset.

    Only a spindle that a person has switched on is left on: the program may count on it.
    """
    setup = [commands("$H")] if job.home else [commands("$X")] if job.unlock else []
    if job.check:
        return [*setup, commands("$C")]
    wrong = not set(_EXPECTED) <= set(controller.modal.split())
    other = controller.system
    if other != "G54" and "G54" in job.program.codes:
        controller.modal = controller.modal.replace(other, "G54")
        wrong = True
    if wrong:
        setup.append(commands("".join(_EXPECTED) + controller.system))
    return setup


def _entry(program: Program, resume: Resume, table: Timetable) -> Entry:
    if resume.line is not None:
        return entry(program, number=resume.line)
    if resume.seconds is not None:
        return entry(program, index=table.line_at(resume.seconds))
    return entry(program, number=resume.record.line if resume.record else 1)


def _places(controller: Controller, status: Status) -> tuple[Point | None, Point | None]:
    """Position in work and in machine coordinates, mm."""
    zero = status.offset or controller.work_zero
    if status.work is not None:
        return status.work, moved(status.work, zero, 1)
    return moved(status.machine, zero, -1), status.machine
