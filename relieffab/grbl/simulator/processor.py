"""The main program of the controller: one line after the other, each as long as it takes."""

import re
from collections import deque
from typing import Protocol

from relieffab.grbl.simulator.commands import EEPROM_SECONDS, run_command
from relieffab.grbl.simulator.commands import Host as CommandHost
from relieffab.grbl.simulator.interpreter import Action, Move, Probe, Wait
from relieffab.grbl.simulator.probing import Prober
from relieffab.grbl.simulator.words import Refused

LINE_LENGTH = 79
_COMMENT = re.compile(r"\([^)]*\)?|;.*")


class Host(CommandHost, Protocol):
    """What the main program asks of the machine."""

    now: float
    spindle: float
    prober: Prober

    def start(self) -> None:
        """Set off with the moves that wait."""

    def outside(self, move: Move) -> bool:
        """Whether a soft limit forbids a move."""

    def limit_reached(self) -> None:
        """Stop for a soft limit."""

    def homed(self) -> None:
        """End a homing cycle."""

    def offset_changed(self) -> None:
        """Have the next status report name the offset."""


class Processor:
    """Reads, interprets and acknowledges lines.

    Parameters
    ----------
    machine : Host
    line_seconds : float
        Time to read and interpret one line.

    Attributes
    ----------
    ready : float
        When the processor can go on; it does nothing before.
    paused : bool
        True between M0 and cycle start.
    """

    def __init__(self, machine: Host, line_seconds: float) -> None:
        self._machine = machine
        self._line_seconds = line_seconds
        self.clear()

    def clear(self) -> None:
        """Forget the line at hand and what it still wants done."""
        self.ready = 0.0
        self.paused = False
        self._actions: deque[Action] = deque()
        self._line: bytes | None = None
        self._interpreted = False

    @property
    def wants_a_line(self) -> bool:
        """True where nothing is at hand."""
        return self._line is None and not self._actions

    def load(self, actions: list[Action]) -> None:
        """Take on the actions of a startup block."""
        self._actions.extend(actions)

    def work(self) -> None:
        """Go on as far as possible at this instant."""
        machine = self._machine
        while self.ready <= machine.now:
            if self._actions:
                if not self._act(self._actions[0]):
                    return
            elif self._line is not None:
                self._go_on()
            elif not self._next_line():
                return

    def _next_line(self) -> bool:
        self._line = self._machine.wire.read_line()
        if self._line is None:
            self._machine.start()
            return False
        self._interpreted = False
        self.ready = self._machine.now + self._line_seconds
        return True

    def _go_on(self) -> None:
        """Interpret the line once its time has passed; acknowledge it once it is done."""
        if self._interpreted:
            self._line = None
            if self._machine.state == "Home":
                self._machine.homed()
            self._machine.say("ok")
            return
        self._interpreted = True
        try:
            self._interpret(self._line or b"")
        except Refused as refused:
            self._line = None
            self._machine.say(f"error:{refused.code}")

    def _interpret(self, raw: bytes) -> None:
        text = raw.decode("latin-1")
        if "(" in text or ";" in text:
            text = _COMMENT.sub("", text)
        line = "".join(text.split()).upper().replace("/", "")
        if len(line) > LINE_LENGTH:
            raise Refused(11)
        if line.startswith("$"):
            run_command(self._machine, line)
        elif line:
            if self._machine.state == "Alarm":
                raise Refused(9)
            self._actions.extend(self._machine.interpreter.run(line))

    def _act(self, action: Action) -> bool:
        """Carry out one action; False where it has to wait."""
        machine = self._machine
        if machine.state == "Check":
            self._actions.popleft()
            return True
        if isinstance(action, Move):
            return self._move(action)
        if machine.planner.blocks:
            machine.start()
            return False
        if isinstance(action, Probe):
            over = machine.prober.probe(action)
            if over:
                self._actions.popleft()
            return over
        if action.kind == "pause":
            return self._pause()
        self._actions.popleft()
        self._settle(action)
        return True

    def _pause(self) -> bool:
        """Hold at M0; the machine calls again only once it was resumed."""
        self.paused = not self.paused
        if self.paused:
            self._machine.state = "Hold"
            return False
        self._actions.popleft()
        return True

    def _move(self, move: Move) -> bool:
        machine = self._machine
        if machine.outside(move):
            machine.limit_reached()
            return False
        if machine.planner.full:
            machine.start()
            return False
        self._actions.popleft()
        machine.planner.add(move.target, move.feed, machine.now)
        return True

    def _settle(self, action: Wait) -> None:
        """Do what had to wait for the axes to rest."""
        machine = self._machine
        if action.kind == "dwell":
            self.ready = machine.now + action.value
        elif action.kind == "eeprom":
            machine.deafen(EEPROM_SECONDS)
            machine.offset_changed()
        elif action.kind == "spindle":
            machine.spindle = action.value
        elif action.kind == "end":
            machine.spindle = 0.0
            machine.say("[MSG:Pgm End]")
