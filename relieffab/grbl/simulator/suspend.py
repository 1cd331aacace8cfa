"""Holds and the safety door: braking, standing still, and starting again."""

import math
from typing import Protocol

from relieffab.grbl.simulator.interpreter import Interpreter
from relieffab.grbl.simulator.planner import Planner

SPINDLE_DELAY = 4.0
"""Seconds the spindle gets after the safety door was closed."""
SPINDLE_OFF = 5


class Host(Protocol):
    """The machine that is held."""

    now: float
    state: str
    spindle: float
    planner: Planner
    interpreter: Interpreter

    def say(self, text: str) -> None:
        """Print a line."""

    def work(self) -> None:
        """Go on with what waits."""


class Suspension:
    """What `!`, `~`, the door and their kin do.

    Attributes
    ----------
    door_open : bool
        The safety door's switch.
    restored : float
        When the spindle has its speed again after the door; inf where nothing starts.
    """

    def __init__(self, machine: Host) -> None:
        self._machine = machine
        self.door_open = False
        self.restored = math.inf

    def hold(self, state: str = "Hold") -> None:
        """Brake to a stop and stay there until resumed."""
        machine = self._machine
        if state == "Door":
            machine.say("[MSG:Check Door]")
        if machine.state == "Jog":
            self.cancel_jog()
            return
        opened = state == "Door" and machine.state == "Hold"
        if machine.state not in ("Idle", "Run") and not opened:
            return
        machine.state = state
        self.restored = math.inf
        machine.planner.hold(machine.now)
        if state == "Door":
            machine.spindle = 0.0

    def resume(self) -> None:
        """Go on after a hold, a pause or a closed door."""
        machine = self._machine
        held = machine.state in ("Hold", "Door") and not machine.planner.running
        if not held or self.door_open:
            return
        if machine.interpreter.spindle != SPINDLE_OFF and not machine.spindle:
            self.restored = machine.now + SPINDLE_DELAY
        else:
            self.go_on()

    def go_on(self) -> None:
        """Move again, the spindle at its speed."""
        machine = self._machine
        self.restored = math.inf
        if machine.interpreter.spindle != SPINDLE_OFF:
            machine.spindle = machine.interpreter.speed
        machine.planner.resume(machine.now)
        machine.state = "Run" if machine.planner.running else "Idle"
        machine.work()

    def toggle_spindle(self) -> None:
        """Switch the spindle off or on while held."""
        machine = self._machine
        still = machine.state == "Hold" and not machine.planner.running
        if still and machine.interpreter.spindle != SPINDLE_OFF:
            machine.spindle = 0.0 if machine.spindle else machine.interpreter.speed

    def cancel_jog(self) -> None:
        """Brake and forget the jog."""
        if self._machine.state == "Jog":
            self._machine.planner.hold(self._machine.now)

    def name(self) -> str:
        """Give the state as status reports name it."""
        state, running = self._machine.state, self._machine.planner.running
        if state == "Hold":
            return f"Hold:{int(running)}"
        if state != "Door":
            return state
        if self.restored < math.inf:
            return "Door:3"
        return "Door:2" if running else f"Door:{int(self.door_open)}"
