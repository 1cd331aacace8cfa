"""Where work zero lies: G54-G59, G92, tool length, and the stored points of G28 and G30."""

from relieffab.grbl.simulator.words import Refused

Values = dict[str, float]


class Coordinates:
    """The offsets between what a program names and where the machine is.

    Parameters
    ----------
    letters : str
        Of the axes; A is in degrees where others are in mm.

    Attributes
    ----------
    position : list of float
        Machine mm, as after the last line interpreted.
    systems : dict
        54...59, 28, 30 -> machine mm; kept over a reset, as in EEPROM.
    selected : float
        The work coordinate system in force.
    g92 : list of float
    tool_length : float
        mm; both are lost at a reset.
    """

    def __init__(self, letters: str = "XYZ") -> None:
        self.letters = letters
        self.position = self.nowhere
        self.systems = {float(n): self.nowhere for n in (54, 55, 56, 57, 58, 59, 28, 30)}
        self.reset()

    @property
    def nowhere(self) -> list[float]:
        """0 on every axis."""
        return [0.0] * len(self.letters)

    def reset(self) -> None:
        """Forget what is not in EEPROM."""
        self.selected = 54.0
        self.g92, self.tool_length = self.nowhere, 0.0

    def forget(self) -> None:
        """Clear what is in EEPROM."""
        self.systems = {number: [0.0] * len(self.letters) for number in self.systems}

    @property
    def work_offset(self) -> list[float]:
        """Work zero in machine coordinates, mm."""
        zero = [a + b for a, b in zip(self.systems[self.selected], self.g92, strict=True)]
        zero[2] += self.tool_length
        return zero

    def target(self, values: Values, *, machine: bool, relative: bool) -> list[float]:
        """Take the axis words (mm) out of `values`; where they point to in machine mm."""
        target = list(self.position)
        named = self.position if relative else self.work_offset
        base = self.nowhere if machine else named
        for axis, letter in enumerate(self.letters):
            if letter in values:
                target[axis] = base[axis] + values.pop(letter)
        return target

    def set_system(self, values: Values) -> None:
        """G10: L2 sets a system's zero, L20 makes the position the given coordinates."""
        if "L" not in values or "P" not in values:
            raise Refused(28)
        if not any(axis in values for axis in self.letters):
            raise Refused(26)
        kind, number = values.pop("L"), int(values.pop("P"))
        if kind not in (2, 20):
            raise Refused(20)
        if not 0 <= number <= 6:
            raise Refused(29)
        system = self.systems[53.0 + number if number else self.selected]
        for axis, letter in enumerate(self.letters):
            if letter in values:
                value = values.pop(letter)
                shift = self.g92[axis] + (self.tool_length if axis == 2 else 0.0)
                system[axis] = value if kind == 2 else self.position[axis] - shift - value

    def shift(self, values: Values) -> None:
        """G92: make the position the given coordinates until the next reset."""
        if not any(axis in values for axis in self.letters):
            raise Refused(26)
        system = self.systems[self.selected]
        g92 = list(self.g92)
        for axis, letter in enumerate(self.letters):
            if letter in values:
                base = system[axis] + (self.tool_length if axis == 2 else 0.0)
                g92[axis] = self.position[axis] - base - values.pop(letter)
        self.g92 = g92

    def offset_tool(self, values: Values) -> None:
        """G43.1: shift Z by the tool's length."""
        if [axis for axis in self.letters if axis in values] != ["Z"]:
            raise Refused(37)
        self.tool_length = values.pop("Z")

    def store(self, number: float) -> None:
        """G28.1, G30.1: keep the position."""
        self.systems[number] = list(self.position)
