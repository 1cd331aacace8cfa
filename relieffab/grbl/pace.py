"""How long the rest of a job takes: the planner's arithmetic, corrected by what happened.

Speeds are planned as Grbl 1.1 plans them: corners by the junction deviation, straights by
trapezoids under each axis's acceleration and top rate, never faster than the machine could
still stop at the end of the moves it looks ahead, nor than it can read lines.
"""

import math
from array import array
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.grbl.messages import AXES
from relieffab.grbl.program import PIECE, Program

Floats = NDArray[np.float64]
STEP = 256
"""Lines between two entries of a timetable."""
OVERLAP = 512
"""Pieces of the next block that the backward pass looks at."""
BELIEF = 30.0
"""Seconds that the model's own word weighs against the clock's."""
_RECORD = np.dtype([("line", "<u4"), ("d", "<f4", AXES), ("feed", "<f4")])
_STRAIGHT = 0.999999


@dataclass(frozen=True)
class Limits:
    """What the machine can do: mm/min, mm/s², mm, moves, lines a second; degrees for mm of A."""

    max_rate: tuple[float, ...] = (1000.0, 1000.0, 1000.0)
    acceleration: tuple[float, ...] = (100.0, 100.0, 100.0)
    junction: float = 0.01
    blocks: int = 15
    line_rate: float = 450.0


