"""What Grbl says, read: bytes to lines, lines to messages.

Only the exact lines `ok` and `error:N` acknowledge anything.  Everything else that may
look like it (`>G21:ok` of a startup block, `[MSG:ok]`, a garbled `o?k`) is told apart here.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from relieffab.grbl.modal import MM_PER_INCH

Point = tuple[float, ...]
"""X, Y, Z in mm and, of a machine that has one, A in degrees."""

AXES = 4
"""That a machine may have here: X, Y, Z, and A about X."""
LONGEST_LINE = 4096
"""Bytes without a line end beyond which the input is noise, not a line."""


@dataclass(frozen=True, slots=True)
class Acknowledgement:
    """`ok` (code 0) or `error:N`."""

    code: int


@dataclass(frozen=True, slots=True)
class Alarm:
    """`ALARM:N`."""

    code: int


@dataclass(frozen=True, slots=True)
class Banner:
    """The greeting after every start or reset."""

    version: str
    hal: bool = False


@dataclass(frozen=True, slots=True)
class Setting:
    """One line `$number=value` of the `$$` dump."""

    number: int
    value: float


@dataclass(frozen=True, slots=True)
class Note:
    """`[TAG:text]`: an answer to a question, or a message."""

    tag: str
    text: str


@dataclass(frozen=True, slots=True)
class Status:
    """One status report; what it leaves out is None.

    Parameters
    ----------
    state : str
        Idle, Run, Hold, Jog, Alarm, Door, Check, Home, Sleep; grblHAL has Tool too.
    substate : int or None
        Behind the colon: Hold:0 has stopped, Hold:1 is still slowing down; Door:0 is closed and
        waits, 1 is open, 2 is still slowing down, 3 starts again.
    machine, work, offset : tuple of float or None
        MPos, WPos and WCO, mm; A in degrees.
    blocks_free, bytes_free : int or None
        Room in the planner and in the receive buffer.
    feed, speed : float or None
        mm/min and rpm.
    overrides : tuple of 3 int or None
        Feed, rapids and spindle, percent.
    pins : str
        Inputs that are active: X Y Z limits, P probe, D door, H hold, R reset, S start.
    """

    state: str
    substate: int | None = None
    machine: Point | None = None
    work: Point | None = None
    offset: Point | None = None
    blocks_free: int | None = None
    bytes_free: int | None = None
    feed: float | None = None
    speed: float | None = None
    overrides: tuple[int, int, int] | None = None
    pins: str = ""

    @property
    def held(self) -> bool:
        """True where the axes stand still and a person has to let them go on."""
        return (self.state == "Hold" and self.substate == 0) or (
            self.state == "Door" and self.substate in (0, 1)
        )

    @property
    def stopped(self) -> bool:
        """True where the axes stand still and will stay so."""
        return self.held or self.state in ("Idle", "Alarm", "Check", "Sleep")

    def in_mm(self) -> "Status":
        """Give the report of a machine that reports inches ($13=1) in millimetres."""
        return replace(
            self,
            machine=_scaled(self.machine),
            work=_scaled(self.work),
            offset=_scaled(self.offset),
            feed=None if self.feed is None else self.feed * MM_PER_INCH,
        )


@dataclass(frozen=True, slots=True)
class Other:
    """Anything else: startup blocks, noise."""

    text: str


Message = Acknowledgement | Alarm | Banner | Setting | Note | Status | Other

OK = Acknowledgement(0)
_BANNER = re.compile(r"Grbl(HAL)? (\S+) \[", re.IGNORECASE)
STATES = {"Idle", "Run", "Hold", "Jog", "Alarm", "Door", "Check", "Home", "Sleep", "Tool"}
_NUMBERED = {"Hold", "Door"}
_POSITIONS = {"MPos", "WPos"}
_PLAIN_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_NUMBER = r"-?(?:\d+\.?\d*|\.\d+)"
_READERS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], Message]], ...] = (
    (re.compile(r"error:(\d{1,3})$"), lambda match: Acknowledgement(int(match[1]))),
    (re.compile(r"ALARM:(\d{1,3})$"), lambda match: Alarm(int(match[1]))),
    (re.compile(rf"\$(\d+)=({_NUMBER})"), lambda match: Setting(int(match[1]), float(match[2]))),
    (re.compile(r"\[([^:\]]+):(.*)\]$"), lambda match: Note(match[1], match[2])),
)


class LineSplitter:
    """Lines out of a stream of bytes that comes in any pieces."""

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[str]:
        """Take bytes, give the lines completed by them, without their line ends."""
        if b"\n" not in data:
            self._rest = (self._rest + data)[-LONGEST_LINE:]
            return []
        *lines, self._rest = (self._rest + data).split(b"\n")
        return [line.rstrip(b"\r").decode("ascii", "replace") for line in lines]


def parse(line: str) -> Message:
    r"""Read one line of Grbl's.

    Examples
    --------
    >>> parse("ok"), parse("error:22")
    (Acknowledgement(code=0), Acknowledgement(code=22))
    >>> parse(">G21:ok")
    Other(text='>G21:ok')
    >>> parse("<Hold:1|MPos:1.000,2.000,-0.500|FS:300,0>").substate
    1
    """
    if line == "ok":
        return OK
    if line.startswith("<"):
        return _status(line)
    for pattern, make in _READERS:
        if match := pattern.match(line):
            return make(match)
    banner = _BANNER.search(line)
    return Banner(banner[2], hal=banner[1] is not None) if banner else Other(line)


def _status(line: str) -> Message:
    """Read `<State|Key:values|...>`; a damaged report says nothing at all."""
    head, *fields = line[1:-1].split("|")
    state, _, substate = head.partition(":")
    values = dict(field.partition(":")[::2] for field in fields)
    whole = line.endswith(">") and state in STATES and _POSITIONS & values.keys()
    if not whole or (state in _NUMBERED and not substate):
        return Other(line)
    try:
        feed, speed = _numbers(values.get("FS", values.get("F", "0") + ",0"), 2)
        blocks, free = _numbers(values["Bf"], 2) if "Bf" in values else (None, None)
        over = _numbers(values["Ov"], 3) if "Ov" in values else None
        return Status(
            state,
            int(substate) if substate else None,
            machine=_point(values.get("MPos")),
            work=_point(values.get("WPos")),
            offset=_point(values.get("WCO")),
            blocks_free=None if blocks is None else int(blocks),
            bytes_free=None if free is None else int(free),
            feed=feed,
            speed=speed,
            overrides=None if over is None else (int(over[0]), int(over[1]), int(over[2])),
            pins=values.get("Pn", ""),
        )
    except ValueError:
        return Other(line)


def _numbers(text: str, least: int, most: int = 0) -> tuple[float, ...]:
    parts = text.split(",")
    if len(parts) < least or not all(_PLAIN_NUMBER.fullmatch(part) for part in parts):
        raise ValueError(text)
    return tuple(float(part) for part in parts[: most or least])


def _point(text: str | None) -> Point | None:
    if text is None:
        return None
    x, y, z, *turn = _numbers(text, 3, AXES)
    return x, y, z, *turn


def _scaled(point: Point | None) -> Point | None:
    if point is None:
        return None
    return scaled(point, MM_PER_INCH)


def scaled(point: Point, scale: float) -> Point:
    """Scale lengths; degrees stay as they are."""
    x, y, z, *turn = point
    return x * scale, y * scale, z * scale, *turn


def damaged(text: str) -> bool:
    """Say whether a line that means nothing may have been an `ok` or an `error:N`.

    Examples
    --------
    >>> damaged("o?k"), damaged("okok"), damaged("erro:22"), damaged("0,0>")
    (True, True, True, False)
    """
    part_of_a_report = any(mark in text for mark in "<>|[],.$")
    short = 0 < len(text) <= 5 and ":" not in text
    error = len(text) <= 10 and ("rr" in text or "ror" in text)
    return (short or error) and not part_of_a_report


def damaged_report(text: str) -> bool:
    """Say whether a line that means nothing may have been a status report.

    Examples
    --------
    >>> damaged_report("Idle|MPos:0.000,0.0"), damaged_report(">G21:ok")
    (True, False)
    """
    return text.startswith("<") or "|" in text or text.endswith(">")
