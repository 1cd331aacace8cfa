"""Taking a job up again in its middle: what has to be in force, and how to get there."""

import math
from dataclasses import dataclass
from itertools import zip_longest

from relieffab.errors import InputError
from relieffab.grbl.messages import AXES, Point
from relieffab.grbl.modal import Modal
from relieffab.grbl.program import Program, top
from relieffab.grbl.record import Record
from relieffab.grbl.tracker import Tracker
from relieffab.grbl.way import Place

SPIN_UP = 5.0
"""Seconds for the spindle to reach its speed."""
APART = 0.02
"""mm or degrees between a recorded and a reported position that rounding explains."""
CLEARANCE = 1.0
"""mm above Z0 that a program must reach for a way back into it."""


@dataclass(frozen=True)
class Entry:
    """The state of a program in front of one line.

    Parameters
    ----------
    index : int
        Of the line, among those sent.
    number : int
        Of the line, in the source.
    modal : Modal
    position : tuple of (float or None)
        Where the line begins, work coordinates, mm, A in degrees; Y is None where work turns
        under a Y that the program never names.
    height : float
        Z at which the program itself moves across the stock, mm.
    plunge : float
        Its slowest descending feed, mm/min.
    """

    index: int
    number: int
    modal: Modal
    position: Place
    height: float
    plunge: float


def entry(program: Program, *, number: int | None = None, index: int = 0) -> Entry:
    """Follow a program up to a line.

    Parameters
    ----------
    program : Program
    number : int, optional
        Line of the source; the next one that is sent counts.
    index : int
        Used without `number`.

    Raises
    ------
    InputError
        If there is no such line, or the state in front of it cannot be told.
    """
    tracker, last = Tracker(), None
    for line in program.read():
        last = line
        if line.number >= number if number is not None else line.index >= index:
            break
        tracker.follow(line.text)
    else:
        raise InputError(
            "the program has no such line",
            expected=f"at most {last.number if last else 0}",
            found=str(index if number is None else number),
        )
    where = f"line {last.number}"
    if not tracker.followed:
        raise InputError(
            "the state in front of this line cannot be rebuilt",
            found="work zero is moved before it (G10, G43.1, G55-G59, G92...)",
            where=where,
        )
    return Entry(
        last.index, last.number, tracker.modal, _known(tracker.position, program, where),
        _height(program, where), program.plunge,
    )  # fmt: skip


def _known(position: Place, program: Program, where: str) -> Place:
    lows = program.bounds[0]
    # Over work that turns, Y stands still.
    needed = (low is not None or len(lows) < AXES for low in lows)
    if any(need and value is None for value, need in zip_longest(position, needed)):
        raise InputError(
            "no position is named on every axis before this line",
            where=where,
            hint="begin at the first line",
        )
    return position


def _height(program: Program, where: str) -> float:
    height = top(program)
    if height < CLEARANCE:
        raise InputError(
            "the program never goes above the stock, so there is no safe way back into it",
            expected=f"a height of at least {CLEARANCE:g} mm above Z0",
            found=f"{height:g} mm" if math.isfinite(height) else "none",
            where=where,
        )
    return height


def approach(entry: Entry, z: float) -> list[str]:
    """Write the lines that bring a machine from rest to the line of `entry`.

    Up first, never down, then A, then across, then the spindle, which gets time for its speed;
    slowly down from where the program itself moves across; at last what it has in force.

    Parameters
    ----------
    entry : Entry
    z : float
        Where the tool stands, work coordinates, mm; inf where the machine does not say.

    Returns
    -------
    list of str
    """
    modal, (x, y, depth, *turn) = entry.modal, entry.position
    height = max(z, entry.height) if math.isfinite(z) else entry.height
    across = _words("X", x) + _words("Y", y)
    lines = ["G17G21G90G94", f"G0Z{height:.4f}"]
    lines += [f"G0{word}" for word in (*(_words("A", angle) for angle in turn), across) if word]
    if modal.spindle != 5:
        lines += [f"M{modal.spindle}S{modal.speed:g}", f"G4P{SPIN_UP:g}"]
    lines += ["M7"] * modal.mist + ["M8"] * modal.flood
    named = modal.feed * modal.scale if modal.feed_mode == 94 else 0.0
    feed = entry.plunge if math.isfinite(entry.plunge) else named
    if height > entry.height:
        lines.append(f"G0Z{entry.height:.4f}")
    if depth is not None and depth < entry.height:
        lines.append(f"G1Z{depth:.4f}F{_slow(feed):g}")
    return lines + _in_force(modal)


def _words(letter: str, value: float | None) -> str:
    return "" if value is None else f"{letter}{value:.4f}"


def _slow(feed: float) -> float:
    return feed if feed > 0 else 60.0


def _in_force(modal: Modal) -> list[str]:
    """Write the modal words; a motion mode other than G0 and G1 comes with the line itself."""
    words = "".join(f"G{code:g}" for code in (modal.plane, modal.units, modal.distance))
    lines = [words]
    if modal.feed and modal.feed_mode == 94:
        lines.append(f"F{modal.feed:g}")
    if modal.spindle == 5 and modal.speed:
        lines.append(f"S{modal.speed:g}")
    if modal.motion in (0, 1):
        lines.append(f"G{modal.motion:g}")
    # Under G93 a G1 without its own F is an error.
    return [*lines, f"G{modal.feed_mode:g}"]


def zero_lost(
    record: Record | None, position: Point | None, work_zero: Point, *, homed: bool = False
) -> str:
    """Say why work zero cannot be trusted; empty where it can.

    Parameters
    ----------
    record : Record or None
        Of the job that was interrupted.
    position, work_zero : tuple of float
        As the machine reports them now, machine coordinates, mm, A in degrees.
    homed : bool
        The machine finds its own zero again first, so that only work zero has to be the same.
    """
    if record is None:
        return "there is no record of where this job left the machine"
    if _apart(record.work_zero, work_zero):
        return "work zero is not where it was"
    if homed:
        return ""
    if not record.position_kept or record.position is None or position is None:
        return f"the machine lost its position ({record.reason})"
    if _apart(record.position, position):
        return (
            "the machine does not stand where it stopped: it was moved, or restarted and counts "
            "from another place"
        )
    return ""


def _apart(one: Point, other: Point) -> bool:
    return len(one) != len(other) or math.dist(one, other) > APART
