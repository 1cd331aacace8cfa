"""Bytes carried to and fro between a session and a port, until the machine is done or safe."""

from collections.abc import Callable

from relieffab.errors import MachineError
from relieffab.grbl.company import Company, SendReport
from relieffab.grbl.job import Job
from relieffab.grbl.port import Port
from relieffab.grbl.protocol import Session
from relieffab.grbl.realtime import KEYS, STOP
from relieffab.grbl.stage import Failure, Fault, Patience

KEEP_EVERY = 2.0
"""Seconds between two records of how far the job came."""
_UNPLUGGED = (
    "the machine finishes what it has and stops in the stock with the spindle on: switch it "
    "off by hand; after reconnecting its position reads 0,0,0 and is wrong"
)


class Drive:
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
        """See the job through; however this is left, the machine was stopped before."""
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
            self.lost = True
            try:
                self.lost = not self.port.reopen(self.patience.reconnect)
                now = self._now(self.port)
                self._note("reconnected", now)
                session.reconnected(failure, now)
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
        """Stop the machine safely if the session was left before its end.

        Whoever presses Ctrl-C again wants what is being done already.
        """
        while not (self.session.over or self.lost):
            try:
                now = self._now(self.port)
                if self.session.failure is None:
                    self._note("cancel", now)
                    self.session.cancel(now)
                self._with_port(self._finish)
            except KeyboardInterrupt:
                continue

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
        forgotten = session.controller is not None and session.controller.zero_forgotten
        if session.started is not None and forgotten:
            outcome += "; the reset forgot G92 and tool lengths: set work zero again"
        again = ""
        resumable = self.job.resumable and not self.job.check
        if session.started is not None and session.reached is not None and resumable:
            kept = session.position_kept and not (self.lost or forgotten)
            again = f"to go on, send again with --from-line {session.reached.number}" + (
                "" if kept else " and --zero-set, once work zero is set again"
            )
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