class Timetable:
    """Seconds from the start of a program to the end of its lines.

    Parameters
    ----------
    program : Program
    limits : Limits
    """

    def __init__(self, program: Program, limits: Limits) -> None:
        self._seconds = array("d", [0.0])
        self._lines = len(program)
        total, speed2 = 0.0, 0.0
        for block, ahead in _paired(program):
            seconds, speed2 = _block_seconds(block, ahead, limits, speed2)
            slots = block["line"] // STEP
            self._enter(slots, total + np.cumsum(seconds))
            total += float(seconds.sum())
        self.total = total
        self._fill(self._lines // STEP + 2, total)

    def at(self, index: int) -> float:
        """Seconds at the start of line `index`."""
        slot, rest = divmod(min(index, self._lines), STEP)
        a, b = self._seconds[slot], self._seconds[slot + 1]
        width = min(STEP, self._lines - slot * STEP)
        return a + (b - a) * rest / width if width else b

    def line_at(self, seconds: float) -> int:
        """Give the index of the line that is cut `seconds` after the start."""
        low, high = 0, self._lines
        while low < high:
            middle = (low + high) // 2
            if self.at(middle + 1) <= seconds:
                low = middle + 1
            else:
                high = middle
        return min(low, self._lines - 1)

    def _enter(self, slots: NDArray[np.uint32], clock: Floats) -> None:
        last = np.flatnonzero(np.diff(slots, append=slots[-1] + 1))
        for at in last:
            self._fill(int(slots[at]) + 1, self._seconds[-1])
            upto = int(slots[at]) + 1
            if len(self._seconds) > upto:
                self._seconds[upto] = float(clock[at])
            else:
                self._seconds.append(float(clock[at]))

    def _fill(self, count: int, value: float) -> None:
        while len(self._seconds) < count:
            self._seconds.append(value)


class Pace:
    """Time left, from a timetable and the clock.

    Parameters
    ----------
    table : Timetable
    first : int
        The line the job starts at.
    """

    def __init__(self, table: Timetable, first: int = 0) -> None:
        self._table = table
        self._begin = table.at(first)
        self._spent = 0.0
        self._last: float | None = None

    def tick(self, now: float, *, moving: bool) -> None:
        """Count time, but not the time spent held."""
        if self._last is not None and moving:
            self._spent += now - self._last
        self._last = now

    def left(self, reached: int) -> float:
        """Seconds from line `reached` to the end."""
        done = self._table.at(reached)
        planned = done - self._begin
        rest = max(self._table.total - done, 0.0)
        return rest * (self._spent + BELIEF) / (planned + BELIEF)


def _paired(program: Program) -> Iterator[tuple[NDArray, NDArray]]:
    """Yield each block of pieces with the one behind it."""
    last = None
    for data in program.pieces():
        block = np.frombuffer(data[: len(data) // PIECE.size * PIECE.size], _RECORD)
        if last is not None:
            yield last, block
        last = block
    if last is not None:
        yield last, np.empty(0, _RECORD)


def _block_seconds(
    block: NDArray, ahead: NDArray, limits: Limits, speed2: float
) -> tuple[Floats, float]:
    """Seconds of every piece of a block, and the squared speed at its end."""
    pieces = np.concatenate([block, ahead[:OVERLAP]])
    d = pieces["d"][:, : len(limits.max_rate)].astype(float)
    mm = np.sqrt((d**2).sum(axis=1))
    moves = np.flatnonzero(mm > 0)
    feed = pieces["feed"].astype(float)
    seconds = np.where(mm > 0, 0.0, np.maximum(-feed, 0.0))
    if not len(moves):
        return seconds[: len(block)], 0.0
    rests = np.cumsum((mm == 0) & (feed < 0))[moves]
    entry, a, nominal = _speeds(d[moves], mm[moves], feed[moves], rests, limits)
    leave = np.append(_forward(entry, a, mm[moves], speed2), 0.0)
    seconds[moves] = _trapezoid(leave[:-1], leave[1:], a, mm[moves], nominal)
    new_line = np.diff(pieces["line"], prepend=-1) != 0
    seconds = np.where(new_line, np.maximum(seconds, 1 / limits.line_rate), seconds)
    own = int(np.searchsorted(moves, len(block)))
    return seconds[: len(block)], float(leave[own])


def _speeds(
    d: Floats, mm: Floats, feed: Floats, rests: NDArray[np.int64], limits: Limits
) -> tuple[Floats, Floats, Floats]:
    """Squared entry speeds as far as what follows allows, acceleration, nominal speed."""
    unit = d / mm[:, None]
    with np.errstate(divide="ignore"):
        a = np.min(np.array(limits.acceleration) / np.abs(unit), axis=1)
        top = np.min(np.array(limits.max_rate) / np.abs(unit), axis=1) / 60
    nominal = np.minimum(np.where(feed > 0, feed / 60, top), top)
    bend = np.zeros(len(mm))
    cosine = -(unit[1:] * unit[:-1]).sum(axis=1)
    half = np.sqrt(np.clip(0.5 * (1 - cosine), 0, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        corner = a[1:] * limits.junction * half / (1 - half)
    bend[1:] = np.where(cosine > _STRAIGHT, 0, np.where(cosine < -_STRAIGHT, np.inf, corner))
    bend[1:][np.diff(rests) > 0] = 0
    limit = np.minimum(bend, nominal**2)
    limit[1:] = np.minimum(limit[1:], nominal[:-1] ** 2)
    way = np.append(0.0, np.cumsum(mm))
    seen = np.minimum(np.arange(len(mm)) + limits.blocks - 1, len(mm))
    limit = np.minimum(limit, 2 * a * (way[seen] - way[:-1]))
    reach, out, room = 0.0, limit.tolist(), (2 * a * mm).tolist()
    for i in range(len(out) - 1, -1, -1):
        reach = min(out[i], reach + room[i])
        out[i] = reach
    return np.array(out), a, nominal


def _forward(entry: Floats, a: Floats, mm: Floats, speed2: float) -> Floats:
    """Squared entry speeds as far as what lies behind allows too."""
    out, room = entry.tolist(), (2 * a * mm).tolist()
    reach = 0.0
    for i in range(len(out)):
        out[i] = reach = min(out[i], reach) if i else speed2
        reach += room[i]
    return np.array(out)


def _trapezoid(v0: Floats, v1: Floats, a: Floats, mm: Floats, nominal: Floats) -> Floats:
    """Seconds over `mm` between squared speeds, accelerating, cruising and braking."""
    peak = np.minimum(nominal, np.sqrt((v0 + v1 + 2 * a * mm) / 2))
    peak = np.maximum(peak, math.sqrt(1e-9))
    ramps = np.maximum(2 * peak - np.sqrt(v0) - np.sqrt(v1), 0) / a
    cruise = np.maximum(mm - np.maximum(2 * peak**2 - v0 - v1, 0) / (2 * a), 0) / peak
    return ramps + cruise
