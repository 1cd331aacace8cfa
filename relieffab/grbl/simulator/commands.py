"""The $ commands of the simulated Grbl."""

import re
from collections.abc import Callable
from typing import Protocol

from relieffab.grbl.simulator import reports
from relieffab.grbl.simulator.interpreter import Interpreter, Move
from relieffab.grbl.simulator.planner import Planner
from relieffab.grbl.simulator.settings import Settings
from relieffab.grbl.simulator.wire import Wire
from relieffab.grbl.simulator.words import Refused, read_words

EEPROM_SECONDS = 0.1
"""How long a stored setting keeps the controller deaf: some 30 bytes of 3.4 ms."""

HOMING_SECONDS = 8.0

_SETTING = re.compile(r"\$(\d+)=(-?[\d.]+)")
_STARTUP = re.compile(r"\$N([01])=(.*)")


class Host(Protocol):
    """What the commands ask of the machine."""

    now: float
    settings: Settings
    interpreter: Interpreter
    planner: Planner
    wire: Wire
    state: str
    spindle: float
    startup: list[str]
    probed: reports.Probed

    def say(self, text: str) -> None:
        """Print a line."""

    def at(self, time: float, happen: Callable[[], None]) -> None:
        """Have something happen at a time."""

    def outside(self, move: Move) -> bool:
        """Whether a soft limit forbids a move."""

    def deafen(self, seconds: float) -> None:
        """Lose bytes while the EEPROM is written."""

    def occupy(self, seconds: float) -> None:
        """Keep the main program from its lines."""

    def reset(self) -> None:
        """Do as Ctrl-X does."""

    def restart(self) -> None:
        """Start anew, with the position that is known."""


def run_command(machine: Host, line: str) -> None:
    """Run a `$` line, or refuse it."""
    if line in _ALWAYS:
        _ALWAYS[line](machine)
        return
    if machine.state == "Check" and line == "$C":
        _leave_check(machine)
        return
    if line.startswith("$J="):
        if machine.state not in ("Idle", "Jog"):
            raise Refused(8)
        _jog(machine, line[3:])
        return
    if machine.state not in ("Idle", "Alarm"):
        raise Refused(8)
    if line in _AT_REST:
        _AT_REST[line](machine)
    elif setting := _SETTING.fullmatch(line):
        machine.settings.change(int(setting[1]), float(setting[2]))
        machine.deafen(EEPROM_SECONDS)
    elif line in ("$RST=$", "$RST=#", "$RST=*"):
        _restore(machine, line[-1])
    elif (block := _STARTUP.fullmatch(line)) and machine.state == "Idle":
        read_words(block[2])
        machine.startup[int(block[1])] = block[2]
        machine.deafen(EEPROM_SECONDS)
    else:
        raise Refused(3)


def _help(machine: Host) -> None:
    machine.say(reports.HELP)


def _modal(machine: Host) -> None:
    machine.say(reports.modal(machine.interpreter))


def _unlock(machine: Host) -> None:
    if machine.state == "Alarm":
        machine.say("[MSG:Caution: Unlocked]")
        machine.state = "Idle"


def _settings(machine: Host) -> None:
    for line in machine.settings.lines():
        machine.say(line)


def _offsets(machine: Host) -> None:
    inches = bool(machine.settings[13])
    for line in reports.offsets(machine.interpreter, machine.probed, inches=inches):
        machine.say(line)


def _info(machine: Host) -> None:
    for line in reports.build_info(machine.wire, machine.planner.size, machine.settings.axes):
        machine.say(line)


def _startup(machine: Host) -> None:
    for number, block in enumerate(machine.startup):
        machine.say(f"$N{number}={block}")


def _home(machine: Host) -> None:
    if not machine.settings[22]:
        raise Refused(5)
    machine.state = "Home"  # it always finds its switches
    machine.occupy(HOMING_SECONDS)


def _check(machine: Host) -> None:
    if machine.state != "Idle":
        raise Refused(8)
    machine.say("[MSG:Enabled]")
    machine.state = "Check"


def _leave_check(machine: Host) -> None:
    machine.say("[MSG:Disabled]")
    machine.state = "Idle"
    machine.restart()


def _jog(machine: Host, line: str) -> None:
    move = machine.interpreter.jog(line)
    if machine.outside(move):
        raise Refused(15)
    machine.interpreter.coordinates.position = list(move.target)
    machine.planner.add(move.target, move.feed, machine.now)
    machine.state = "Jog"
    machine.planner.start(machine.now)


def _sleep(machine: Host) -> None:
    machine.say("[MSG:Sleeping]")
    machine.state, machine.spindle = "Sleep", 0.0


def _restore(machine: Host, what: str) -> None:
    """Forget what is stored: $ settings, # offsets, * all."""
    machine.say("[MSG:Restoring defaults]")
    if what in "$*":
        machine.settings.restore()
    if what in "#*":
        machine.interpreter.coordinates.forget()
    machine.deafen(EEPROM_SECONDS)
    machine.at(machine.now + EEPROM_SECONDS, machine.reset)


_ALWAYS = {"$": _help, "$G": _modal, "$X": _unlock}
_AT_REST = {
    "$$": _settings,
    "$#": _offsets,
    "$I": _info,
    "$N": _startup,
    "$H": _home,
    "$C": _check,
    "$SLP": _sleep,
}
