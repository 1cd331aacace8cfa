"""The last stage of a job that fails or is cancelled: to a machine that stands still.

Feed hold, wait for Hold:0, then reset: a reset while the axes move loses the position
(ALARM:3), and a hold alone leaves the spindle turning.  Every step is sent again where it
changed nothing, and the end is believed only when a report says that the spindle is off.
"""

from enum import Enum, auto

from relieffab.grbl.codes import POSITION_LOST
from relieffab.grbl.messages import Acknowledgement, Alarm, Banner, Message, Status
from relieffab.grbl.stage import HOLD, RESET, Failure, Fault, Patience, Poll

OFF = b"M5\nM9\n"
RESETS = 4
"""Resets without an answer before the machine is given up."""
_DOUBTED = {Fault.RESTARTED, Fault.UNPLUGGED}


class _Step(Enum):
    HOLDING = auto()
    RESETTING = auto()
    CONFIRMING = auto()


class SafeStop:
    """Stop the machine, whatever it does.

    Parameters
    ----------
    failure : Failure or None
        Why; after an alarm the machine stands and answers only a reset, after a restart its
        position is lost.  None leaves check mode.

    Attributes
    ----------
    outcome : str
        What became of the machine, for people.
    position_kept : bool
        False where the machine no longer knows where it is.
    safe : bool
        True once a report said that it stands still with the spindle off.
    status : Status or None
        The latest report.
    """

    def __init__(self, failure: Failure | None, patience: Patience, now: float) -> None:
        self.over = self.safe = False
        self.failure = None
        self.outcome = ""
        self.status: Status | None = None
        self.position_kept = failure is None or _kept(failure)
        self._patience = patience
        self._poll = Poll(patience.poll, now)
        self._resets = 0
        self._held = now
        self._out = b""
        self._deadline = now + patience.hold
        if failure is None or failure.fault is Fault.ALARM:
            self._reset(now)
        else:
            self._out = HOLD
            self._step = _Step.HOLDING

    @property
    def resetting(self) -> bool:
        """True once positions reported may no longer be those of the job."""
        return self._step is not _Step.HOLDING

    def take(self, message: Message, now: float) -> None:
        """Take in one message."""
        if isinstance(message, Status):
            self.status = message
            self._poll.heard(now)
            self._reported(message, now)
        elif isinstance(message, Alarm):
            self._alarmed(message.code, now)
        elif isinstance(message, Banner):
            self._poll.heard(now)
            self._greeted(now)
        elif isinstance(message, Acknowledgement):
            self._poll.heard(now)

    def give(self, now: float) -> bytes:
        """Give the bytes to send; go on without an answer when it is overdue."""
        if self.over:
            return b""
        if self._step is _Step.HOLDING:
            silent = self._poll.silence(now) > self._patience.answer
            if silent or now >= self._deadline:
                self.position_kept = False
                self._reset(now)
        elif now >= self._deadline:
            self._again(now)
        out, self._out = self._out, b""
        return out + (b"" if self.over else self._poll.due(now))

    def _reported(self, status: Status, now: float) -> None:
        if self._step is _Step.HOLDING:
            if status.stopped or status.state == "Home":
                self._reset(now)
            elif status.state in ("Run", "Jog") and now - self._held >= self._patience.again:
                self._out += HOLD
                self._held = now
        elif self._step is _Step.CONFIRMING and status.state in ("Idle", "Alarm", "Sleep"):
            if not status.speed:
                self.safe = True
                self._finish("the machine was stopped, reset, and its spindle is off")
        elif self._step is _Step.RESETTING and status.state in ("Idle", "Alarm"):
            self._confirm(now)  # the banner was lost on the line

    def _alarmed(self, code: int, now: float) -> None:
        if code in POSITION_LOST:
            self.position_kept = False
        if self._step is _Step.HOLDING:
            self._reset(now)

    def _greeted(self, now: float) -> None:
        if self._step is _Step.HOLDING:
            self.position_kept = False
            self._reset(now)
        else:
            self._confirm(now)

    def _reset(self, now: float) -> None:
        self._out += RESET
        self._resets += 1
        self._step, self._deadline = _Step.RESETTING, now + self._patience.banner

    def _confirm(self, now: float) -> None:
        if self._step is not _Step.CONFIRMING:
            self._out += OFF
        self._step, self._deadline = _Step.CONFIRMING, now + self._patience.banner

    def _again(self, now: float) -> None:
        """Reset once more what does not answer, or reports that its spindle still turns."""
        if self._resets < RESETS:
            self._reset(now)
        elif self._step is _Step.CONFIRMING:
            self._finish("the machine was reset, which stops it, but no report confirms it")
        else:
            self.position_kept = False
            self._finish(
                "the machine does not answer: it finishes what it has and stops in the stock "
                "with the spindle on; switch it off by hand"
            )

    def _finish(self, outcome: str) -> None:
        doubt = "" if self.position_kept else "; its position is not to be trusted: home it again"
        self.outcome, self.over = outcome + doubt, True


def _kept(failure: Failure) -> bool:
    """Say whether a machine knows where it is after a failure, as far as that tells."""
    if failure.fault is Fault.ALARM:
        return failure.alarm is not None and failure.alarm not in POSITION_LOST
    return failure.fault not in _DOUBTED
