"""The text of a program read back as its controller would run it, apart from the writer."""

import re
from math import dist, inf, isnan, nan, radians

import numpy as np

from relieffab.errors import InputError
from relieffab.gcode.arc import centre_from_radius, chords
from relieffab.gcode.dialect import GRBL, Dialect
from relieffab.gcode.program import Program
from relieffab.gcode.words import Words, check_bytes, refused, split

GROUP = {
    **dict.fromkeys(["G0", "G1", "G2", "G3", "G80"], "motion"),
    "G4": "dwell",
    "G17": "plane",
    "G20": "units",
    "G21": "units",
    "G40": "cutter compensation",
    "G43": "length offset",
    "G49": "length offset",
    "G54": "coordinates",
    "G61": "path",
    "G64": "path",
    "G90": "distance",
    "G91": "distance",
    "G91.1": "arc distance",
    "G93": "feed mode",
    "G94": "feed mode",
    **dict.fromkeys(["M0", "M1", "M2", "M30", "M400"], "stop"),
    "M6": "cutter",
    **dict.fromkeys(["M3", "M4", "M5"], "spindle"),
    **dict.fromkeys(["M8", "M9"], "coolant"),
}
# Grbl runs these; a program that needs them goes by more than its own text.
NOT_FOLLOWED = {
    *("G10", "G18", "G19", "G28", "G28.1", "G30", "G30.1", "G38.2", "G38.3", "G38.4", "G38.5"),
    *("G43.1", "G53", "G55", "G56", "G57", "G58", "G59", "G92", "G92.1", "G93"),
}
VALUES = frozenset("AFHIJKLNPRSTXYZ")
AXES = frozenset("XYZA")
ARC_WORDS = frozenset("IJR")

_NUMBER = r"-?(?:\d+\.?\d*|\.\d+)"
# Nearly all lines of a relief look like this, and are read without more ado.
_PLAIN = re.compile(
    rf"(?:G([01]))?(?:X({_NUMBER}))?(?:([YA])({_NUMBER}))?(?:Z({_NUMBER}))?(?:F(\d+\.?\d*))?"
)


def read_program(
    text: str, *, name: str = "program", dialect: Dialect = GRBL, radius: float = 0.0
) -> Program:
    """Interpret a program of G-code.

    Takes the codes of the dialect, F, S, T and N, in either case, with blanks and
    comments.  The program must set units and distance mode itself, and end as
    programs of its dialect do.

    Parameters
    ----------
    text : str
    name : str
        For messages: the file's name, usually.
    dialect : Dialect
        Whose codes and habits hold.
    radius : float
        Of the face of a round stock, mm: where the controller has a rotary axis, the
        program's A is what Y is on the face laid out flat.  0 for a flat one.

    Raises
    ------
    InputError
        Naming the line, and Grbl's own error where it has one.
    """
    check_bytes(text, name)
    reader = _Interpreter(name, dialect, radius if dialect.rotary == "A" else 0.0)
    lines = text.splitlines()
    for number, raw in enumerate(lines, 1):
        if reader.simple and (match := _PLAIN.fullmatch(raw)) and reader.plain(match, number):
            continue
        words = split(raw, f"{name} line {number}", dialect)
        if words:
            reader.block(words, number)
    return reader.program(len(lines))


