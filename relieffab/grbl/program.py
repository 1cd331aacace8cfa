"""A program made ready for the wire: cleaned, checked and measured before a byte is sent."""

import re
from array import array
from collections.abc import Iterable
from dataclasses import dataclass

from relieffab.errors import InputError
from relieffab.grbl.travel import Tracker

LONGEST_LINE = 79
"""Significant characters Grbl takes in one line; one more is error 11."""

_LINE_END = re.compile(r"\r\n|\r|\n")  # str.splitlines also splits at characters of comments
_COMMENT = re.compile(r"\([^)]*\)?|;.*")
_WORDS = re.compile(r"(?:[A-Z][-+]?(?:\d+\.?\d*|\.\d+))+")
_ALONE = re.compile(r"G0*10(?![\d.])|G0*(?:28|30)\.10*(?!\d)")
_PAUSE = re.compile(r"M0+(?![\d.])")
_DWELL = re.compile(r"G0*4(?![\d.]).*?P([\d.]+)|P([\d.]+).*?G0*4(?![\d.])")

Bounds = tuple[tuple[float | None, ...], tuple[float | None, ...]]


@dataclass(frozen=True)
class Program:
    """Clean lines, stored end to end: about 45 bytes for a line of 25 characters.

    Parameters
    ----------
    text : bytes
        The lines as they go over the wire, each with its line feed.
    ends : array of int
        Offset behind each line in `text`.
    numbers : array of int
        Line number in the source, from 1.
    cut : array of float
        Length of cut up to and with each line, mm.
    bounds : tuple
        Lowest and highest named X, Y, Z in work coordinates, mm; None where never named.
    bounds_certain : bool
        False where the program uses codes that the bounds do not follow.
    pauses : tuple of int
        Source line numbers of M0.
    alone : frozenset of int
        Indices of lines on which Grbl writes its EEPROM and so loses bytes that arrive.
    dwells : dict
        Index -> seconds of the lines with G4.
    """

    text: bytes
    ends: array
    numbers: array
    cut: array
    bounds: Bounds
    bounds_certain: bool
    pauses: tuple[int, ...]
    alone: frozenset[int]
    dwells: dict[int, float]

    def __len__(self) -> int:
        return len(self.ends)

    def line(self, index: int) -> bytes:
        """Line `index`, from 0, as it goes over the wire."""
        return self.text[self.ends[index - 1] if index else 0 : self.ends[index]]

    def where(self, index: int) -> str:
        """Line `index` for people, with its number in the source."""
        return f"line {self.numbers[index]}: {self.line(index).decode('ascii').strip()}"

    @property
    def cut_mm(self) -> float:
        """Length of cut of the whole program, mm."""
        return float(self.cut[-1]) if self.cut else 0.0


def clean(line: str) -> str:
    """Take comments and white space out of a line, as Grbl would, and raise its case.

    Examples
    --------
    >>> clean("g1 x1.5 (across) y-2 ; back")
    'G1X1.5Y-2'
    >>> clean("%")
    ''
    """
    if "(" in line or ";" in line:
        line = _COMMENT.sub("", line)
    bare = "".join(line.split()).upper()
    return "" if bare == "%" else bare


def stands_alone(line: str) -> bool:
    """Say whether Grbl writes its EEPROM on this line.

    Examples
    --------
    >>> stands_alone("G10L2P1X0"), stands_alone("G28")
    (True, False)
    """
    return _ALONE.search(line) is not None


def dwell_seconds(line: str) -> float:
    """Seconds that a G4 on this line waits.

    Examples
    --------
    >>> dwell_seconds("G4P2.5")
    2.5
    """
    match = _DWELL.search(line) if "P" in line else None
    return float(match[1] or match[2]) if match else 0.0


def prepare(source: str | Iterable[str]) -> Program:
    """Clean, check and measure a program in one pass.

    Parameters
    ----------
    source : str or iterable of str
        The text, or its lines (an open file will do).

    Raises
    ------
    InputError
        At the first line that Grbl would misread, with its number.
    """
    parts = [source] if isinstance(source, str) else source
    lines = (line for part in parts for line in _LINE_END.split(part.removesuffix("\n")))
    text, ends, numbers, cut = bytearray(), array("Q"), array("L"), array("d")
    tracker, length = Tracker(), 0.0
    pauses: list[int] = []
    alone: list[int] = []
    dwells: dict[int, float] = {}
    for number, raw in enumerate(lines, start=1):
        line = clean(raw)
        if not line:
            continue
        check(line, number)
        if "M0" in line and _PAUSE.search(line):
            pauses.append(number)
        if stands_alone(line):
            alone.append(len(ends))
        if seconds := dwell_seconds(line):
            dwells[len(ends)] = seconds
        length += tracker.follow(line)
        text += line.encode("ascii") + b"\n"
        ends.append(len(text))
        numbers.append(number)
        cut.append(length)
    if not ends:
        raise InputError("the program is empty", expected="at least one line of G-code")
    bounds = (tuple(tracker.low), tuple(tracker.high))
    return Program(
        bytes(text), ends, numbers, cut,
        bounds, tracker.certain, tuple(pauses), frozenset(alone), dwells,
    )  # fmt: skip


def check(line: str, number: int) -> None:
    """Refuse what must not reach the wire: `line` is clean, `number` its source line."""
    where = f"line {number}"
    if line.startswith("$"):
        raise InputError(
            "a program may not hold $ commands",
            expected="G-code",
            found=line,
            where=where,
            hint="set up the machine before the program is sent",
        )
    if len(line) > LONGEST_LINE:
        raise InputError(
            "the line is too long for Grbl",
            expected=f"at most {LONGEST_LINE} characters without spaces and comments",
            found=f"{len(line)}",
            where=where,
        )
    if _WORDS.fullmatch(line) is None:
        raise InputError(
            "the line is not G-code",
            expected="words of a letter and a number, plain ASCII",
            found=ascii(line),
            where=where,
            hint="some other characters (! ~ ? and all beyond ASCII) command Grbl at once",
        )
