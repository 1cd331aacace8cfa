"""Send a program through a port and see it through: the glue between protocol and port."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from relieffab.errors import InputError, MachineError
from relieffab.grbl.job import Job, Plan
from relieffab.grbl.joblog import Log
from relieffab.grbl.messages import Point
from relieffab.grbl.port import Port
from relieffab.grbl.program import prepare
from relieffab.grbl.protocol import Session
from relieffab.grbl.realtime import KEYS, STOP
from relieffab.grbl.record import Record
from relieffab.grbl.stage import Failure, Fault, Patience
from relieffab.grbl.view import View

KEEP_EVERY = 2.0
"""Seconds between two records of how far the job came."""
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
    errors : tuple of str
        What the machine refused in check mode.
    """

    lines: int
    cut_mm: float
    seconds: float
    position: Point | None
    firmware: str
    notes: tuple[str, ...] = ()
    errors: tuple[str, ...] = ()


@dataclass(frozen=True)
class Company:
    """Who takes part in a job beside the machine; each may be left out.

    Parameters
    ----------
    show : callable
        Given a `View` whenever the machine has reported; raise from it to cancel.
    confirm : callable
        Given the `Plan` before anything moves; False leaves it at that.
    typed : callable
        Gives the keys typed since it was last called.
    keep : callable
        Given a `Record` every two seconds and at the end; None once the job is done.
    log : callable
        Given the program's digest and the time; gives the `Log` to write.
    """

    show: Callable[[View], None] | None = None
    confirm: Callable[[Plan], bool] | None = None
    typed: Callable[[], str] | None = None
    keep: Callable[[Record | None], None] | None = None
    log: Callable[[str, float], Log] | None = None


def send(
    program: Job | str | Iterable[str],
    port: Port,
    company: Company | None = None,
    *,
    patience: Patience | None = None,
) -> SendReport:
    """Send a program and wait until the machine has carried it out.

    The whole program is checked before the first byte goes out.  Whatever ends the job
    early (a fault, Ctrl-C, an exception out of `company`) holds the machine, resets it and
    makes sure that its spindle is off before this function is left.

    Parameters
    ----------
    program : Job, str or iterable of str
        What to do; text or its lines are carved from the first to the last.
    port : Port
        Freshly opened: the machine's greeting may still be to come.
    company : Company, optional
    patience : Patience, optional

    Raises
    ------
    InputError
        If a line must not be sent; nothing has moved.
    MachineError
        If the machine refuses, raises an alarm, restarts, falls silent or is unplugged,
        with the line reached and Grbl's own meaning.
    """
    with_whom = company or Company()
    job = program if isinstance(program, Job) else Job(prepare(program))
    job = replace(job, attended=with_whom.typed is not None)
    if job.program.pauses and not (job.attended or job.check):
        raise InputError(
            "the program waits for a person (M0), and nobody is there to let it go on",
            where=f"line {job.program.pauses[0]}",
            hint="take M0 out, or send from a terminal",
        )
    return _Drive(job, port, with_whom, patience or Patience()).run()


