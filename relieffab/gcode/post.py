"""Post: how a program is put into words for one machine."""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, degrees, floor, log10
from typing import Literal

from relieffab.errors import InputError
from relieffab.gcode.dialect import GRBL, Dialect
from relieffab.units import MM_PER

Units = Literal["mm", "in"]

DECIMALS = {"mm": 3, "in": 5}
"""Of a written coordinate: 1 um, 0.25 um."""
TURN_DECIMALS = 4
"""Of a written angle: 0.0001 degrees, 0.07 um on a face of 80 mm."""


@dataclass(frozen=True)
class Post:
    """Dialect and units of a program.

    Parameters
    ----------
    dialect : Dialect
    units : {'mm', 'in'}
    radius : float
        Of the face of a round stock, mm; 0 for a flat one.

    Raises
    ------
    InputError
        If the dialect does not know the units, or no rotary axis.
    """

    dialect: Dialect = GRBL
    units: Units = "mm"
    radius: float = 0.0

    def __post_init__(self) -> None:
        if self.units not in DECIMALS:
            raise InputError("unknown unit of programs", expected="mm or in", found=str(self.units))
        if self.units_word not in self.dialect.codes:
            raise InputError(
                f"{self.dialect.title} takes no programs in inches",
                expected="mm",
                found=self.units,
                where="units",
            )
        if self.radius and not self.dialect.rotary:
            raise InputError(
                f"{self.dialect.title} has no rotary axis and no inverse time",
                expected="a controller that takes A and G93, or Grbl with one in place of Y",
                where="machine",
            )

    @property
    def turns(self) -> bool:
        """Whether what is Y on the panel is written as an angle, and feeds by inverse time."""
        return bool(self.radius) and self.dialect.rotary == "A"

    @property
    def scales(self) -> tuple[float, float, float]:
        """Steps of each written coordinate to a mm.

        A turns the cutter about X against the work, right-handed: from Z to -Y.
        """
        mm = self.per_mm
        around = -degrees(1) / self.radius * 10**TURN_DECIMALS if self.turns else mm
        return mm, around, mm

    def across(self, steps: int) -> str:
        """Write the word for a place along Y, or round the axis.

        Examples
        --------
        >>> Post().across(12500)
        'Y12.5'
        """
        return f"A{_number(steps, TURN_DECIMALS)}" if self.turns else f"Y{self.number(steps)}"

    def inverse(self, rate: float, length: float) -> str:
        """Write a feed by inverse time, never above the one given.

        Parameters
        ----------
        rate : float
            mm/min.
        length : float
            Of the move, mm.
        """
        value = rate / max(length, 1e-9)
        places = max(0, 4 - floor(log10(max(value, 1e-9))))
        scaled = floor(value * 10**places * (1 + 1e-12))
        text = f"{scaled / 10**places:.{places}f}"
        return text.rstrip("0").rstrip(".") if places else text

    @property
    def units_word(self) -> str:
        """G21 or G20."""
        return "G21" if self.units == "mm" else "G20"

    @property
    def per_mm(self) -> float:
        """Steps of a written coordinate to a mm."""
        return float(10 ** DECIMALS[self.units] / MM_PER[self.units])

    def number(self, steps: int) -> str:
        """Write steps of a coordinate in as few characters as it takes.

        Examples
        --------
        >>> Post().number(12500), Post().number(-4), Post(units="in").number(12500)
        ('12.5', '-0.004', '0.125')
        """
        return _number(steps, DECIMALS[self.units])

    def length(self, mm: float) -> str:
        """Write a height that must not come out lower, mm."""
        return self.number(ceil(mm * self.per_mm - 1e-6))

    def feed(self, rate: float) -> str:
        """Write a feed, never above the one given (mm/min), to three figures at least.

        Examples
        --------
        >>> Post().feed(333.37), Post(units="in").feed(254.0), Post(units="in").feed(33)
        ('333.3', '10', '1.299')
        """
        value = rate / MM_PER[self.units]
        places = 1 if self.units == "mm" else max(1, 3 - floor(log10(max(value, 1e-9))))
        scaled = floor(value * 10**places * (1 + 1e-12) + 1e-6)
        return f"{scaled / 10**places:.{places}f}".rstrip("0").rstrip(".")

    def blend(self) -> str:
        """How far a controller that blends moves may round a corner: 2 um."""
        return f"{0.002 / MM_PER[self.units]:.5f}".rstrip("0")


@lru_cache(maxsize=1 << 17)
def _number(steps: int, decimals: int) -> str:
    sign = "-" if steps < 0 else ""
    whole, part = divmod(abs(steps), 10**decimals)
    return f"{sign}{whole}.{part:0{decimals}d}".rstrip("0").rstrip(".")
