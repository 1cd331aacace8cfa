"""A line of G-code to actions, with the modal state and the errors of Grbl 1.1.

The order of execution is Grbl's (and NIST RS274/NGC's, section 3.8): feed mode, feed,
speed, spindle, coolant, dwell, plane, units, coordinates, distance, motion, program end.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from relieffab.grbl.simulator.arcs import centre_from_radius, check_ends, chords
from relieffab.grbl.simulator.coordinates import Coordinates, Values
from relieffab.grbl.simulator.settings import Settings
from relieffab.grbl.simulator.words import Refused, Words, read_words

Point = tuple[float, ...]

_PLANES = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}
_AXIS_COMMANDS = (10.0, 28.0, 28.1, 30.0, 30.1, 92.0, 92.1)
_START = {1: 0.0, 2: 17.0, 3: 90.0, 5: 94.0, 6: 21.0, 7: 40.0, 8: 49.0, 12: 54.0}
_AFTER_END = {1: 1.0, 2: 17.0, 3: 90.0, 5: 94.0, 7: 40.0, 12: 54.0}
_PROBING = (38.2, 38.3, 38.4, 38.5)
_SPINDLE_OFF, _COOLANT_OFF = 5, 9
_LAST_LINE_NUMBER = 10_000_000


@dataclass(slots=True)
class Move:
    """To `target` (machine mm) at `feed` mm/s; inf is a rapid."""

    target: Point
    feed: float


@dataclass(frozen=True, slots=True)
class Wait:
    """Let all moves end; then `kind`: dwell, eeprom, pause, end, spindle or coolant."""

    kind: str
    value: float = 0.0


@dataclass(frozen=True, slots=True)
class Probe:
    """G38: to `target` at `feed` mm/s, until the probe touches or lets go.

    Parameters
    ----------
    away : bool
        Until it lets go (G38.4, G38.5).
    must : bool
        An alarm if it does not (G38.2, G38.4).
    """

    target: Point
    feed: float
    away: bool
    must: bool


Action = Move | Wait | Probe


class Interpreter:
    """The modal state.

    Attributes
    ----------
    coordinates : Coordinates
        Position and offsets.
    modal : dict
        Modal group -> G number in force.
    feed, speed : float
        mm/min and rpm.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._letters = "XYZA"[: settings.axes]
        self.coordinates = Coordinates(self._letters)
        self.reset()

    def reset(self) -> None:
        """Go back to the state after a start: all that is not in EEPROM is cleared."""
        self.modal = dict(_START)
        self.spindle, self.coolant = _SPINDLE_OFF, _COOLANT_OFF
        self.feed = self.speed = 0.0
        self.tool = 0
        self.coordinates.reset()

    def run(self, line: str) -> list[Action]:
        """Interpret one line without spaces and comments.

        Raises
        ------
        Refused
            Before anything of the line is done.
        """
        words = read_words(line, self._letters)
        values = words.values
        if values.pop("N", 0) > _LAST_LINE_NUMBER:
            raise Refused(27)
        mm = 25.4 if words.g.get(6, self.modal[6]) == 20 else 1.0
        if mm != 1.0:
            values.update({key: values[key] * mm for key in "XYZIJKR" if key in values})
        command = self._axis_command(words)
        feed = self._feed(words, mm, command)
        return self._carry_out(words, command, feed)

    def _axis_command(self, words: Words) -> float | None:
        """Which command uses the axis words: a G number, or None."""
        values, motion, other = words.values, words.g.get(1), words.g.get(0)
        if other not in _AXIS_COMMANDS:
            other = 43.1 if words.g.get(8) == 43.1 else None
        if other is not None:
            if motion not in (None, 80.0):
                raise Refused(24)
            return other
        named = any(letter in values for letter in self._letters)
        if motion is None and not named and (self.modal[1] in (0, 1, 80) or not _target(values)):
            return None
        command = self.modal[1] if motion is None else motion
        if command == 80:
            if named:
                raise Refused(31)
            return None
        if words.g.get(0) == 53.0 and command not in (0, 1):
            raise Refused(30)
        return command

    def _feed(self, words: Words, mm: float, command: float | None) -> float:
        """Feed of this line: mm/min, or 1/min under G93, where each line names its own."""
        inverse = words.g.get(5, self.modal[5]) == 93
        if "F" in words.values:
            feed = words.values.pop("F") * (1.0 if inverse else mm)
        else:
            feed = 0.0 if inverse or self.modal[5] == 93 else self.feed
        if feed == 0.0 and command in (1, 2, 3, *_PROBING) and _target(words.values):
            raise Refused(22)
        return feed

    def _carry_out(self, words: Words, command: float | None, feed: float) -> list[Action]:
        """Check the rest of the line against the new state; take the old one back if refused."""
        values, coordinates = words.values, self.coordinates
        kept = (self.modal, coordinates.selected, coordinates.g92, coordinates.tool_length)
        try:
            actions = self._dwell(words)
            speed, tool = values.pop("S", self.speed), values.pop("T", self.tool)
            changed = {g: n for g, n in words.g.items() if self.modal.get(g, n) != n}
            if changed:
                self.modal = self.modal | changed
                coordinates.selected = self.modal[12]
                if changed.get(8) == 49:
                    coordinates.tool_length = 0.0
            moves = [] if command is None else self._command(words, command, feed)
            if values:
                raise Refused(36)
        except Refused:
            self.modal, coordinates.selected, coordinates.g92, coordinates.tool_length = kept
            raise
        self.feed, self.tool = feed, int(tool)
        last = moves[-1] if moves else None
        if isinstance(last, Move | Probe):
            coordinates.position = list(last.target)
        return [*self._spindle(words, speed), *actions, *moves, *self._end(words)]

    def _dwell(self, words: Words) -> list[Action]:
        if words.g.get(0) != 4.0:
            return []
        if "P" not in words.values:
            raise Refused(28)
        return [Wait("dwell", words.values.pop("P"))]

    def _spindle(self, words: Words, speed: float) -> list[Action]:
        spindle = words.m.get(7, self.spindle)
        changed = spindle != self.spindle or (speed != self.speed and spindle != _SPINDLE_OFF)
        self.spindle, self.speed = spindle, speed
        actions: list[Action] = []
        if changed:
            actions.append(Wait("spindle", 0.0 if spindle == _SPINDLE_OFF else speed))
        if 8 in words.m:
            self.coolant = words.m[8]
            actions.append(Wait("coolant", self.coolant))
        return actions

    def _end(self, words: Words) -> list[Action]:
        ending = words.m.get(4)
        if ending == 0:
            return [Wait("pause")]
        if ending in (2, 30):
            self.modal = self.modal | _AFTER_END
            self.coordinates.selected = 54.0
            self.spindle, self.coolant = _SPINDLE_OFF, _COOLANT_OFF
            return [Wait("end")]
        return []

    def _command(self, words: Words, command: float, feed: float) -> list[Action]:
        values, coordinates = words.values, self.coordinates
        if command in (0, 1):
            return self._line(words, command, feed)
        if command in (2, 3):
            return self._arc(values, clockwise=command == 2, feed=feed)
        if command in _PROBING:
            return self._probe(values, command, feed)
        if command in (28, 30):
            return self._stored_point(values, command)
        stores: dict[float, Callable[[], None]] = {
            10.0: lambda: coordinates.set_system(values),
            28.1: lambda: coordinates.store(28.0),
            30.1: lambda: coordinates.store(30.0),
        }
        if command in stores:
            stores[command]()
            return [Wait("eeprom")]
        if command == 43.1:
            coordinates.offset_tool(values)
        elif command == 92:
            coordinates.shift(values)
        else:
            coordinates.g92 = [0.0, 0.0, 0.0]
        return []

    def _goal(self, values: Values, *, machine: bool = False) -> Point:
        relative = self.modal[3] == 91
        return tuple(self.coordinates.target(values, machine=machine, relative=relative))

    def _line(self, words: Words, command: float, feed: float) -> list[Action]:
        values = words.values
        if not any(letter in values for letter in self._letters):
            return []
        goal = self._goal(values, machine=words.g.get(0) == 53.0)
        if command == 0:
            return [Move(goal, math.inf)]
        if self.modal[5] == 93:
            feed *= math.dist(self.coordinates.position, goal)
        return [Move(goal, feed / 60.0)]

    def _arc(self, values: Values, *, clockwise: bool, feed: float) -> list[Action]:
        if not _target(values):
            return []
        axes = u, v, _ = _PLANES[int(self.modal[2])]
        if not any("XYZ"[axis] in values for axis in (u, v)):
            raise Refused(32)
        start, end = tuple(self.coordinates.position), self._goal(values)
        du, dv = end[u] - start[u], end[v] - start[v]
        if "R" in values:
            if du == 0 and dv == 0:
                raise Refused(33)
            offset = centre_from_radius(du, dv, values.pop("R"), clockwise=clockwise)
        else:
            if "IJK"[u] not in values and "IJK"[v] not in values:
                raise Refused(35)
            offset = values.pop("IJK"[u], 0.0), values.pop("IJK"[v], 0.0)
            check_ends((-offset[0], -offset[1]), (du - offset[0], dv - offset[1]))
        tolerance = self._settings.arc_tolerance
        points = list(chords(start, end, offset, axes, clockwise=clockwise, tolerance=tolerance))
        if self.modal[5] == 93:
            feed *= sum(math.dist(a, b) for a, b in pairwise([start, *points]))
        return [Move(point, feed / 60.0) for point in points]

    def _probe(self, values: Values, command: float, feed: float) -> list[Action]:
        goal = self._goal(values)
        if goal == tuple(self.coordinates.position):
            raise Refused(33)
        return [Probe(goal, feed / 60.0, away=command > 38.3, must=command in (38.2, 38.4))]

    def jog(self, line: str) -> Move:
        """Interpret what stands behind `$J=`; the modal state stays as it is."""
        kept = (self.modal, self.feed)
        words = read_words(line, self._letters)
        if words.m or not {*words.g.values()} <= {20.0, 21.0, 90.0, 91.0, 53.0}:
            raise Refused(16)
        if "F" not in words.values:
            raise Refused(22)
        try:
            self.modal = self.modal | {5: 94.0}
            actions = self.run("G1" + line)
        finally:
            self.modal, self.feed = kept
        move = next((action for action in actions if isinstance(action, Move)), None)
        if move is None:
            raise Refused(26)
        return move

    def _stored_point(self, values: Values, command: float) -> list[Action]:
        """G28, G30: by way of the named axes to the stored point."""
        stored = self.coordinates.systems[command]
        named = [axis for axis, letter in enumerate(self._letters) if letter in values]
        if not named:
            return [Move(tuple(stored), math.inf)]
        via = self._goal(values)
        end = tuple(stored[axis] if axis in named else at for axis, at in enumerate(via))
        return [Move(via, math.inf), Move(end, math.inf)]


def _target(values: Values) -> bool:
    """Whether any word names where a motion goes."""
    return any(letter in values for letter in "XYZAIJKR")
