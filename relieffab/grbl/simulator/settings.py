"""The $ settings, with their defaults for a desktop router of the 3018 class."""

from relieffab.grbl.simulator.words import Refused

Point = tuple[float, ...]

DEFAULTS: dict[int, float] = {
    0: 10, 1: 25, 2: 0, 3: 0, 4: 0, 5: 0, 6: 0, 10: 3, 11: 0.010, 12: 0.002, 13: 0,
    20: 0, 21: 0, 22: 0, 23: 0, 24: 25, 25: 500, 26: 250, 27: 1, 30: 10000, 31: 0, 32: 0,
    100: 800, 101: 800, 102: 800, 110: 1600, 111: 1600, 112: 800,
    120: 30, 121: 30, 122: 30, 130: 263, 131: 157, 132: 34,
}  # fmt: skip
ROTARY: dict[int, float] = {103: 88.889, 113: 7200, 123: 360, 133: 0}
"""Of an axis A: steps a degree, degrees/min, degrees/s², no end to its turning."""
_DECIMALS = {11, 12, 24, 25, 27, *range(100, 134)}


class Settings:
    """Numbered values, checked as Grbl does, and the machine's figures read from them.

    Parameters
    ----------
    changes : dict, optional
        Number -> value, over the defaults.
    axes : int
        Three, or four with A, which turns: degrees for mm in all that follows.

    Attributes
    ----------
    steps : tuple of float
        Steps per mm.
    max_rate, acceleration : tuple of float
        mm/s and mm/s².
    travel : tuple of float
        mm; 0 where there is no end to it.
    junction_deviation, arc_tolerance : float
        mm.
    """

    def __init__(self, changes: dict[int, float] | None = None, axes: int = 3) -> None:
        self.axes = axes
        self._defaults = DEFAULTS | (ROTARY if axes > len("XYZ") else {})
        self.values = dict(self._defaults)
        for number, value in (changes or {}).items():
            self.change(number, value)
        self._read()

    def change(self, number: int, value: float) -> None:
        """Set `$number=value`, or refuse as Grbl would."""
        if number not in self.values:
            raise Refused(3)
        if value < 0:
            raise Refused(4)
        if number == 0 and value < 3:
            raise Refused(6)
        if number == 20 and value and not self.values[22]:
            raise Refused(10)
        self.values[number] = value
        if number == 22 and not value:
            self.values[20] = 0
        self._read()

    def restore(self) -> None:
        """Go back to the defaults."""
        self.values = dict(self._defaults)
        self._read()

    def __getitem__(self, number: int) -> float:
        return self.values[number]

    def lines(self) -> list[str]:
        """List the dump that `$$` prints."""
        return [
            f"${number}={value:.3f}" if number in _DECIMALS else f"${number}={int(value)}"
            for number, value in sorted(self.values.items())
        ]

    def _read(self) -> None:
        self.steps = self._axes(100)
        self.max_rate = tuple(rate / 60.0 for rate in self._axes(110))
        self.acceleration = self._axes(120)
        self.travel = self._axes(130)
        self.junction_deviation = self.values[11]
        self.arc_tolerance = self.values[12]

    def _axes(self, first: int) -> Point:
        return tuple(self.values[first + axis] for axis in range(self.axes))
