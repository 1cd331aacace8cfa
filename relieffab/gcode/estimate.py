"""How long a program takes on a machine that accelerates, looks ahead and reads slowly."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.gcode.program import Program
from relieffab.machine import Machine

Floats = NDArray[np.float64]


def estimate(program: Program, machine: Machine) -> float:
    """Foretell the running time of a program, dwells included.

    Returns
    -------
    float
        Seconds.  Pauses for the operator (M0) take no time here.
    """
    return motion_seconds(
        program.points,
        program.feed,
        machine,
        reading=reading_seconds(program, machine),
        dwell=program.dwell,
    )


def move_ends(program: Program, machine: Machine) -> Floats:
    """Foretell when each move of a program ends: (n,), seconds."""
    reading = reading_seconds(program, machine)
    return motion_ends(program.points, program.feed, machine, reading=reading, dwell=program.dwell)


@dataclass(frozen=True)
class Pace:
    """How a program runs on a machine.

    Parameters
    ----------
    seconds : float
        It takes, dwells included.
    unhindered : float
        It would take if lines came at once and the controller saw all moves ahead.
    """

    seconds: float
    unhindered: float

    @property
    def starved(self) -> float:
        """Share of the time lost to waiting for lines, and to braking for want of them."""
        return 1 - self.unhindered / self.seconds if self.seconds else 0.0


def pace(program: Program, machine: Machine) -> Pace:
    """Foretell a program's time, and how much of it the short look-ahead and slow lines cost."""
    free = replace(machine, planner_blocks=len(program.points) + 2, line_rate=1e9, baud=1e12)
    return Pace(estimate(program, machine), estimate(program, free))


def reading_seconds(program: Program, machine: Machine) -> Floats:
    """Give the time that each move's line takes to come and be read.

    Both go on at once, so that the slower counts; chords of one arc share a line.
    """
    new_line = np.diff(program.line, prepend=-1) != 0
    slower: Floats = np.maximum(1 / machine.line_rate, program.sent * (10 / machine.baud))
    return np.where(new_line, slower, 0.0)


def motion_seconds(
    points: Floats,
    feed: Floats,
    machine: Machine,
    *,
    reading: Floats | None = None,
    dwell: Floats | None = None,
) -> float:
    """Foretell how long a motion takes, planned as Grbl 1.1 plans it.

    Speeds at corners come from the junction deviation, speeds along the way
    from trapezoids under each axis's acceleration and top rate.  The planner
    sees `planner_blocks` moves and must be able to stop at the end of the last
    one, and a move cannot start before its line has been read.

    Parameters
    ----------
    points : (n, 3) ndarray
        mm.  The way to the first of them is unknown and takes no time here.
    feed : (n,) ndarray
        Of the move to each point, mm/min; infinite for a rapid.
    machine : Machine
    reading : (n,) ndarray, optional
        Seconds it takes until each move has been read; else as the line rate has it.
    dwell : (n + 1,) ndarray, optional
        Seconds waited before each move and after the last; the machine stands
        still meanwhile.

    Returns
    -------
    float
        Seconds.
    """
    wait = np.zeros(len(points) + 1) if dwell is None else dwell
    ends = motion_ends(points, feed, machine, reading=reading, dwell=wait)
    return float(ends[-1] + wait[-1])


def motion_ends(
    points: Floats,
    feed: Floats,
    machine: Machine,
    *,
    reading: Floats | None = None,
    dwell: Floats,
) -> Floats:
    """Foretell when each move of a motion ends, as `motion_seconds` foretells the end of all.

    Returns
    -------
    (n,) ndarray
        Seconds; what is waited before a move is part of its time.
    """
    waited = np.cumsum(dwell[:-1])
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    moves = 1 + np.flatnonzero(lengths)
    if not len(moves):
        return waited
    length = lengths[moves - 1]
    unit = (points[moves] - points[moves - 1]) / length[:, None]
    speed = np.minimum(feed[moves], _along(unit, machine.max_rate)) / 60
    acceleration = _along(unit, machine.acceleration)
    entry2 = _junctions(unit, speed, machine)
    entry2[np.diff(waited[moves], prepend=0.0) > 0] = 0.0
    blocks = machine.planner_blocks
    entry2 = np.minimum(entry2, _stopping(2 * acceleration * length, blocks))
    parse = np.full(len(moves), 1 / machine.line_rate) if reading is None else reading[moves]
    ends = np.concatenate([[0.0], run_ends(length, speed, acceleration, entry2, parse, blocks)])
    done = np.zeros(len(points), np.int64)
    done[moves] = 1
    return waited + ends[np.cumsum(done)]