class _Interpreter:
    """The modal state, and the motion so far."""

    def __init__(self, name: str, dialect: Dialect, radius: float) -> None:
        self.name = name
        self.second = "A" if radius else "Y"  # the axis square to X and Z
        self.per_degree = -radians(1) * radius
        self.dialect = dialect
        self.ends = {"M2", "M30", dialect.end} & dialect.codes
        self.tool = self.selected = 0
        self.tools: list[int] = []
        self.size = 0
        self.sizes: list[int] = []
        self.number = 0
        self.modes: dict[str, str] = {}
        self.named: dict[str, str] = {}
        self.scale = 1.0
        self.feed = 0.0
        self.speed = self.turning = 0.0
        self.at = (nan, nan, nan)
        self.placed = self.ended = self.simple = False
        self.blind_line = 0
        self.points: list[tuple[float, float, float]] = []
        self.feeds: list[float] = []
        self.lines: list[int] = []
        self.spindles: list[float] = []
        self.waits: dict[int, float] = {}

    @property
    def where(self) -> str:
        return f"{self.name} line {self.number}"

    def plain(self, match: re.Match[str], number: int) -> bool:
        """Run a line of G0 or G1 and plain axis words; say whether that was possible."""
        motion, x, axis, y, z, feed = match.groups()
        if not (motion or self.dialect.modal) or (axis and axis != self.second):
            return False
        rapid = (motion == "0") if motion else self.modes["motion"] == "G0"
        if self.inverse and not rapid and not feed:
            return False
        rate = float(feed) if feed else self.feed
        if (not rapid and rate == 0) or match.end() > self.dialect.characters or not (x or y or z):
            return False
        if motion:
            self.modes["motion"] = "G" + motion
        self.number, self.feed, self.size = number, rate, match.end() + 1
        at = self.at
        target = (
            float(x) if x else at[0],
            float(y) * (self.per_degree or 1.0) if y else at[1],
            float(z) if z else at[2],
        )
        self._record(target, inf if rapid else self._rate(target, rate))
        return True

    def block(self, words: Words, number: int) -> None:
        """Run one line: values, then modes, dwell and motion, in Grbl's order."""
        self.number = number
        self.size = sum(1 + len(word[1]) for word in words) + 1
        if self.ended:
            raise InputError("there is code after the program's end", where=self.where)
        values: dict[str, float] = {}
        commands: list[str] | None = None
        for letter, digits, _ in words:
            if letter in "GM":
                commands = [letter + digits] if commands is None else [*commands, letter + digits]
            elif letter in values:
                raise refused(25, self.where, letter)
            else:
                values[letter] = float(digits)
        modes = self.named = self._take(commands) if commands else {}
        if not values.keys() <= {"X", self.second, "Z"}:
            self._values(values)
        if "cutter" in modes:
            self._change(values)
        if "spindle" in modes or "S" in values:
            self._turn()
        if "dwell" in modes:
            self._wait(values)
        if values.keys() & AXES or modes.get("motion") in ("G2", "G3"):
            self._move(values)
        elif ARC_WORDS & values.keys():
            raise refused(36, self.where, " ".join(sorted(ARC_WORDS & values.keys())))
        self.ended = modes.get("stop") in self.ends
        held = self.modes.get("motion"), self.modes.get("units"), self.modes.get("distance")
        usual = held in (("G0", "G21", "G90"), ("G1", "G21", "G90"))
        self.simple = usual and self.placed and not self.ended

    def _take(self, commands: list[str]) -> dict[str, str]:
        """Set the modes a line names."""
        named: dict[str, str] = {}
        for command in commands:
            value = float(command[1:])
            key = f"{command[0]}{value:g}"
            if key in NOT_FOLLOWED - self.dialect.codes:
                raise InputError(
                    f"{key} is not followed here: where it leads is not in the program",
                    expected="moves in the XY plane from one work zero, in mm or inches a minute",
                    where=self.where,
                )
            if key not in GROUP or key not in self.dialect.codes:
                raise refused(23 if key[0] == "M" and value % 1 else 20, self.where, command)
            if GROUP[key] in named:
                raise refused(21, self.where, f"{named[GROUP[key]]} and {key}")
            named[GROUP[key]] = key
        before = self.modes.get("feed mode", "G94")
        if named.get("feed mode", before) != before:
            self.feed = 0.0  # what counted mm does not count moves
        self.modes.update(named)
        self.named = named
        if "units" in named:
            self.scale = 25.4 if named["units"] == "G20" else 1.0
        return named

    def _values(self, values: dict[str, float]) -> None:
        """Take feed and speed; refuse words that mean nothing in this line."""
        unknown = values.keys() - VALUES
        if "G43" not in self.dialect.codes:
            unknown |= values.keys() & {"H"}
        unknown |= values.keys() & ({"Y", "A"} - {self.second})
        if unknown:
            raise refused(20, self.where, " ".join(sorted(unknown)))
        for letter in values.keys() & set("FNPST"):
            if values[letter] < 0:
                raise refused(4, self.where, f"{letter}{values[letter]:g}")
        if values.get("N", 0) > 10_000_000:
            raise refused(27, self.where, f"N{values['N']:g}")
        unused = values.keys() & set("KL")
        if "P" in values and "dwell" not in self.named and self.named.get("path") != "G64":
            unused.add("P")
        if "H" in values and self.named.get("length offset") != "G43":
            unused.add("H")
        if unused:
            raise refused(36, self.where, " ".join(sorted(unused)))
        if "F" in values:
            self.feed = values["F"] * (1.0 if self.inverse else self.scale)
        if "S" in values:
            self.speed = values["S"]
        if "T" in values:
            self.selected = int(values["T"])

    def _change(self, values: dict[str, float]) -> None:
        if "T" not in values:
            raise refused(28, self.where, "M6 without T")
        if self.turning:
            raise InputError("the cutter is changed while the spindle turns", where=self.where)
        self.tool = self.selected

    def _turn(self) -> None:
        on = self.modes.get("spindle") in ("M3", "M4")
        self.turning = self.speed if on else 0.0

    def _wait(self, values: dict[str, float]) -> None:
        del self.modes["dwell"]
        if "P" not in values:
            raise refused(28, self.where, "G4 without P")
        before = len(self.points)
        seconds = values["P"] / self.dialect.dwell
        self.waits[before] = self.waits.get(before, 0.0) + seconds

    def _move(self, values: dict[str, float]) -> None:
        """Go where X, Y and Z say, in the motion mode that holds."""
        modes = self.modes
        motion = modes.get("motion", "")
        if not (motion and "units" in modes and "distance" in modes):
            raise InputError(
                "the program moves before it has said how",
                expected="G0 or G1, G20 or G21, and G90 or G91 first",
                where=self.where,
            )
        if motion == "G80":
            raise refused(31, self.where, "G80")
        if not (self.dialect.modal or "motion" in self.named):
            raise InputError(
                f"{self.dialect.title} needs G0 or G1 in every line that moves", where=self.where
            )
        if motion != "G0" and self.feed == 0:
            raise refused(22, self.where, motion)
        if self.inverse and motion != "G0" and "F" not in values:
            raise InputError(
                "a move by inverse time without its own F",
                expected="F in its line",
                where=self.where,
            )
        target = self._target(values)
        if motion in ("G2", "G3"):
            if self.inverse or self.second == "A":
                raise InputError(
                    "an arc with a rotary axis, or by inverse time, is not followed here",
                    expected="G0 and G1",
                    where=self.where,
                )
            self._arc(values, target, motion == "G2")
            return
        if "I" in values or "J" in values or "R" in values:
            raise refused(36, self.where, " ".join(sorted(ARC_WORDS & values.keys())))
        if not self.placed:
            self._place(target, motion)
            return
        self._record(target, inf if motion == "G0" else self._rate(target, self.feed))

    @property
    def inverse(self) -> bool:
        """Whether F counts moves a minute (G93), not mm."""
        return self.modes.get("feed mode") == "G93"

    def _rate(self, target: tuple[float, float, float], feed: float) -> float:
        """Give the feed of a move, mm/min; of one that goes nowhere, as if it went 1 mm."""
        return feed * (dist(self.at, target) or 1.0) if self.inverse else feed

    def _target(self, values: dict[str, float]) -> tuple[float, float, float]:
        x, y, z = self.at
        scale, second = self.scale, self.second
        across = self.per_degree or scale
        if self.modes["distance"] == "G90":
            return (
                values["X"] * scale if "X" in values else x,
                values[second] * across if second in values else y,
                values["Z"] * scale if "Z" in values else z,
            )
        x_step, z_step = (values.get(axis, 0.0) * scale for axis in "XZ")
        if not self.placed:
            raise InputError("a relative move from a place not known", where=self.where)
        return x + x_step, y + values.get(second, 0.0) * across, z + z_step

    def _place(self, target: tuple[float, float, float], motion: str) -> None:
        """Approach from wherever the machine stands, until all axes are known."""
        if motion != "G0":
            raise InputError(
                "a cutting move from a place not known",
                expected="X, Y and Z reached by rapids first",
                where=self.where,
            )
        sideways = target[:2] != self.at[:2] and not all(
            isnan(a) and isnan(b) for a, b in zip(target[:2], self.at[:2], strict=True)
        )
        if sideways and isnan(self.at[2]) and not self.blind_line:
            self.blind_line = self.number
        self.placed = not any(map(isnan, target))
        self.at = target
        if self.placed:
            self._record(target, inf)

    def _record(self, target: tuple[float, float, float], feed: float) -> None:
        self.at = target
        self.points.append(target)
        self.feeds.append(feed)
        self.lines.append(self.number)
        self.spindles.append(self.turning)
        self.sizes.append(self.size)
        self.tools.append(self.tool)

    def _arc(
        self, values: dict[str, float], target: tuple[float, float, float], clockwise: bool
    ) -> None:
        if not self.placed:
            self._place(target, "an arc")
        if not values.keys() & {"X", "Y", "Z"}:
            raise refused(26, self.where, "an arc without axis words")
        if not values.keys() & {"X", "Y"}:
            raise refused(32, self.where, "an arc along Z alone")
        if "R" in values:
            if values.keys() & {"I", "J"}:
                raise refused(36, self.where, "I or J beside R")
            radius = values["R"] * self.scale
            offset = centre_from_radius(self.at, target, radius, clockwise, self.where)
        elif values.keys() & {"I", "J"}:
            offset = values.get("I", 0.0) * self.scale, values.get("J", 0.0) * self.scale
        else:
            raise refused(35, self.where, "an arc without I, J or R")
        for point in chords(self.at, target, offset, clockwise, self.where):
            self._record(point, self.feed)

    def program(self, line_count: int) -> Program:
        """Close the program."""
        if not self.ended:
            raise InputError(
                "the program has no end",
                expected=f"{' or '.join(sorted(self.ends))} on its last line",
                where=self.name,
                hint="the file may be cut short",
            )
        dwell = np.zeros(len(self.points) + 1)
        for before, seconds in self.waits.items():
            dwell[before] = seconds
        return Program(
            self.name,
            np.array(self.points, dtype=float).reshape(-1, 3),
            np.array(self.feeds, dtype=float),
            np.array(self.lines, dtype=np.int64),
            np.array(self.spindles, dtype=float),
            dwell,
            line_count,
            np.array(self.sizes, dtype=np.int64),
            np.array(self.tools, dtype=np.int64),
            self.blind_line,
        )
