"""What every stage of a session shares: patience, polling, and how a stage fails."""

from dataclasses import dataclass
from enum import Enum, auto

STATUS = b"?"
HOLD = b"!"
RESUME = b"~"
RESET = b"\x18"


@dataclass(frozen=True)
class Patience:
    """How long to wait for what, seconds.

    Parameters
    ----------
    banner : float
        After opening the port, for the greeting of a board that resets then.
    answer : float
        For the answer to a question, and for any sign of life while cutting.
    stall : float
        For an acknowledgement while the machine reports that it has nothing to do; some
        controllers wait that long for the spindle.
    hold : float
        For the axes to come to rest after a feed hold.
    again : float
        Before a feed hold or a reset that changed nothing is sent again.
    unattended : float
        In a hold or at an open door that nobody at the keyboard can end.
    homing : float
        For a machine to find its switches.
    reconnect : float
        For a port that went away to come back.
    poll : float
        Between two status queries; 0.2 costs Grbl 0.5 % of its time.
    """

    banner: float = 3.0
    answer: float = 5.0
    stall: float = 6.0
    hold: float = 30.0
    again: float = 0.6
    unattended: float = 60.0
    homing: float = 180.0
    reconnect: float = 20.0
    poll: float = 0.2


class Fault(Enum):
    """Why a session cannot go on."""

    NO_GREETING = auto()
    NOT_READY = auto()
    MISFIT = auto()
    REFUSED = auto()
    ALARM = auto()
    RESTARTED = auto()
    SILENT = auto()
    LOST_ACKNOWLEDGEMENT = auto()
    STRAY_ACKNOWLEDGEMENT = auto()
    GARBLED = auto()
    OFF_COURSE = auto()
    HELD = auto()
    ASLEEP = auto()
    UNPLUGGED = auto()
    UNRECORDED = auto()
    CANCELLED = auto()


@dataclass(frozen=True)
class Failure:
    """One fault, with words for people.

    Parameters
    ----------
    fault : Fault
    message, found, hint : str
        What went wrong, what Grbl said and means by it, what to do next.
    where : str
        The line at fault, where one is.
    alarm : int or None
        Grbl's number.
    """

    fault: Fault
    message: str
    found: str = ""
    hint: str = ""
    where: str = ""
    alarm: int | None = None


class Poll:
    """Status queries: never more often than `interval`, and how long nothing was heard."""

    def __init__(self, interval: float, now: float) -> None:
        self._interval = interval
        self._asked = now
        self._heard = now

    def due(self, now: float) -> bytes:
        """Give the query if it is time for one."""
        if now - self._asked < self._interval:
            return b""
        self._asked = now
        return STATUS

    def heard(self, now: float) -> None:
        """Note a sign of life."""
        self._heard = now

    def silence(self, now: float) -> float:
        """Seconds since the last sign of life."""
        return now - self._heard
