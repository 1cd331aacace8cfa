"""What status reports give away: lost bytes, a wrong way, a stall, a hold nobody ends."""

from relieffab.grbl.codes import STATES
from relieffab.grbl.course import Course
from relieffab.grbl.lines import homes
from relieffab.grbl.messages import Status
from relieffab.grbl.stage import HOLD, RESUME, Failure, Fault, Patience
from relieffab.grbl.window import Window

TWICE = 2
"""Reports of one job that must miss bytes, or be off the way: one may itself be damaged.

They need not follow each other: on a sound line there is none, and a single altered command
may show in a single report.
"""
NOISY = 3
"""Damaged reports of one job after which the line is noisy: far more bytes go the other way."""


class Watch:
    """Judge each report against what was sent and acknowledged.

    Parameters
    ----------
    course : Course
    window : Window
    patience : Patience
    attended : bool
        Somebody can end a hold.
    """

    def __init__(
        self, course: Course, window: Window, patience: Patience, *, attended: bool
    ) -> None:
        self._course, self._window, self._patience = course, window, patience
        self._attended = attended
        self._asked: int | None = None
        self._missing = self._excess = self._off = self._damaged = 0
        self._counts = False  # until it reports a byte waiting, as some never do
        self._dwell = 0.0
        self._idle_since: float | None = None
        self._held_since: float | None = None
        self._capacity = window.capacity

    def asked(self) -> None:
        """Note how much had been sent when a report was asked for."""
        if self._asked is None:
            self._asked = self._window.total

    def sent(self, dwell: float) -> None:
        """Note a line that went out, and how long it lets the machine wait."""
        self._dwell = max(self._dwell, dwell)
        self._idle_since = None

    def acknowledged(self) -> None:
        """Note progress."""
        self._idle_since = None
        if not len(self._window):
            self._dwell = 0.0

    def told(self, data: bytes) -> None:
        """Note what a person told the machine."""
        if data in (HOLD, RESUME):
            self._held_since = None

    def report(self, status: Status, now: float) -> Failure | None:
        """Give the reason to stop, if the report gives one."""
        checks = (
            self._state(status),
            self._lost(status),
            self._foreign(status),
            self._wrong_way(),
            self._stalled(status, now),
            self._held(status, now),
        )
        return next((failure for failure in checks if failure is not None), None)

    def noise(self, text: str) -> Failure | None:
        """Take in a report that cannot be read."""
        self._damaged += 1
        if self._damaged < NOISY:
            return None
        return Failure(
            Fault.GARBLED,
            "status reports come damaged",
            found=ascii(text),
            hint="what is sent may be damaged as well: shorten the cable or use a shielded one",
        )

    def strayed(self) -> Failure | None:
        """Say whether the machine ended where the program does not."""
        return self._strayed() if self._course.astray else None

    def _state(self, status: Status) -> Failure | None:
        first = self._window.first
        if status.state == "Alarm" and not (first and homes(first.text)):
            return Failure(
                Fault.ALARM,
                "the machine is in alarm",
                hint="clear its cause, home or unlock the machine, and check the stock",
            )
        if status.state == "Sleep":
            return Failure(Fault.ASLEEP, "the machine went to sleep", found=STATES["Sleep", None])
        return None

    def _lost(self, status: Status) -> Failure | None:
        """Hold the controller's own count of bytes against ours."""
        asked, self._asked = self._asked, None
        if asked is None or status.bytes_free is None:
            return None
        self._capacity = max(self._capacity, status.bytes_free)
        used = self._capacity - status.bytes_free
        self._counts = self._counts or used > 0
        missing = self._window.missing(asked, used) if self._counts else 0
        if missing <= 0:
            return None
        self._missing += 1
        if self._missing < TWICE:
            return None
        return Failure(
            Fault.LOST_ACKNOWLEDGEMENT,
            "bytes were lost on the line",
            found=f"{missing} bytes that are not acknowledged are not in the machine's buffer",
            hint="shorten the cable or use a shielded one; check the stock",
        )

    def _foreign(self, status: Status) -> Failure | None:
        """Notice that more waits in the controller than was sent and is not acknowledged."""
        if status.bytes_free is None:
            return None
        used = self._capacity - status.bytes_free
        waiting = status.state == "Run" and status.blocks_free == 0
        self._excess += self._window.excess(used, waiting=waiting) > 0
        if self._excess < TWICE:
            return None
        return Failure(
            Fault.STRAY_ACKNOWLEDGEMENT,
            "the machine holds more than it was sent",
            found="bytes in its buffer that are acknowledged, or of somebody else",
            hint="another program writes to this port, or the line is noisy; check the stock",
        )

    def _wrong_way(self) -> Failure | None:
        if not self._course.astray:
            return None
        self._off += 1
        return self._strayed() if self._off >= TWICE else None

    def _strayed(self) -> Failure:
        return Failure(
            Fault.OFF_COURSE,
            "the machine is where the program does not go",
            found=f"{self._course.off_mm:.3f} mm from the programmed way",
            hint="a command was altered on the line: shorten the cable or use a shielded one, "
            "and check the stock",
        )

    def _stalled(self, status: Status, now: float) -> Failure | None:
        """Notice a machine that reports Idle and yet owes acknowledgements."""
        if status.state not in ("Idle", "Check") or not len(self._window):
            self._idle_since = None
            return None
        if self._idle_since is None:
            self._idle_since = now
        if now - self._idle_since <= self._patience.stall + self._dwell:
            return None
        return Failure(
            Fault.LOST_ACKNOWLEDGEMENT,
            "an acknowledgement never came",
            found=f"the machine is idle, lines unacknowledged: {len(self._window)}",
            hint="bytes were lost on the line: shorten the cable or use a shielded one",
        )

    def _held(self, status: Status, now: float) -> Failure | None:
        """Do not wait for ever where nobody can end a hold."""
        if status.state not in ("Hold", "Door", "Tool") or self._attended:
            self._held_since = None
            return None
        if self._held_since is None:
            self._held_since = now
        if now - self._held_since <= self._patience.unattended:
            return None
        return Failure(
            Fault.HELD,
            "the machine was held, and nobody let it go on",
            found=STATES.get((status.state, status.substate), status.state),
            hint="see what held it; noise on the line can, too",
        )
