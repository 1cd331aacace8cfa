"""Where on the program the machine is: its reported position among the last lines sent.

Character counting tells what was read; the moves that wait in the planner tell what was cut.
A position also tells what no acknowledgement can: that a byte was altered on the line, and
the machine goes where the program does not.
"""

import math
from collections import deque
from typing import NamedTuple

from relieffab.grbl.messages import Point, Status
from relieffab.grbl.program import Line
from relieffab.grbl.way import Motion, Place

TOLERANCE = 0.04
"""mm off the program's way that the chords of arcs and rounded reports explain."""
STEPS = 2
"""Steps of an axis that the machine may be off besides."""
SAME = 0.002
"""mm by which a later line must be nearer to be preferred."""
MOST = 2000
"""Lines kept at most, however many of them hardly move."""
DOUBTED = 4
"""Sightings that are not believed any more once the machine was seen astray."""
SEGMENTS = 10
"""Short moves that the stepper still makes after the planner has let them go."""


class _Stretch(NamedTuple):
    line: Line
    motion: Motion
    before: float


class Course:
    """The last lines sent, as far back as the machine can be.

    Parameters
    ----------
    blocks : int
        Moves the planner holds.
    offset : tuple of float
        Work zero in machine coordinates, mm, A in degrees; status reports update it.
    resolution : float
        Longest step of an axis, mm or degrees.

    Attributes
    ----------
    cut_mm : float
        Length certainly cut, from the first line of the program, mm.
    reached : Line or None
        The line at which the machine was last seen.
    off_mm : float
        Distance of the last report from the program's way; 0 where nothing can be said.
    known : bool
        False where the program moves work zero.
    """

    def __init__(self, blocks: int, offset: Point, resolution: float = 0.0) -> None:
        self._tolerance = TOLERANCE + STEPS * resolution
        self.cut_mm = self.off_mm = 0.0
        self.reached: Line | None = None
        self.known = True
        self._depth = blocks + SEGMENTS
        self._offset = self._heard = offset
        self._stretches: deque[_Stretch] = deque()
        self._acknowledged = self._blocks = 0
        self._step = 2 * resolution
        self._cut = 0.0
        self._seen = False
        self._skipped: Line | None = None
        self._earlier: deque[Line | None] = deque(maxlen=DOUBTED)

    @property
    def astray(self) -> bool:
        """True where the last report was off the program's way."""
        return self.off_mm > self._tolerance

    def begin(self, cut_mm: float) -> None:
        """Start behind so much of the program."""
        self.cut_mm = self._cut = cut_mm

    def sent(self, line: Line, motion: Motion | None) -> None:
        """Take in a line that goes out; `reached` starts at the first."""
        if self.reached is None:
            self.reached = line
        if motion is None:
            return
        self._stretches.append(_Stretch(line, motion, self._cut))
        if motion.cutting:
            self._cut += motion.length

    def acknowledged(self, line: Line) -> None:
        """Forget what the machine must have left behind by now."""
        stretches = self._stretches
        while (
            self._acknowledged < len(stretches)
            and stretches[self._acknowledged].line.index <= line.index
        ):
            self._blocks += self._takes_room(stretches[self._acknowledged])
            self._acknowledged += 1
        while self._blocks > self._depth or self._acknowledged > MOST:
            passed = stretches.popleft()
            self._blocks -= self._takes_room(passed)
            self._acknowledged -= 1
            self._pass(passed)

    def refused(self, line: Line) -> None:
        """Look no further than a line that the machine skipped: it is still to be cut."""
        self._skipped = line
        if self.reached is not None and self.reached.index > line.index:
            self.reached = line

    def _takes_room(self, stretch: _Stretch) -> bool:
        """Say whether a line surely became a move: Grbl drops those of less than a step."""
        return stretch.motion.length > self._step

    def finish(self, line: Line) -> None:
        """All is done: the machine is idle and owes nothing."""
        self.cut_mm = max(self.cut_mm, self._cut)
        self.reached = line

    def work_position(self, status: Status) -> Point | None:
        """Give the reported position in work coordinates, mm."""
        if status.offset is not None:  # believed once it was heard twice
            if status.offset == self._heard:
                self._offset = status.offset
            self._heard = status.offset
        if status.work is not None:
            return status.work
        return moved(status.machine, self._offset, -1)

    def machine_position(self, status: Status) -> Point | None:
        """Give the reported position in machine coordinates, mm."""
        if status.machine is not None or status.work is None:
            return status.machine
        return moved(status.work, self._offset, 1)

    def report(self, status: Status) -> None:
        """Find the machine on the program.

        A way that is not known explains every place that those before it do not.
        """
        point = self.work_position(status)
        self.off_mm = 0.0
        if point is None or not self.known:
            return
        best, found, covered = math.inf, None, 0.0
        for stretch in self._stretches:
            if not stretch.motion.known and best <= self._tolerance:
                continue
            near, along = _nearest(stretch.motion, point)
            if near < best - SAME:
                best, found, covered = near, stretch, along
        if found is None:
            return
        self.off_mm = best
        if best <= self._tolerance:
            self._seen = True
            self._earlier.append(self.reached)
            self._see(found, covered)
        elif self._earlier:  # astray, it may have crossed lines that are still to come
            self.reached = self._earlier[0]

    def _see(self, stretch: _Stretch, covered: float) -> None:
        line, cutting = stretch.line, stretch.motion.cutting
        if self._skipped is not None and line.index > self._skipped.index:
            self.reached = self._skipped
            return
        if self.reached is None or line.index > self.reached.index:
            self.reached = line
        self.cut_mm = max(self.cut_mm, stretch.before + (covered if cutting else 0.0))

    def _pass(self, stretch: _Stretch) -> None:
        """Where positions say nothing, go by what the planner can still hold."""
        if self._seen and self.known:
            return
        following = self._stretches[0] if self._stretches else stretch
        self._see(following, 0.0)


def moved(point: Point | None, offset: Point, sign: int) -> Point | None:
    """Add an offset, or take it away; None where the point is, or has other axes."""
    if point is None or len(point) != len(offset):
        return None
    return tuple(value + sign * shift for value, shift in zip(point, offset, strict=True))


def _nearest(motion: Motion, point: Point) -> tuple[float, float]:
    """Distance of a point from a line's way, and the length up to there; 0 where not known."""
    best, along, passed = math.inf, 0.0, 0.0
    start = motion.start
    for end in motion.points:
        gap, share, length = _segment(start, end, point)
        if gap < best:
            best, along = gap, passed + share * length
        passed += length
        start = end
    return best, along


def _segment(a: Place, b: Place, p: Point) -> tuple[float, float, float]:
    """Distance from a straight piece, share of it up to the nearest point, its length."""
    if None in a or None in b:
        return 0.0, 0.0, 0.0
    ab = aa = 0.0
    for u, v, w in zip(a, b, p, strict=True):
        along = (v or 0.0) - (u or 0.0)
        ab += along * (w - (u or 0.0))
        aa += along * along
    share = min(max(ab / aa, 0.0), 1.0) if aa else 0.0
    foot = [(u or 0.0) + share * ((v or 0.0) - (u or 0.0)) for u, v in zip(a, b, strict=True)]
    return math.dist(foot, p), share, math.sqrt(aa)