def _along(unit: Floats, per_axis: tuple[float, float, float]) -> Floats:
    """Cap a vector by the first of its axes to reach its own limit."""
    with np.errstate(divide="ignore"):
        caps: Floats = (np.asarray(per_axis) / np.abs(unit)).min(axis=1)
    return caps


def _junctions(unit: Floats, speed: Floats, machine: Machine) -> Floats:
    """Square of the highest speed into each move, (mm/s)²; 0 for the first.

    The cornering circle that strays `junction_deviation` from the corner:
    v² = a d sin(t/2) / (1 - sin(t/2)), t the angle between the moves (Grbl
    1.1, planner.c; S. K. Jeon, "Improving Grbl: Cornering Algorithm", 2011).
    """
    entry2 = np.zeros(len(unit))
    turn = unit[1:] - unit[:-1]
    size = np.linalg.norm(turn, axis=1)
    cos = -np.einsum("ij,ij->i", unit[1:], unit[:-1])
    straight, back = cos < -0.999999, cos > 0.999999
    sin_half = np.sqrt(0.5 * (1 - np.clip(cos, -0.999999, 0.999999)))
    acceleration = _along(turn / np.maximum(size, 1e-12)[:, None], machine.acceleration)
    acceleration[straight | back] = 0.0
    corner2 = acceleration * machine.junction_deviation * sin_half / (1 - sin_half)
    corner2[straight] = np.inf
    entry2[1:] = np.minimum(corner2, np.minimum(speed[1:], speed[:-1]) ** 2)
    return entry2


def _stopping(doubled: Floats, blocks: int) -> Floats:
    """Square of the speed from which the moves looked ahead at can stop, (mm/s)².

    Parameters
    ----------
    doubled : (n,) ndarray
        Twice acceleration times length of each move, (mm/s)².
    blocks : int
        Moves in the planner's buffer; one of them is being made.
    """
    total = np.concatenate([[0.0], np.cumsum(doubled)])
    end = np.minimum(np.arange(len(doubled)) + max(blocks - 1, 1), len(doubled))
    return total[end] - total[:-1]


@kernel
def run_ends(
    length: Floats, speed: Floats, acceleration: Floats, entry2: Floats, parse: Floats, blocks: int
) -> Floats:
    """Plan backwards, then run forwards through trapezoids; when each move ends, seconds.

    Parameters
    ----------
    length, speed, acceleration : (n,) ndarray
        mm, mm/s and mm/s² of each move.
    entry2 : (n,) ndarray
        Square of the highest speed into each move, (mm/s)².
    parse : (n,) ndarray
        Seconds the controller takes to read each move.
    blocks : int
        Moves the controller can hold.
    """
    n = len(length)
    into = entry2.copy()
    after = 0.0
    for k in range(n - 1, -1, -1):
        into[k] = min(into[k], after + 2 * acceleration[k] * length[k])
        after = into[k]
    finish = np.zeros(n)
    read = 0.0
    for k in range(n):
        a, v2 = acceleration[k], speed[k] ** 2
        v_in2 = into[k]
        v_out2 = into[k + 1] if k + 1 < n else 0.0
        reachable = v_in2 + 2 * a * length[k]
        if v_out2 > reachable:
            v_out2 = reachable
            into[k + 1] = reachable
        peak2 = min(v2, 0.5 * (v_in2 + v_out2) + a * length[k])
        v_in, v_out, peak = np.sqrt(v_in2), np.sqrt(v_out2), np.sqrt(peak2)
        cruise = length[k] - (2 * peak2 - v_in2 - v_out2) / (2 * a)
        took = (2 * peak - v_in - v_out) / a + max(cruise, 0.0) / peak
        # The controller reads on while it has room, and moves once it has read.
        if k >= blocks:
            read = max(read, finish[k - blocks])
        read += parse[k]
        start = max(read, finish[k - 1]) if k else read
        finish[k] = start + took
    return finish
