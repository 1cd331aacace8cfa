"""The first stage: from an opened port to a machine that is known and idle.

Opening the port resets most boards; what is sent before their banner vanishes, and what
they print before it (a settings dump, `error:7`) acknowledges nothing.  Boards that do not
reset on opening are asked for their state and left as they are: a reset would forget G92.
Every question is asked until two answers agree, so that a byte altered on the line neither
enlarges the buffer nor moves work zero.
"""

from relieffab.grbl.codes import error_meaning
from relieffab.grbl.controller import TELLING, Controller
from relieffab.grbl.messages import Acknowledgement, Alarm, Banner, Message, Note, Setting, Status
from relieffab.grbl.stage import STATUS, Failure, Fault, Patience

QUESTIONS = (b"$I\n", b"$$\n", b"$#\n", b"$G\n")
TRIES = 8
"""Answers to one question that may differ or fail before it is given up."""
GIVEN_UP = 3
"""Silences."""
_NEEDED = {b"$I\n": "OPT", b"$#\n": "G54", b"$G\n": "GC"}
_FEWEST_SETTINGS = 20


class Greeting:
    """Wait for the banner, ask the questions one by one, make sure of Idle.

    Parameters
    ----------
    patience : Patience
    now : float
    locked : bool
        A machine that waits to be homed will do.

    Attributes
    ----------
    controller : Controller or None
        Known once `over` without a failure.
    status : Status or None
        The report that said Idle.
    """

    def __init__(self, patience: Patience, now: float, *, locked: bool = False) -> None:
        self.controller: Controller | None = None
        self.status: Status | None = None
        self.failure: Failure | None = None
        self.over = False
        self._patience = patience
        self._locked_will_do = locked
        self._deadline = now + patience.banner
        self._asked = b""
        self._next = self._tries = 0
        self._heard: list[Setting | Note] = []
        self._before: list[list[Setting | Note]] = []
        self._out = b""

    def take(self, message: Message, now: float) -> None:
        """Take in one message."""
        if isinstance(message, Banner):
            self._begin(Controller(message.version, hal=message.hal), now)
        elif isinstance(message, Alarm) and not self._locked_will_do:
            self._locked(f"ALARM:{message.code}")
        elif self.controller is None:
            if isinstance(message, Status) and self._asked == STATUS:
                self._unsolicited(message, now)
        elif isinstance(message, Acknowledgement) and self._asked in QUESTIONS:
            self._answered(message, now)
        elif isinstance(message, Setting) or (isinstance(message, Note) and message.tag in TELLING):
            self._heard.append(message)
        elif isinstance(message, Status) and self._asked == STATUS:
            self.controller.limit_buffer(message.bytes_free or 0)
            self._judge(message)

    def give(self, now: float) -> bytes:
        """Give the bytes to send, and notice when an answer is overdue."""
        if not self.over and now >= self._deadline:
            self._overdue(now)
        out, self._out = self._out, b""
        return out

    def _begin(self, controller: Controller, now: float) -> None:
        self.controller = controller
        self._next = self._tries = 0
        self._before = []
        self._ask(now)

    def _ask(self, now: float) -> None:
        self._asked = STATUS if self._next == len(QUESTIONS) else QUESTIONS[self._next]
        self._heard = []
        self._out += self._asked
        self._deadline = now + self._patience.answer / 2

    def _answered(self, message: Acknowledgement, now: float) -> None:
        """Believe an answer that is whole and was heard twice."""
        heard, controller = self._heard, self.controller
        if message.code == 0 and controller and self._whole(heard) and heard in self._before:
            for part in heard:
                controller.learn(part)
            self._next, self._tries, self._before = self._next + 1, 0, []
        else:
            self._before.append(heard)
            self._tries += 1
            if self._tries >= TRIES:
                self._give_up(message)
                return
        self._ask(now)

    def _whole(self, heard: list[Setting | Note]) -> bool:
        if self._asked == b"$$\n":
            return sum(isinstance(part, Setting) for part in heard) >= _FEWEST_SETTINGS
        tags = {part.tag for part in heard if isinstance(part, Note)}
        return _NEEDED[self._asked] in tags

    def _give_up(self, message: Acknowledgement) -> None:
        asked = self._asked.decode("ascii").strip()
        if message.code:
            self._fail(
                Fault.NOT_READY,
                f"the machine does not answer {asked}",
                found=f"error:{message.code}, {error_meaning(message.code)}",
                hint="let the machine finish what it does, or reset it",
            )
        else:
            self._fail(
                Fault.GARBLED,
                f"the machine answers {asked} each time differently",
                hint="bytes are lost on the line: shorten the cable or use a shielded one",
            )

    def _judge(self, status: Status) -> None:
        if status.state == "Idle" or (status.state == "Alarm" and self._locked_will_do):
            self.status, self.over = status, True
        elif status.state == "Alarm":
            self._locked("Alarm")
        else:
            self._busy(status)

    def _locked(self, found: str) -> None:
        self._fail(
            Fault.NOT_READY,
            "the machine is locked by an alarm",
            found=found,
            hint="send again with --home, or with --unlock if its position is known to be right",
        )

    def _busy(self, status: Status) -> None:
        self._fail(
            Fault.NOT_READY,
            "the machine is not idle",
            found=status.state,
            hint="let it finish, or stop it at the machine",
        )

    def _unsolicited(self, status: Status, now: float) -> None:
        """Go on with a board that gave no banner, unless it is at work."""
        if status.state in ("Idle", "Alarm"):
            self._begin(Controller(), now)
        else:
            self._busy(status)

    def _overdue(self, now: float) -> None:
        self._tries += 1
        if self._tries < GIVEN_UP:
            if self.controller is None:
                self._next = len(QUESTIONS)
            self._ask(now)
        elif self.controller is None:
            self._fail(
                Fault.NO_GREETING,
                "no Grbl answers on this port",
                found="no banner and no status report",
                hint="check the cable, the power, the port's name and the baud rate (115200); "
                "a machine that stopped at a limit answers only after a reset",
            )
        else:
            asked = self._asked.decode("ascii").strip()
            self._fail(
                Fault.SILENT,
                f"the machine fell silent at {asked}",
                hint="reset the machine and try again",
            )

    def _fail(self, fault: Fault, message: str, *, found: str = "", hint: str = "") -> None:
        if self.failure is None:
            self.failure = Failure(fault, message, found=found, hint=hint)
        self.over = True
