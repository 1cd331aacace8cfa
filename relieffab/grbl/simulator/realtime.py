"""The bytes that act wherever they arrive, in a comment or in the middle of a line."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from relieffab.grbl.simulator.planner import Planner
from relieffab.grbl.simulator.suspend import Suspension

FEED = {0x90: None, 0x91: 10, 0x92: -10, 0x93: 1, 0x94: -1}
RAPID = {0x95: 100, 0x96: 50, 0x97: 25}
SPEED = {0x99: None, 0x9A: 10, 0x9B: -10, 0x9C: 1, 0x9D: -1}
LEAST, MOST = 10, 200


@dataclass
class Overrides:
    """Feed, rapid and spindle speed in percent of what the program says."""

    feed: int = 100
    rapid: int = 100
    speed: int = 100

    @property
    def values(self) -> tuple[int, int, int]:
        """In the order of the status report."""
        return self.feed, self.rapid, self.speed


class Host(Protocol):
    """What the bytes ask of the machine."""

    planner: Planner
    overrides: Overrides
    now: float
    suspension: Suspension

    def report(self) -> None:
        """Answer `?`."""

    def reset(self) -> None:
        """Start anew."""

    def toggle_coolant(self) -> None:
        """Switch the flood coolant."""


def act(machine: Host, byte: int) -> None:
    """Do what `byte` commands; those not defined are dropped."""
    if byte == 0x18:
        machine.reset()
    elif byte == ord("?"):
        machine.report()
    elif byte == ord("!"):
        machine.suspension.hold()
    elif byte == ord("~"):
        machine.suspension.resume()
    elif byte == 0x84:
        machine.suspension.hold("Door")
    elif byte in _TOGGLES:
        _TOGGLES[byte](machine)
    else:
        _override(machine, byte)


_TOGGLES: dict[int, Callable[[Host], None]] = {
    0x85: lambda machine: machine.suspension.cancel_jog(),
    0x9E: lambda machine: machine.suspension.toggle_spindle(),
    0xA0: lambda machine: machine.toggle_coolant(),
}


def _override(machine: Host, byte: int) -> None:
    current = machine.overrides
    if byte in FEED:
        current.feed = _stepped(current.feed, FEED[byte])
    elif byte in RAPID:
        current.rapid = RAPID[byte]
    elif byte in SPEED:
        current.speed = _stepped(current.speed, SPEED[byte])
        return
    else:
        return
    machine.planner.override(current.feed / 100.0, current.rapid / 100.0, machine.now)


def _stepped(value: int, change: int | None) -> int:
    return 100 if change is None else min(max(value + change, LEAST), MOST)
