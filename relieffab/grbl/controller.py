"""What a controller says of itself: version, buffer, settings, offsets, modal state."""

import re
from collections.abc import Collection
from dataclasses import dataclass, field

from relieffab.grbl.lines import LONGEST_LINE
from relieffab.grbl.messages import AXES, Note, Point, Setting, scaled
from relieffab.grbl.modal import MM_PER_INCH
from relieffab.grbl.pace import Limits

RECEIVE_BUFFER = 128
"""Bytes, where the controller does not report it: Grbl 1.1 on an 8-bit board."""
FAST_LINES = 2000.0
"""Lines a second of a 32-bit controller, told by its larger buffer."""

SYSTEMS = ("G54", "G55", "G56", "G57", "G58", "G59")
_OFFSETS = {*SYSTEMS, "G28", "G30", "G92", "TLO"}
TELLING = frozenset({"VER", "NEWOPT", "FIRMWARE", "OPT", "GC", *_OFFSETS})
"""Tags of the notes that a `Controller` learns from; others may differ from answer to answer."""
_NUMBERS = re.compile(r"(?:^|(?<=,))-?\d+\.\d+(?=,|$)")


@dataclass
class Controller:
    """The facts a machine gives when asked `$I`, `$$`, `$#` and `$G`.

    Parameters
    ----------
    version : str
        From the banner or `$I`, such as ``1.1h``.
    settings : dict
        `$number` -> value.
    offsets : dict
        G54...G59, G28, G30, G92, TLO -> position, in the units the machine reports.
    modal : str
        The G-codes in force.
    hal : bool
        True for grblHAL, which knows more codes.
    options : str
        Letters of the build options ([OPT:]).
    buffer, blocks : int
        Bytes of the receive buffer and moves of the planner ([OPT:]).
    """

    version: str = ""
    settings: dict[int, float] = field(default_factory=dict)
    offsets: dict[str, Point] = field(default_factory=dict)
    modal: str = ""
    hal: bool = False
    options: str = ""
    buffer: int = RECEIVE_BUFFER
    blocks: int = 15

    def learn(self, message: Setting | Note) -> None:
        """Take in one line of an answer; a damaged one says nothing."""
        if isinstance(message, Setting):
            self.settings[message.number] = message.value
        elif message.tag == "VER":
            self.version = message.text.partition(".2")[0]  # asked twice, unlike the banner
        elif message.tag in ("NEWOPT", "FIRMWARE"):
            self.hal = True
        elif message.tag == "OPT":
            self.options, *sizes = message.text.split(",")
            if len(sizes) >= 2 and all(size.isdigit() for size in sizes[:2]):
                self.blocks = max(int(sizes[0]), 1)
                self.limit_buffer(int(sizes[1]), reported=True)
        elif message.tag == "GC":
            self.modal = message.text
        elif message.tag in _OFFSETS:
            values = _NUMBERS.findall(message.text)
            if len(values) >= 3:
                self.offsets[message.tag] = tuple(float(value) for value in values[:AXES])
            elif message.tag == "TLO" and len(values) == 1:
                self.offsets["TLO"] = (0.0, 0.0, float(values[0]))

    def limit_buffer(self, size: int, *, reported: bool = False) -> None:
        """Believe a size of the receive buffer, or a smaller one than was `reported`.

        A buffer that could not take one line of G-code is not believed.
        """
        if size > LONGEST_LINE:
            self.buffer = size if reported else min(self.buffer, size)

    @property
    def axes(self) -> int:
        """How many axes it has, as its offsets tell: three, or four with A."""
        return max((len(offset) for offset in self.offsets.values()), default=3)

    @property
    def travel(self) -> Point | None:
        """Travel of X, Y, Z, mm ($130-$132), and of A, 0 where it turns on and on.

        None where not reported.
        """
        return self._axes(130)

    @property
    def room(self) -> tuple[Point, Point] | None:
        """Lowest and highest machine coordinates, mm, A in degrees.

        Grbl homes to the upper end and counts downwards; built to set its origin where it
        homes (option Z), axes that home to the lower end ($23) count upwards.
        """
        travel = self.travel
        if travel is None:
            return None
        mask = int(self.settings.get(23, 0)) if "Z" in self.options else 0
        low = (0.0 if mask >> axis & 1 else -most for axis, most in enumerate(travel))
        high = (most if mask >> axis & 1 else 0.0 for axis, most in enumerate(travel))
        return tuple(low), tuple(high)

    @property
    def soft_limits(self) -> bool:
        """True where the machine stops itself at the end of its travel ($20)."""
        return bool(self.settings.get(20, 0))

    @property
    def homing(self) -> bool:
        """True where the machine finds its own zero ($22)."""
        return bool(int(self.settings.get(22, 0)) & 1)

    @property
    def inches(self) -> bool:
        """True where it reports inches ($13)."""
        return bool(self.settings.get(13, 0))

    @property
    def system(self) -> str:
        """The work coordinate system in force."""
        named = [word for word in self.modal.split() if word in SYSTEMS]
        return named[0] if named else "G54"

    def cleared_by(self, codes: Collection[str]) -> bool:
        """Say whether a program's G49 or G92.1 moves work zero: where an offset is in force."""
        clearing = (("G49", "TLO"), ("G92.1", "G92"))
        return any(code in codes and any(self.offsets.get(key, ())) for code, key in clearing)

    @property
    def zero_forgotten(self) -> bool:
        """True where a reset moves work zero: G92 and tool lengths are not stored."""
        return any(any(self.offsets.get(key, ())) for key in ("G92", "TLO"))

    @property
    def quiet(self) -> bool:
        """True with spindle and coolant off."""
        return {"M5", "M9"} <= set(self.modal.split())

    @property
    def work_zero(self) -> Point:
        """Where work zero lies in machine coordinates, mm, A in degrees."""
        parts = (self.offsets.get(key, ()) for key in (self.system, "G92", "TLO"))
        padded = ((*part, *[0.0] * (self.axes - len(part))) for part in parts)
        zero = tuple(sum(values) for values in zip(*padded, strict=True))
        return scaled(zero, MM_PER_INCH if self.inches else 1.0)

    @property
    def resolution(self) -> float:
        """Longest step of an axis, mm or degrees ($100-$103); 0 where not reported."""
        steps = self._axes(100)
        return 1.0 / min(step for step in steps if step) if steps else 0.0

    @property
    def limits(self) -> Limits:
        """What bounds its speed."""
        usual = Limits()
        return Limits(
            max_rate=self._axes(110) or usual.max_rate,
            acceleration=self._axes(120) or usual.acceleration,
            junction=self.settings.get(11, usual.junction),
            blocks=self.blocks,
            line_rate=usual.line_rate if self.buffer < 512 else FAST_LINES,
        )

    def _axes(self, first: int) -> Point | None:
        values = tuple(self.settings.get(first + axis, 0.0) for axis in range(self.axes))
        return values if all(values[:3]) else None
