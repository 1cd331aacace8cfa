"""Settings: how finely to carve, and which way round."""

from dataclasses import dataclass
from math import isfinite
from typing import Literal, get_args

from relieffab.errors import InputError

Milling = Literal["either", "climb", "conventional"]


@dataclass(frozen=True)
class Settings:
    """How finely to carve; every length in mm.

    Parameters
    ----------
    stepover : float, optional
        Between finishing rows; from the scallop height where not given.
    scallop : float
        Height of the ridges between rows, on level ground and on slopes.
    allowance : float
        What roughing leaves for finishing, on every side.
    tolerance : float
        Largest distance of simplified paths from the exact ones, upwards only.
    rest : float
        What a cutter may leave before the finest one cuts again.
    angle : float
        Of finishing rows, from X towards Y, degrees.
    crossed : bool
        Whether rows across these follow, over what they left.
    milling : {'either', 'climb', 'conventional'}
        Which side of the cutter the stock is on; 'either' goes to and fro.
    """

    stepover: float | None = None
    scallop: float = 0.01
    allowance: float = 0.3
    tolerance: float = 0.004
    rest: float = 0.04
    angle: float = 0.0
    crossed: bool = False
    milling: Milling = "either"

    def __post_init__(self) -> None:
        for name in ("scallop", "allowance", "tolerance", "rest"):
            value = getattr(self, name)
            if not 0 < value <= 5:
                raise InputError(f"{name} cannot be {value:g} mm", expected="more than 0, up to 5")
        if not isfinite(self.angle):
            raise InputError("the rows' angle is not a number", found=f"{self.angle}")
        if self.milling not in get_args(Milling):
            raise InputError(
                "there is no such way of milling",
                expected=" or ".join(get_args(Milling)),
                found=repr(self.milling),
            )