class _Drive:
    """Carry bytes to and fro until the session is over."""

    def __init__(self, job: Job, port: Port, company: Company, patience: Patience) -> None:
        now = self._now(port)
        self.job, self.port, self.company, self.patience = job, port, company, patience
        self.session = Session(job, patience=patience, now=now)
        self.log = company.log(job.program.digest, now) if company.log else None
        self.kept = now
        self.seen: object = None
        self.lost = False

    @staticmethod
    def _now(port: Port) -> float:
        return round(port.now(), 6)

    def run(self) -> SendReport:
        session = self.session
        try:
            self._with_port(self._work)
        except KeyboardInterrupt as stopped:
            self._stop()
            stopped.add_note(str(self._error()))
            raise
        finally:
            self._stop()
            self._keep_last()
        if session.failure is not None:
            raise self._error()
        return self._report()

    def _with_port(self, work: Callable[[], None]) -> None:
        """Do something; if the port goes away, see whether it comes back to stop the machine."""
        try:
            work()
        except MachineError as error:
            session = self.session
            if session.started is None:
                raise
            failure = Failure(
                Fault.UNPLUGGED,
                "the connection to the machine was lost",
                found=str(error).splitlines()[0],
                where=session.reached.where if session.reached else "",
            )
            try:
                self.lost = not self.port.reopen(self.patience.reconnect)
                session.reconnected(failure, self._now(self.port))
                if not self.lost:
                    self._finish()
            except MachineError:
                self.lost = True

    def _work(self) -> None:
        session, port = self.session, self.port
        out = self._advance(b"")
        while not session.over:
            if session.ready:
                self._start()
            if out:
                port.write(out)
            received = port.read()
            self._typed()
            out = self._advance(received)
            if session.status is not self.seen:
                self.seen = session.status
                self._show()
        if out:
            port.write(out)

    def _start(self) -> None:
        session, confirm = self.session, self.company.confirm
        if confirm is not None and session.plan is not None and not confirm(session.plan):
            session.cancel(self._now(self.port))
            return
        now = self._now(self.port)
        self._note("go", now)
        session.go(now)

    def _typed(self) -> None:
        if self.company.typed is None:
            return
        for key in self.company.typed():
            now = self._now(self.port)
            if key == STOP:
                self._note("cancel", now)
                self.session.cancel(now)
            elif key in KEYS:
                self._note("key", now, KEYS[key][0])
                self.session.command(KEYS[key][0])

    def _advance(self, received: bytes) -> bytes:
        now = self._now(self.port)
        out = self.session.advance(received, now)
        if self.log is not None and (received or out or self.session.over):
            try:
                self.log.exchange(received, out, now)
            except OSError as error:
                self._unrecorded(error, now)
        return out

    def _note(self, name: str, now: float, data: bytes = b"") -> None:
        if self.log is not None:
            try:
                self.log.event(name, now, data)
            except OSError as error:
                self._unrecorded(error, now)

    def _unrecorded(self, error: OSError, now: float) -> None:
        """Stop: a job that cannot be recorded cannot be taken up again."""
        self.log = None
        failure = Failure(
            Fault.UNRECORDED,
            "the job can no longer be recorded",
            found=error.strerror or str(error),
            hint="free some space on the disk, then take the job up again",
        )
        self.session.abort(failure, now)

    def _show(self) -> None:
        now, company = self._now(self.port), self.company
        view = self.session.view()
        if view is not None and company.show is not None:
            company.show(view)
        if company.keep is not None and now - self.kept >= KEEP_EVERY:
            self.kept = now
            record = self.session.record()
            if record is not None:
                try:
                    company.keep(record)
                except OSError as error:
                    self._unrecorded(error, now)

    def _stop(self) -> None:
        """Stop the machine safely if the session was left before its end."""
        if self.session.over or self.lost:
            return
        now = self._now(self.port)
        self._note("cancel", now)
        self.session.cancel(now)
        self._with_port(self._finish)

    def _finish(self) -> None:
        session, port = self.session, self.port
        out = self._advance(b"")
        while not session.over:
            port.write(out)
            out = self._advance(port.read())
        if out:
            port.write(out)

    def _keep_last(self) -> None:
        """Record the end; a full disk has been told of already, or changes nothing now."""
        session, company = self.session, self.company
        try:
            if self.log is not None:
                self.log.flush()
            if company.keep is not None and session.started is not None and not self.job.check:
                company.keep(session.record())
        except OSError as error:
            self.log = None
            session.outcome += f"; this could not be recorded: {error.strerror or error}"

    def _error(self) -> MachineError:
        session, program = self.session, self.job.program
        failure = session.failure or Failure(Fault.CANCELLED, "the job was interrupted")
        where = failure.where
        if session.started is not None:
            count = f"{session.acknowledged} of {len(program)} lines acknowledged"
            where = f"{where} ({count})" if where else count
        outcome = _UNPLUGGED if self.lost else session.outcome
        again = ""
        if session.started is not None and session.reached is not None and not self.job.check:
            again = f"to go on, send again with --from-line {session.reached.number}"
        hint = "; ".join(part for part in (outcome, failure.hint, again) if part)
        return MachineError(failure.message, found=failure.found, where=where, hint=hint)

    def _report(self) -> SendReport:
        session, plan = self.session, self.session.plan
        return SendReport(
            lines=session.acknowledged - (plan.first if plan else 0),
            cut_mm=0.0 if self.job.check else session.cut_mm,
            seconds=(session.ended or 0.0) - (session.started or 0.0),
            position=session.position,
            firmware=session.controller.version if session.controller else "",
            notes=plan.notes if plan else (),
            errors=tuple(session.errors),
        )
