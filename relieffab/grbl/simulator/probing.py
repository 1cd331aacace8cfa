"""Probing moves (G38) towards a touch plate, and away from it."""

import math
from typing import Protocol

from relieffab.grbl.simulator.interpreter import Interpreter, Probe
from relieffab.grbl.simulator.planner import Planner, Point
from relieffab.grbl.simulator.reports import Probed
from relieffab.grbl.simulator.settings import Settings


class Host(Protocol):
    """The machine that probes."""

    now: float
    planner: Planner
    settings: Settings
    interpreter: Interpreter
    probed: Probed

    def say(self, text: str) -> None:
        """Print a line."""

    def start(self) -> None:
        """Set off with the moves that wait."""

    def alarm(self, code: int) -> None:
        """Lock up."""


class Prober:
    """A plate at one height, as wide as the machine.

    Parameters
    ----------
    machine : Host
    plate : float
        Machine Z, mm; -inf where there is none.
    """

    def __init__(self, machine: Host, plate: float) -> None:
        self._machine, self._plate = machine, plate
        self._probing = False

    def clear(self) -> None:
        """Forget a move that was interrupted."""
        self._probing = False

    def probe(self, wanted: Probe) -> bool:
        """Begin a probing move, or go on with it; True once it is over."""
        machine = self._machine
        if self._probing:
            self._end(wanted)
            return True
        start = machine.planner.position
        if (start[2] <= self._plate) is not wanted.away:
            machine.alarm(4)
            return True
        self._probing = True
        machine.planner.add(self._contact(start, wanted.target), wanted.feed, machine.now)
        machine.start()
        return not machine.planner.blocks

    def _contact(self, start: Point, target: Point) -> Point:
        """Where on the way the plate's height is met; the target where it is not."""
        fall = start[2] - target[2]
        share = (start[2] - self._plate) / fall if fall else math.inf
        if not 0.0 <= share <= 1.0:
            return target
        return tuple(a + share * (b - a) for a, b in zip(start, target, strict=True))

    def _end(self, wanted: Probe) -> None:
        machine, self._probing = self._machine, False
        place = machine.planner.position
        machine.interpreter.coordinates.position = list(place)
        if math.dist(place, wanted.target) > 1.0 / min(machine.settings.steps):
            machine.probed = Probed(place, touched=True)
        elif wanted.must:
            machine.alarm(5)
            return
        machine.say(machine.probed.line(inches=bool(machine.settings[13])))
