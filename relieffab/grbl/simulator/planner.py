"""Look-ahead over the moves that wait, and the one that runs.

Junction speeds follow from the junction deviation: the speed at which an arc that leaves
the corner by that much can be driven within the acceleration.  A reverse pass limits every
entry speed by what can be braked afterwards, a forward pass by what can be reached; the
moves before the last one whose entry speed is the best possible are not looked at again
(Grbl's wiki and planner documentation).
"""

import math
from collections.abc import Sequence

from relieffab.grbl.simulator.profile import Profile
from relieffab.grbl.simulator.settings import Settings

Point = tuple[float, ...]
"""X, Y, Z, mm, and A, degrees, where there is one: a degree plans as a mm."""

SLOWEST = 1.0 / 60.0
"""mm/s: Grbl moves at 1 mm/min at least."""
STRAIGHT = 0.999999
"""Cosine beyond which a corner counts as straight or as a reversal."""


class Block:
    """One straight move: speeds in mm/s, `entry` and its limits as squares."""

    __slots__ = (
        "acceleration", "corner", "entry", "fastest", "feed", "limit",
        "mm", "nominal", "rapid", "target", "unit",
    )  # fmt: skip

    def __init__(self, target: Point, unit: Point, mm: float, feed: float) -> None:
        self.target, self.unit, self.mm = target, unit, mm
        self.feed, self.rapid = feed, feed == math.inf
        self.acceleration = self.fastest = self.nominal = 0.0
        self.entry = self.corner = self.limit = 0.0


