"""The last stage of a job that fails or is cancelled: to a machine that stands still.

Feed hold, wait for Hold:0, then reset: a reset while the axes move loses the position
(ALARM:3), and a hold alone leaves the spindle turning.  M5 follows where the machine
still answers, although its reset has stopped the spindle already.
"""

from enum import Enum, auto

from relieffab.grbl.messages import Acknowledgement, Banner, Message, Status
from relieffab.grbl.stage import HOLD, RESET, Fault, Patience, Poll

SPINDLE_OFF = b"M5\n"


class _Step(Enum):
    HOLDING = auto()
    RESETTING = auto()
    SPINDLE_OFF = auto()


class SafeStop:
    """Stop the machine, whatever it does.

    Parameters
    ----------
    fault : Fault
        Why; after an alarm the machine stands and answers only a reset, after a restart its
        position is lost.

    Attributes
    ----------
    outcome : str
        What became of the machine, for people.
    """

    def __init__(self, fault: Fault, patience: Patience, now: float) -> None:
        self.over = False
        self.failure = None
        self.outcome = ""
        self.status: Status | None = None
        self._patience = patience
        self._poll = Poll(patience.poll, now)
        self._position_kept = fault is not Fault.RESTARTED
        self._out = b""
        if fault is Fault.ALARM:
            self._reset(now)
        else:
            self._out = HOLD
            self._step, self._deadline = _Step.HOLDING, now + patience.hold

    def take(self, message: Message, now: float) -> None:
        """Take in one message."""
        if isinstance(message, Status):
            self.status = message
            self._poll.answered(now)
            if self._step is _Step.HOLDING and message.stopped:
                self._reset(now)
        elif isinstance(message, Banner):
            self._greeted(now)
        elif isinstance(message, Acknowledgement) and self._step is _Step.SPINDLE_OFF:
            self._finish("the machine was stopped, reset and its spindle switched off")

    def give(self, now: float) -> bytes:
        """Give the bytes to send; go on without an answer when it is overdue."""
        if self.over:
            return b""
        silent = self._poll.silence(now) > self._patience.answer
        if self._step is _Step.HOLDING and (silent or now >= self._deadline):
            self._position_kept = False
            self._reset(now)
        elif self._step is not _Step.HOLDING and now >= self._deadline:
            self._give_up()
        out, self._out = self._out, b""
        return out + (self._poll.due(now) if self._step is _Step.HOLDING else b"")

    def _greeted(self, now: float) -> None:
        if self._step is _Step.HOLDING:
            self._position_kept = False
            self._reset(now)
        else:
            self._spindle_off(now)

    def _reset(self, now: float) -> None:
        self._out += RESET
        self._step, self._deadline = _Step.RESETTING, now + self._patience.banner

    def _spindle_off(self, now: float) -> None:
        self._out = SPINDLE_OFF
        self._step, self._deadline = _Step.SPINDLE_OFF, now + self._patience.answer

    def _give_up(self) -> None:
        if self._step is _Step.SPINDLE_OFF:
            self._finish("the machine was reset, which stops it, but did not answer M5")
        else:
            self._finish(
                "the machine does not answer: it finishes what it has and stops in the stock "
                "with the spindle on; switch it off by hand"
            )

    def _finish(self, outcome: str) -> None:
        doubt = "" if self._position_kept else "; its position is not to be trusted: home it again"
        self.outcome, self.over = outcome + doubt, True
