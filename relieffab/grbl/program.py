"""A program made ready for the wire: cleaned, checked and measured before a byte is sent.

The clean lines wait in an unnamed temporary file, so that a job of any length takes the same
little memory, and nobody changes a program while it is carved.
"""

import hashlib
import math
import re
import struct
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import IO

from relieffab.errors import InputError
from relieffab.grbl import lines
from relieffab.grbl.messages import AXES
from relieffab.grbl.tracker import Tracker
from relieffab.grbl.way import Motion

IN_MEMORY = 1 << 22
"""Bytes up to which a program needs no file."""
BLOCK = 1 << 13
"""Bytes, or pieces, read at once."""
PIECE = struct.Struct("<Lfffff")
"""One straight piece of the way: index of its line, dx, dy, dz (mm), da (degrees), mm/min.

Rapids have a feed of inf.

Where the feed is negative the machine rests for as many seconds.
"""

_NOWHERE = (0.0,) * AXES
_LINE_END = re.compile(r"\r\n|\r|\n")  # str.splitlines also splits at characters of comments

Bounds = tuple[tuple[float | None, ...], tuple[float | None, ...]]


@dataclass(frozen=True, slots=True)
class Line:
    """One line as it goes over the wire.

    Parameters
    ----------
    index : int
        From 0, among the lines that are sent.
    number : int
        Line number in the source, from 1.
    wire : bytes
        With its line feed.
    """

    index: int
    number: int
    wire: bytes

    @property
    def text(self) -> str:
        """Without its line feed."""
        return self.wire[:-1].decode("ascii")

    @property
    def where(self) -> str:
        """For people."""
        return f"line {self.number}: {self.text}"


class Program:
    """Clean lines, and what is known of them as a whole.

    Attributes
    ----------
    cut_mm : float
        Length of G1, G2 and G3 moves, mm; a degree of A counts as one, as controllers have it.
    dwell_s : float
        Seconds of all G4.
    bounds : tuple
        Lowest and highest named X, Y, Z in work coordinates, mm, and A, degrees, if there is
        one; None where never named.
    bounds_certain : bool
        False where the program uses codes that the bounds do not follow.
    pauses : list of int
        Source line numbers of M0.
    quiet : bool
        True where spindle and coolant are off at the end.
    plunge : float
        Slowest feed of a descending cut, mm/min; inf where there is none.
    speed : float
        Highest S, rpm.
    codes : dict
        G and M words it uses (plain G0 and G1 may be left out), and letters beyond Grbl's own
        -> first line of the source.
    digest : str
        SHA-256 of the clean lines, in hexadecimal: comments do not count.
    """

    def __init__(self) -> None:
        self.cut_mm = self.dwell_s = 0.0
        self.pauses: list[int] = []
        self.codes: dict[str, int] = {}
        self._count = 0
        self._text: IO[bytes] = tempfile.SpooledTemporaryFile(IN_MEMORY)  # noqa: SIM115
        self._pieces: IO[bytes] = tempfile.SpooledTemporaryFile(IN_MEMORY)  # noqa: SIM115
        self._hash = hashlib.sha256()
        self._finish(Tracker())

    def _finish(self, tracker: Tracker) -> None:
        self.bounds: Bounds = (tuple(tracker.low), tuple(tracker.high))
        self.bounds_certain = tracker.certain
        self.quiet = tracker.modal.quiet
        self.plunge, self.speed = tracker.plunge, tracker.fastest_spindle
        self.digest = self._hash.hexdigest()

    def __len__(self) -> int:
        return self._count

    def read(self) -> Iterator[Line]:
        """Yield the lines, reading a little at a time; several readers do not disturb."""
        at, rest, index = 0, b"", 0
        while True:
            self._text.seek(at)
            data = self._text.read(BLOCK)
            if not data:
                return
            at += len(data)
            *records, rest = (rest + data).split(b"\n")
            for record in records:
                number, _, wire = record.partition(b" ")
                yield Line(index, int(number), wire + b"\n")
                index += 1

    def line(self, index: int) -> Line:
        """Find one line; reads all before it."""
        return next(line for line in self.read() if line.index == index)

    def pieces(self) -> Iterator[bytes]:
        """Yield the straight pieces of the way in blocks of whole `PIECE` records."""
        at = 0
        while True:
            self._pieces.seek(at)
            data = self._pieces.read(BLOCK * PIECE.size)
            if not data:
                return
            at += len(data)
            yield data

    def _append(self, number: int, line: str, motion: Motion | None) -> None:
        wire = line.encode("ascii") + b"\n"
        self._text.write(b"%d %b" % (number, wire))
        self._hash.update(wire)
        if seconds := lines.dwell_seconds(line):
            self.dwell_s += seconds
            self._pieces.write(PIECE.pack(self._count, *_NOWHERE, -seconds))
        if motion is not None:
            self._put(motion)
            if motion.cutting:
                self.cut_mm += motion.length
        self._count += 1

    def _put(self, motion: Motion) -> None:
        start = motion.start
        for point in motion.points:
            step = [
                0.0 if p is None or q is None else q - p for p, q in zip(start, point, strict=True)
            ]
            self._pieces.write(PIECE.pack(self._count, *step, *_NOWHERE[len(step) :], motion.feed))
            start = point


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
    program, tracker = Program(), Tracker()
    for number, raw in enumerate(split(source), start=1):
        line = lines.clean(raw)
        if not line:
            continue
        lines.check(line, number)
        if lines.pauses(line):
            program.pauses.append(number)
        program._append(number, line, tracker.follow(line))
        if len(tracker.codes) > len(program.codes):
            program.codes |= dict.fromkeys(tracker.codes - program.codes.keys(), number)
    if not len(program):
        raise InputError("the program is empty", expected="at least one line of G-code")
    program._finish(tracker)
    return program


def commands(*wanted: str) -> Program:
    """Give lines of our own, `$` commands included, as a program."""
    program, tracker = Program(), Tracker()
    for number, line in enumerate(wanted, start=1):
        program._append(number, line, tracker.follow(line))
    program._finish(tracker)
    return program


def split(source: str | Iterable[str]) -> Iterator[str]:
    """Yield lines, whatever ends them."""
    for part in [source] if isinstance(source, str) else source:
        bare = part[:-1] if part.endswith("\n") else part
        if "\r" in bare or "\n" in bare:
            yield from _LINE_END.split(bare.removesuffix("\r"))
        else:
            yield bare


def top(program: Program) -> float:
    """Highest Z of a program, mm; -inf where it names none."""
    highest = program.bounds[1][2]
    return -math.inf if highest is None else highest
