"""The second stage: lines, one after the other, as fast as the receive buffer allows.

A job is done when its last line is acknowledged and two status reports in a row then say
Idle: the last `ok` can come 20 s before the machine stands still, and one single Idle may
be reported between that `ok` and the start of the last moves.
"""

from relieffab.grbl import lines
from relieffab.grbl.codes import alarm_meaning, error_meaning
from relieffab.grbl.course import Course
from relieffab.grbl.feed import Feed, alone
from relieffab.grbl.messages import (
    Acknowledgement,
    Alarm,
    Banner,
    Message,
    Other,
    Status,
    damaged,
    damaged_report,
)
from relieffab.grbl.program import Line
from relieffab.grbl.stage import Failure, Fault, Patience, Poll
from relieffab.grbl.watch import Watch
from relieffab.grbl.window import Window

IDLE_REPORTS = 2
SOFT_LIMIT = 2


class Streaming:
    """Send what `feed` gives, counting characters against `buffer` bytes.

    Parameters
    ----------
    feed : Feed
    course : Course
        Told every line, so that the machine can be found on it.
    buffer : int
    patience : Patience
    now : float
    attended : bool
        Somebody can end a hold.
    checking : bool
        The machine is in check mode: errors are gathered, not fatal.

    Attributes
    ----------
    acknowledged : int
        Lines acknowledged so far, those before the first one sent included.
    status : Status or None
        The latest report.
    errors : list of str
        What check mode refused.
    """

    def __init__(
        self, feed: Feed, course: Course, buffer: int, patience: Patience, now: float,
        *, attended: bool = False, checking: bool = False,
    ) -> None:  # fmt: skip
        self.failure: Failure | None = None
        self.over = False
        self.acknowledged = feed.next.index if feed.next else 0
        self.status: Status | None = None
        self.errors: list[str] = []
        self.window = Window(buffer)
        self._feed, self._course = feed, course
        self._checking = checking
        self._poll = Poll(patience.poll, now)
        self._watch = Watch(course, self.window, patience, attended=attended)
        self._patience = patience
        self._silence = patience.answer
        self._alone = False
        self._idle = IDLE_REPORTS
        self._last: Line | None = None
        self._out = b""

    @property
    def held(self) -> bool:
        """True while the machine waits to be resumed."""
        return self.status is not None and self.status.held

    def command(self, data: bytes) -> None:
        """Send real-time bytes out of band."""
        self._watch.told(data)
        self._out += data

    def take(self, message: Message, now: float) -> None:
        """Take in one message."""
        if isinstance(message, Acknowledgement):
            self._poll.heard(now)
            self._acknowledge(message.code)
        elif isinstance(message, Status):
            self._poll.heard(now)
            self._report(message, now)
        elif isinstance(message, Alarm):
            self.fail(_alarmed(message.code, self.window.first))
        elif isinstance(message, Banner):
            self.fail(_restarted(message))
        elif isinstance(message, Other):
            self._unread(message.text)

    def _unread(self, text: str) -> None:
        if len(self.window) and damaged(text):
            self.fail(_garbled(text))
        elif damaged_report(text) and (failure := self._watch.noise(text)):
            self.fail(failure)

    def give(self, now: float) -> bytes:
        """Give the bytes to send, and notice what is overdue."""
        if not self.over and self._poll.silence(now) > self._silence:
            self.fail(_silent(self._silence))
        if self.over:
            return b""
        out = self._out + self._fill()
        self._out = b""
        if not self._alone and (asked := self._poll.due(now)):
            self._watch.asked()
            return out + asked
        return out

    def fail(self, failure: Failure) -> None:
        """Stop sending; the first reason is kept."""
        if self.failure is None:
            self.failure = failure
        self.over = True

    def _fill(self) -> bytes:
        """Take lines from the feed while the buffer holds them."""
        feed, window, out = self._feed, self.window, b""
        while (line := feed.next) is not None and not self._alone:
            if not window.fits(len(line.wire)):
                break
            if alone(line):
                if len(window) or self._idle < IDLE_REPORTS:
                    break  # it would wait for the moves, and nobody ask how it is
                self._alone = True
                homes = lines.homes(line.text)
                self._silence = self._patience.homing if homes else self._patience.answer
            line, motion = feed.take()
            self._course.known = self._course.known and feed.followed
            self._course.sent(line, motion)
            window.sent(line)
            self._watch.sent(lines.dwell_seconds(line.text) if b"P" in line.wire else 0.0)
            self._last, self._idle = line, 0
            out += line.wire
        return out

    def _acknowledge(self, code: int) -> None:
        line, behind = self.window.acknowledged(), len(self.window)
        self._idle = 0
        if line is None:
            self.fail(_stray(code))
            return
        if code and not self._checking:
            self._course.refused(line)
            self.fail(_refused(line, code, behind))
            return
        if code:
            self.errors.append(f"{line.where}: error:{code}, {error_meaning(code)}")
        self.acknowledged = line.index + 1
        self._course.acknowledged(line)
        self._watch.acknowledged()
        if not behind:
            self._alone = False
            self._silence = self._patience.answer

    def _report(self, status: Status, now: float) -> None:
        self.status = status
        at_rest = status.state in ("Idle", "Check")
        if not self._checking:
            self._course.report(status)
        failure = self._watch.report(status, now)
        if failure is not None:
            self.fail(failure)
        elif at_rest and not len(self.window):
            self._idle += 1
            if self._feed.next is None and self._idle >= IDLE_REPORTS:
                self._finish()

    def _finish(self) -> None:
        if failure := self._watch.strayed():
            self.fail(failure)
            return
        if self._last is not None and not self._checking:
            self._course.finish(self._last)
        self.over = True


def _alarmed(code: int, line: Line | None) -> Failure:
    """Name the line where Grbl finds the fault as it reads it: a soft limit."""
    read = code == SOFT_LIMIT and line is not None
    return Failure(
        Fault.ALARM,
        "the machine raised an alarm",
        found=f"ALARM:{code}, {alarm_meaning(code)}",
        hint="clear its cause, home or unlock the machine, and check the stock",
        alarm=code,
        where=line.where if read and line else "",
    )


def _restarted(banner: Banner) -> Failure:
    return Failure(
        Fault.RESTARTED,
        "the machine restarted in the middle of the job",
        found=f"the banner of Grbl {banner.version}",
        hint="look for a power dip or noise on the line, home it, set work zero again",
    )


def _garbled(text: str) -> Failure:
    return Failure(
        Fault.GARBLED,
        "an acknowledgement came damaged",
        found=ascii(text),
        hint="what is sent may be damaged as well: shorten the cable or use a shielded one",
    )


def _silent(seconds: float) -> Failure:
    return Failure(
        Fault.SILENT,
        "the machine fell silent",
        found=f"no answer for {seconds:g} s",
        hint="the machine may go on with what it has: watch the spindle",
    )


def _stray(code: int) -> Failure:
    return Failure(
        Fault.STRAY_ACKNOWLEDGEMENT,
        "the machine acknowledged a line that was not sent",
        found=f"error:{code}" if code else "ok",
        hint="another program writes to this port, or the line is noisy; check the stock",
    )


def _refused(line: Line, code: int, behind: int) -> Failure:
    return Failure(
        Fault.REFUSED,
        "the machine refused a line",
        found=f"error:{code}, {error_meaning(code)}",
        hint=f"the next {behind} lines were already on their way and may have run"
        if behind
        else "",
        where=line.where,
    )
