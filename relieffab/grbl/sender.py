"""Send a program through a port and see it through: the glue between protocol and port."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from relieffab.errors import InputError, MachineError
from relieffab.grbl.messages import Point
from relieffab.grbl.port import Port
from relieffab.grbl.program import Program, prepare
from relieffab.grbl.protocol import Session
from relieffab.grbl.stage import Patience
from relieffab.progress import Progress, silent

STAGE = "carving"
_UNPLUGGED = (
    "the machine finishes what it has and stops in the stock with the spindle on: switch it "
    "off by hand; after reconnecting its position reads 0,0,0 and is wrong"
)


@dataclass(frozen=True)
class SendReport:
    """A job that ended well.

    Parameters
    ----------
    lines : int
        Lines sent and acknowledged.
    cut_mm : float
        Length of G1, G2 and G3 moves, mm.
    seconds : float
        From the first line to the machine's rest, on the machine's clock.
    position : tuple of 3 float or None
        Where the machine stands, machine coordinates, mm.
    firmware : str
        Version of Grbl.
    notes : tuple of str
        What the person should know.
    """

    lines: int
    cut_mm: float
    seconds: float
    position: Point | None
    firmware: str
    notes: tuple[str, ...] = ()


def send(
    program: Program | str | Iterable[str],
    port: Port,
    *,
    progress: Progress = silent,
    on_pause: Callable[[], None] | None = None,
    patience: Patience | None = None,
) -> SendReport:
    """Send a program and wait until the machine has carried it out.

    The whole program is checked before the first byte goes out.  Whatever ends the job
    early (a fault, Ctrl-C, an exception out of `progress`) holds the machine, resets it and
    switches its spindle off before this function is left.

    Parameters
    ----------
    program : Program, str or iterable of str
        Text, its lines, or what `prepare` made of them.
    port : Port
        Freshly opened: the machine's greeting is still to come.
    progress : Progress
        Told the millimetres cut.
    on_pause : callable, optional
        Called while the machine waits at M0 or in a hold; when it returns, the machine goes
        on.  Without it, programs with M0 are refused.
    patience : Patience, optional

    Raises
    ------
    InputError
        If a line must not be sent; nothing has moved.
    MachineError
        If the machine refuses, raises an alarm, restarts, falls silent or is unplugged,
        with the line reached and Grbl's own meaning.
    """
    job = program if isinstance(program, Program) else prepare(program)
    if job.pauses and on_pause is None:
        raise InputError(
            "the program waits for a person (M0), and nobody is asked to let it go on",
            where=f"line {job.pauses[0]}",
            hint="take M0 out, or send from where a pause can be ended",
        )
    session = Session(job, patience=patience, now=port.now())
    try:
        _drive(session, job, port, progress, on_pause)
    except MachineError as lost:
        raise _unplugged(session, job, lost) from lost
    except KeyboardInterrupt as stopped:
        _stop(session, port)
        stopped.add_note(str(_cancelled(session, job)))
        raise
    finally:
        _stop(session, port)
    if session.failure is not None:
        raise _explain(session, job)
    progress(STAGE, job.cut_mm, job.cut_mm, "mm")
    return _report(session, job)


def _drive(
    session: Session,
    job: Program,
    port: Port,
    progress: Progress,
    on_pause: Callable[[], None] | None,
) -> None:
    """Carry bytes to and fro until the session is over."""
    seen, out = None, session.advance(b"", port.now())
    while not session.over:
        if out:
            port.write(out)
        out = session.advance(port.read(), port.now())
        status = session.status
        if status is not seen:
            seen = status
            progress(STAGE, session.cut_mm, job.cut_mm, "mm")
            if session.held and on_pause is not None:
                on_pause()
                session.resume()
    if out:
        port.write(out)


def _stop(session: Session, port: Port) -> None:
    """Stop the machine safely if the session was left before its end."""
    if session.over or session.lost:
        return
    session.cancel(port.now())
    out = session.advance(b"", port.now())
    while not session.over:
        port.write(out)
        out = session.advance(port.read(), port.now())


def _cancelled(session: Session, job: Program) -> MachineError:
    """Say how far an interrupted job came and what became of the machine."""
    where = "" if session.started is None else _reached(session, job, session.acknowledged - 1)
    return MachineError("the job was interrupted", where=where, hint=session.outcome)


def _reached(session: Session, job: Program, index: int) -> str:
    return f"{job.where(index)} ({session.acknowledged} of {len(job)} lines acknowledged)"


def _unplugged(session: Session, job: Program, lost: MachineError) -> MachineError:
    session.lost = True
    if session.started is None:
        return lost
    index = min(session.acknowledged, len(job) - 1)
    return MachineError(
        "the connection to the machine was lost",
        found=str(lost).splitlines()[0],
        where=_reached(session, job, index),
        hint=_UNPLUGGED,
    )


def _explain(session: Session, job: Program) -> MachineError:
    failure = session.failure
    if failure is None:
        return MachineError("the job did not end")
    where = "" if failure.line is None else _reached(session, job, failure.line)
    hint = "; ".join(part for part in (session.outcome, failure.hint) if part)
    return MachineError(failure.message, found=failure.found, where=where, hint=hint)


def _report(session: Session, job: Program) -> SendReport:
    status, controller = session.status, session.controller
    notes = list(session.notes)
    if status is not None and status.speed:
        notes.append(f"the spindle still turns ({status.speed:g} rpm): the program ends without M5")
    return SendReport(
        lines=session.acknowledged,
        cut_mm=job.cut_mm,
        seconds=(session.ended or 0.0) - (session.started or 0.0),
        position=status.machine if status else None,
        firmware=controller.version if controller else "",
        notes=tuple(notes),
    )