class Planner:
    """The queue of moves, at most `size`, and the motion of the first.

    Attributes
    ----------
    position : tuple of float
        Where the axes were at the last end of a move or stop, machine mm.
    running, holding : bool
        Whether a move runs, and whether a hold is asked for; both: the axes brake.
    end : float
        When the running move ends or has come to a hold; inf where none runs.
    """

    def __init__(self, settings: Settings, size: int) -> None:
        self.settings = settings
        self.size = size
        self.blocks: list[Block] = []
        self.position: Point = (0.0,) * settings.axes
        self.end = math.inf
        self.running = False
        self.holding = False
        self._feed_factor = 1.0
        self._rapid_factor = 1.0
        self._last_steps = (0,) * settings.axes
        self._last_unit: Point = self.position
        self._last_nominal = 0.0
        self._planned = 0
        self._profile = Profile(0.0, 0.0, 0.0, 1.0, 1.0)
        self._began = 0.0
        self._stops = False

    @property
    def full(self) -> bool:
        """True where no move can be added."""
        return len(self.blocks) >= self.size

    def set_position(self, position: Point) -> None:
        """Declare where the axes are, and forget all moves."""
        self.blocks.clear()
        self.end, self.running, self.holding, self._planned = math.inf, False, False, 0
        self._last_steps = self._round(position)
        self.position = self._point(self._last_steps)

    def add(self, target: Point, feed: float, now: float) -> bool:
        """Queue a straight move at `feed` mm/s (inf: rapid); False where it has no length."""
        steps = self._round(target)
        way = [
            (step - last) / per_mm
            for step, last, per_mm in zip(steps, self._last_steps, self.settings.steps, strict=True)
        ]
        mm = math.hypot(*way)
        if mm == 0.0:
            return False
        unit = tuple(part / mm for part in way)
        block = Block(self._point(steps), unit, mm, feed)
        block.acceleration = _along(self.settings.acceleration, unit)
        block.fastest = _along(self.settings.max_rate, unit)
        self._nominal(block)
        if self.blocks:
            block.corner = self._corner(unit)
        block.limit = min(block.corner, block.nominal**2, self._last_nominal**2)
        self._last_steps, self._last_unit, self._last_nominal = steps, unit, block.nominal
        self.blocks.append(block)
        self._recalculate(now)
        return True

    def start(self, now: float) -> None:
        """Set off with the first move, unless one runs already."""
        if not self.running and self.blocks and not self.holding:
            self._run(now)

    def finish(self, now: float) -> Point | None:
        """End the running move (at `end`) and begin the next; its target, None on a hold."""
        block, leave = self.blocks[0], self._profile.leave
        rests = self.holding and self._stops
        if rests and self._profile.distance < block.mm:
            self.position = self.motion(now)[0]
            self._sync(now)
            self.running, self.end = False, math.inf
            return None
        self.position = block.target
        del self.blocks[0]
        self._planned = max(self._planned - 1, 0)
        self.running, self.end = False, math.inf
        if self.blocks and not rests:
            self.blocks[0].entry = leave * leave
            self._run(now)
        return block.target

    def hold(self, now: float) -> None:
        """Begin to brake; `running` turns False once the axes rest."""
        self.holding = True
        if self.running:
            self._sync(now)
            self._run(now)

    def resume(self, now: float) -> None:
        """Go on after a hold has come to rest."""
        self.holding = False
        if self.blocks:
            self.blocks[0].entry = 0.0
        self._replan(now)
        self.start(now)

    def override(self, feed: float, rapid: float, now: float) -> None:
        """Scale feeds and rapids of all moves, the running one included."""
        self._feed_factor, self._rapid_factor = feed, rapid
        last = math.inf
        for block in self.blocks:
            self._nominal(block)
            block.limit = min(block.corner, block.nominal**2, last**2)
            last = block.nominal
        self._last_nominal = last if self.blocks else self._last_nominal
        self._replan(now)

    def motion(self, now: float) -> tuple[Point, float]:
        """Position (machine mm) and speed (mm/s) at this instant."""
        if not self.blocks:
            return self.position, 0.0
        block, left, speed = self.blocks[0], self.blocks[0].mm, 0.0
        if self.running:
            covered, speed = self._profile.at(now - self._began)
            left -= covered
        place = tuple(p - u * left for p, u in zip(block.target, block.unit, strict=True))
        return place, speed

    def _nominal(self, block: Block) -> None:
        wanted = (
            block.fastest * self._rapid_factor if block.rapid else block.feed * self._feed_factor
        )
        block.nominal = max(min(wanted, block.fastest), SLOWEST)

    def _corner(self, unit: Point) -> float:
        """Square of the speed at which the corner from the last move may be taken."""
        last = self._last_unit
        cosine = -sum(a * b for a, b in zip(last, unit, strict=True))
        if cosine > STRAIGHT:
            return 0.0
        if cosine < -STRAIGHT:
            return math.inf
        turn = [b - a for a, b in zip(last, unit, strict=True)]
        norm = math.hypot(*turn)
        acceleration = _along(self.settings.acceleration, [part / norm for part in turn])
        half_sine = math.sqrt(0.5 * (1.0 - cosine))
        return acceleration * self.settings.junction_deviation * half_sine / (1.0 - half_sine)

    def _recalculate(self, now: float) -> None:
        """Reverse and forward pass over the moves whose entry speed may still rise."""
        blocks, planned = self.blocks, self._planned
        last = len(blocks) - 1
        if last == planned:
            return
        refresh = planned == 0 and self.running
        if refresh:
            self._sync(now)
        following = blocks[last]
        following.entry = min(following.limit, 2 * following.acceleration * following.mm)
        reach = following.entry
        for block in blocks[last - 1 : planned : -1]:
            limit = block.limit
            if block.entry != limit:
                reach += 2 * block.acceleration * block.mm
                block.entry = reach = reach if reach < limit else limit
            else:
                reach = limit
        self._forward(planned, last)
        if refresh:
            self._run(now)

    def _forward(self, planned: int, last: int) -> None:
        block = self.blocks[planned]
        for index in range(planned + 1, last + 1):
            following = self.blocks[index]
            entry = following.entry
            if block.entry < entry:
                reach = block.entry + 2 * block.acceleration * block.mm
                if reach < entry:
                    following.entry = entry = reach
                    self._planned = index
            if entry == following.limit:
                self._planned = index
            block = following

    def _replan(self, now: float) -> None:
        self._planned = 0
        if len(self.blocks) > 1:
            self._recalculate(now)
        elif self.running:
            self._sync(now)
            self._run(now)

    def _sync(self, now: float) -> None:
        """Turn the running move into what is left of it, at the speed it has."""
        block = self.blocks[0]
        covered, speed = self._profile.at(now - self._began)
        block.mm = max(block.mm - covered, 0.0)
        block.entry = speed * speed

    def _run(self, now: float) -> None:
        """Give the first move its profile from here on."""
        block = self.blocks[0]
        entry = math.sqrt(block.entry)
        if self.holding:
            stop = block.entry / (2.0 * block.acceleration)
            self._stops = stop <= block.mm
            self._profile = Profile(min(stop, block.mm), entry, 0.0, entry, block.acceleration)
        else:
            leave = math.sqrt(self.blocks[1].entry) if len(self.blocks) > 1 else 0.0
            self._profile = Profile(block.mm, entry, leave, block.nominal, block.acceleration)
        self.running, self._began = True, now
        self.end = now + self._profile.seconds

    def _round(self, point: Point) -> tuple[int, ...]:
        return tuple(round(p * steps) for p, steps in zip(point, self.settings.steps, strict=True))

    def _point(self, steps: tuple[int, ...]) -> Point:
        return tuple(n / per_mm for n, per_mm in zip(steps, self.settings.steps, strict=True))


def _along(limits: Point, unit: Sequence[float]) -> float:
    """Largest value along `unit` that exceeds no axis limit."""
    return min(abs(limit / part) for limit, part in zip(limits, unit, strict=True) if part)
