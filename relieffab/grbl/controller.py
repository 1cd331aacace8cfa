"""What a controller says of itself: version, buffer, settings, offsets."""

import re
from dataclasses import dataclass, field

from relieffab.grbl.messages import Note, Point, Setting
from relieffab.grbl.program import LONGEST_LINE, Program

RECEIVE_BUFFER = 128
"""Bytes, where the controller does not report it: Grbl 1.1 on an 8-bit board."""

_OFFSETS = {"G54", "G55", "G56", "G57", "G58", "G59", "G28", "G30", "G92", "TLO"}
_NUMBERS = re.compile(r"(?:^|(?<=,))-?\d+\.\d+(?=,|$)")

ROUNDING = 0.001
"""mm: the last digit of a reported offset."""


@dataclass
class Controller:
    """The facts a machine gives when asked `$I`, `$$`, `$#` and `$G`.

    Parameters
    ----------
    version : str
        From the banner, such as ``1.1h``.
    settings : dict
        `$number` -> value.
    offsets : dict
        G54...G59, G28, G30, G92, TLO -> position, mm.
    modal : str
        The G-codes in force.
    buffer, blocks : int
        Bytes of the receive buffer and moves of the planner ([OPT:]).
    """

    version: str
    settings: dict[int, float] = field(default_factory=dict)
    offsets: dict[str, Point] = field(default_factory=dict)
    modal: str = ""
    buffer: int = RECEIVE_BUFFER
    blocks: int = 15

    def learn(self, message: Setting | Note) -> None:
        """Take in one line of an answer; a damaged one says nothing."""
        if isinstance(message, Setting):
            self.settings[message.number] = message.value
        elif message.tag == "OPT":
            _, *sizes = message.text.split(",")
            if len(sizes) >= 2 and all(size.isdigit() for size in sizes[:2]):
                self.blocks = max(int(sizes[0]), 1)
                self.limit_buffer(int(sizes[1]), reported=True)
        elif message.tag == "GC":
            self.modal = message.text
        elif message.tag in _OFFSETS:
            values = _NUMBERS.findall(message.text)
            if len(values) == 3:
                self.offsets[message.tag] = (float(values[0]), float(values[1]), float(values[2]))
            elif message.tag == "TLO" and len(values) == 1:
                self.offsets["TLO"] = (0.0, 0.0, float(values[0]))

    def limit_buffer(self, size: int, *, reported: bool = False) -> None:
        """Believe a size of the receive buffer, or a smaller one than was `reported`.

        A buffer that could not take one line of G-code is not believed.
        """
        if size > LONGEST_LINE:
            self.buffer = size if reported else min(self.buffer, size)

    @property
    def travel(self) -> Point | None:
        """Travel of X, Y, Z, mm ($130-$132); None where not reported."""
        x, y, z = (self.settings.get(number) for number in (130, 131, 132))
        return None if x is None or y is None or z is None else (x, y, z)

    @property
    def soft_limits(self) -> bool:
        """True where the machine stops itself at the end of its travel ($20)."""
        return bool(self.settings.get(20, 0))

    @property
    def work_zero(self) -> Point:
        """Where work zero lies in machine coordinates, mm."""
        modal = self.modal.split()
        named = [word for word in modal if word in ("G54", "G55", "G56", "G57", "G58", "G59")]
        parts = [
            self.offsets.get(key, (0.0, 0.0, 0.0)) for key in [*(named or ["G54"]), "G92", "TLO"]
        ]
        return (
            sum(part[0] for part in parts),
            sum(part[1] for part in parts),
            sum(part[2] for part in parts),
        )


def misfits(program: Program, controller: Controller) -> list[str]:
    """Say where a program leaves the machine's travel.

    Without soft limits the machine's own zero means nothing, so only the extent is compared
    with the travel; with them, homed, the room is 0 to -travel on every axis (or 0 to travel
    where the controller reports so is not told apart: Grbl 1.1 uses the negative side).

    Returns
    -------
    list of str
        One sentence an axis; empty where it fits or nothing can be said.
    """
    found: list[str] = []
    travel = controller.travel
    if travel is None:
        return found
    for axis in range(3):
        low, high = program.bounds[0][axis], program.bounds[1][axis]
        if low is None or high is None:
            continue
        name, room, zero = "XYZ"[axis], travel[axis], controller.work_zero[axis]
        if high - low > room:
            found.append(f"{name} spans {high - low:.3f} mm of {room:.3f} mm of travel")
        elif controller.soft_limits and not (
            -room - ROUNDING <= low + zero and high + zero <= ROUNDING
        ):
            found.append(
                f"{name} goes from {low + zero:.3f} to {high + zero:.3f} mm in machine "
                f"coordinates, the machine from {-room:.3f} to 0"
            )
    return found
