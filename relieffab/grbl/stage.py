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
        For an acknowledgement while the machine reports that it has nothing to do.
    hold : float
        For the axes to come to rest after a feed hold.
    poll : float
        Between two status queries; 0.2 costs Grbl 0.5 % of its time.
    """

    banner: float = 3.0
    answer: float = 5.0
    stall: float = 3.0
    hold: float = 30.0
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
    CANCELLED = auto()


@dataclass(frozen=True)
class Failure:
    """One fault, with words for people.

    Parameters
    ----------
    fault : Fault
    message, found, hint : str
        What went wrong, what Grbl said and means by it, what to do next.
    line : int or None
        Index into the program of the line at fault, or of the first not acknowledged.
    """

    fault: Fault
    message: str
    found: str = ""
    hint: str = ""
    line: int | None = None


class Poll:
    """Status queries: never more often than `interval`, and how long none was answered."""

    def __init__(self, interval: float, now: float) -> None:
        self._interval = interval
        self._asked = now
        self._answered = now

    def due(self, now: float) -> bytes:
        """Give the query if it is time for one."""
        if now - self._asked < self._interval:
            return b""
        self._asked = now
        return STATUS

    def answered(self, now: float) -> None:
        """Note a report."""
        self._answered = now

    def silence(self, now: float) -> float:
        """Seconds since the last report."""
        return now - self._answered
