"""The first stage: from an opened port to a machine that is known and idle.

Opening the port resets most boards; what is sent before their banner vanishes, and what
they print before it (a settings dump, `error:7`) acknowledges nothing.  Boards that do not
reset on opening are asked for their state and reset only where that disturbs nobody.
"""

from relieffab.grbl.codes import error_meaning
from relieffab.grbl.controller import Controller
from relieffab.grbl.messages import Acknowledgement, Banner, Message, Note, Setting, Status
from relieffab.grbl.stage import RESET, STATUS, Failure, Fault, Patience

QUESTIONS = (b"$I\n", b"$$\n", b"$#\n", b"$G\n")


class Greeting:
    """Wait for the banner, ask the questions one by one, make sure of Idle.

    Attributes
    ----------
    controller : Controller or None
        Known once `over` without a failure.
    """

    def __init__(self, patience: Patience, now: float) -> None:
        self.controller: Controller | None = None
        self.failure: Failure | None = None
        self.over = False
        self._patience = patience
        self._deadline = now + patience.banner
        self._asked: bytes | None = None
        self._next = 0
        self._out = b""

    def take(self, message: Message, now: float) -> None:
        """Take in one message."""
        if isinstance(message, Banner):
            self.controller = Controller(message.version)
            self._next = 0
            self._ask(now)
        elif self.controller is None:
            if isinstance(message, Status) and self._asked == STATUS:
                self._unsolicited(message, now)
        elif isinstance(message, Acknowledgement) and self._asked in QUESTIONS:
            self._answered(message, now)
        elif isinstance(message, (Setting, Note)):
            self.controller.learn(message)
        elif isinstance(message, Status) and self._asked == STATUS:
            self.controller.limit_buffer(message.bytes_free or 0)
            self._judge(message)

    def give(self, now: float) -> bytes:
        """Give the bytes to send, and notice when an answer is overdue."""
        if not self.over and now >= self._deadline:
            self._overdue(now)
        out, self._out = self._out, b""
        return out

    def _ask(self, now: float) -> None:
        done = self._next == len(QUESTIONS)
        self._asked = STATUS if done else QUESTIONS[self._next]
        self._next += 0 if done else 1
        self._out += self._asked
        self._deadline = now + self._patience.answer

    def _answered(self, message: Acknowledgement, now: float) -> None:
        if message.code:
            asked = (self._asked or b"").decode("ascii").strip()
            self._fail(
                Fault.NOT_READY,
                f"the machine does not answer {asked}",
                found=f"error:{message.code}, {error_meaning(message.code)}",
                hint="let the machine finish what it does, or reset it",
            )
        else:
            self._ask(now)

    def _judge(self, status: Status) -> None:
        if status.state == "Idle":
            self.over = True
        elif status.state == "Alarm":
            self._fail(
                Fault.NOT_READY,
                "the machine is locked by an alarm",
                found="Alarm",
                hint="home it ($H), or unlock it ($X) if its position is known to be right",
            )
        else:
            self._busy(status)

    def _busy(self, status: Status) -> None:
        self._fail(
            Fault.NOT_READY,
            "the machine is not idle",
            found=status.state,
            hint="let it finish, or stop it at the machine",
        )

    def _unsolicited(self, status: Status, now: float) -> None:
        """Reset a board that gave no banner, unless it is at work."""
        if status.state in ("Idle", "Alarm"):
            self._asked = RESET
            self._out += RESET
            self._deadline = now + self._patience.banner
        else:
            self._busy(status)

    def _overdue(self, now: float) -> None:
        if self.controller is None and self._asked is None:
            self._asked = STATUS
            self._out += STATUS
            self._deadline = now + self._patience.answer
        elif self.controller is None:
            self._fail(
                Fault.NO_GREETING,
                "no Grbl answers on this port",
                found="no banner" + (" after a reset" if self._asked == RESET else ""),
                hint="check the cable, the power, the port's name and the baud rate (115200)",
            )
        else:
            asked = (self._asked or b"").decode("ascii").strip()
            self._fail(
                Fault.SILENT,
                f"the machine fell silent at {asked}",
                hint="reset the machine and try again",
            )

    def _fail(self, fault: Fault, message: str, *, found: str = "", hint: str = "") -> None:
        self.failure = Failure(fault, message, found=found, hint=hint)
        self.over = True
