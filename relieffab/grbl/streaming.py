"""The second stage: the program, line by line, as fast as the receive buffer allows.

A job is done when its last line is acknowledged and two status reports in a row then say
Idle: the last `ok` can come 20 s before the machine stands still, and one single Idle may
be reported between that `ok` and the start of the last moves.
"""

from relieffab.grbl.codes import alarm_meaning, error_meaning
from relieffab.grbl.messages import Acknowledgement, Alarm, Banner, Message, Status
from relieffab.grbl.program import Program
from relieffab.grbl.stage import RESUME, Failure, Fault, Patience, Poll
from relieffab.grbl.window import Window

IDLE_REPORTS = 2


class Streaming:
    """Send `program`, counting characters against `buffer` bytes.

    Attributes
    ----------
    acknowledged : int
        Lines acknowledged so far.
    status : Status or None
        The latest report.
    cut_mm : float
        Length certainly cut at that report: lines acknowledged less those that the planner
        still held, mm.
    """

    def __init__(
        self, program: Program, buffer: int, blocks: int, patience: Patience, now: float
    ) -> None:
        self.failure: Failure | None = None
        self.over = False
        self.acknowledged = 0
        self.status: Status | None = None
        self.cut_mm = 0.0
        self.held = False
        self._program = program
        self._blocks = blocks
        self._window = Window(buffer)
        self._patience = patience
        self._poll = Poll(patience.poll, now)
        self._sent = 0
        self._alone = False
        self._idle = 0
        self._idle_since: float | None = None
        self._dwell = 0.0
        self._out = b""

    @property
    def sent(self) -> int:
        """Lines sent so far."""
        return self._sent

    def resume(self) -> None:
        """End a pause (M0) or a feed hold."""
        self._out += RESUME
        self.held = False

    def take(self, message: Message, now: float) -> None:
        """Take in one message."""
        if isinstance(message, Acknowledgement):
            self._acknowledge(message.code)
        elif isinstance(message, Status):
            self._report(message, now)
        elif isinstance(message, Alarm):
            self._fail(
                Fault.ALARM,
                "the machine raised an alarm",
                found=f"ALARM:{message.code}, {alarm_meaning(message.code)}",
                hint="clear its cause, home or unlock the machine, and check the stock",
            )
        elif isinstance(message, Banner):
            self._fail(
                Fault.RESTARTED,
                "the machine restarted in the middle of the job",
                found=f"the banner of Grbl {message.version}",
                hint="its position is lost: look for a power dip, home it, set work zero again",
            )

    def give(self, now: float) -> bytes:
        """Give the bytes to send, and notice what is overdue."""
        if self.over:
            return b""
        self._overdue(now)
        if self.over:
            return b""
        out = self._out + self._fill() + self._poll.due(now)
        self._out = b""
        return out

    def _fill(self) -> bytes:
        program, window, out = self._program, self._window, b""
        while self._sent < len(program) and not self._alone:
            index = self._sent
            line = program.line(index)
            alone = index in program.alone
            if not window.fits(len(line)) or (alone and len(window)):
                break
            self._alone = alone
            window.sent(index, len(line))
            self._dwell = max(self._dwell, program.dwells.get(index, 0.0))
            self._sent = index + 1
            self._idle_since = None
            out += line
        return out

    def _acknowledge(self, code: int) -> None:
        index = self._window.acknowledged()
        self._idle_since, self._idle = None, 0
        if code:
            self._fail(
                Fault.REFUSED,
                "the machine refused a line",
                found=f"error:{code}, {error_meaning(code)}",
                hint=f"lines up to {self._last_sent()} were already on their way and may have run",
                line=index,
            )
        elif index is None:
            self._fail(
                Fault.STRAY_ACKNOWLEDGEMENT,
                "the machine acknowledged a line that was not sent",
                hint="something else writes to this port, or the line is noisy; check the stock",
            )
        else:
            self.acknowledged += 1
            if not len(self._window):
                self._alone, self._dwell = False, 0.0

    def _report(self, status: Status, now: float) -> None:
        self.status = status
        self._poll.answered(now)
        self._count_cut(status)
        self.held = status.state in ("Hold", "Door") and status.substate in (0, None)
        if status.state != "Idle":
            self._idle_since, self._idle = None, 0
        elif self.acknowledged == len(self._program):
            self._idle += 1
            self.over = self._idle >= IDLE_REPORTS
        elif len(self._window):
            self._stalled(now)
        if status.state == "Alarm":
            self._fail(
                Fault.ALARM,
                "the machine is in alarm",
                hint="clear its cause, home or unlock the machine, and check the stock",
            )

    def _count_cut(self, status: Status) -> None:
        free = 0 if status.blocks_free is None else status.blocks_free
        done = self.acknowledged - max(self._blocks - free, 0)
        if done > 0:
            self.cut_mm = max(self.cut_mm, float(self._program.cut[done - 1]))

    def _overdue(self, now: float) -> None:
        if self._poll.silence(now) > self._patience.answer:
            self._fail(
                Fault.SILENT,
                "the machine fell silent",
                found=f"no status report for {self._patience.answer:g} s",
                hint="the machine may go on with what it has: watch the spindle",
            )

    def _stalled(self, now: float) -> None:
        """Notice a machine that reports Idle and yet owes acknowledgements."""
        if self._idle_since is None:
            self._idle_since = now
        if now - self._idle_since > self._patience.stall + self._dwell:
            self._fail(
                Fault.LOST_ACKNOWLEDGEMENT,
                "an acknowledgement never came",
                found=f"the machine is idle, lines unacknowledged: {len(self._window)}",
                hint="bytes were lost on the line: shorten the cable or use a shielded one",
            )

    def _last_sent(self) -> int:
        return int(self._program.numbers[self._sent - 1]) if self._sent else 0

    def _fail(
        self,
        fault: Fault,
        message: str,
        *,
        found: str = "",
        hint: str = "",
        line: int | None = None,
    ) -> None:
        if self.failure is not None:
            return
        reached = self.acknowledged if line is None else line
        reached = min(reached, len(self._program) - 1)
        self.failure = Failure(fault, message, found=found, hint=hint, line=reached)
        self.over = True
