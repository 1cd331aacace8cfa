"""Setup: all that stands round the cutter while a program runs."""

from dataclasses import dataclass

from relieffab.cutter import Cutter
from relieffab.gcode.dialect import dialect
from relieffab.gcode.limits import Limits
from relieffab.gcode.post import Post, Units
from relieffab.machine import Machine, Material, cutting
from relieffab.stock import Stock


@dataclass(frozen=True)
class Setup:
    """What programs are written for, and judged by.

    Parameters
    ----------
    machine : Machine
    material : Material
    stock : Stock
    depth : float
        Of the relief, positive, mm: no program goes below it.
    units : {'mm', 'in'}
        Of the programs.

    Raises
    ------
    InputError
        If there is no dialect such as the machine's, or it does not know the units.
    """

    machine: Machine
    material: Material
    stock: Stock
    depth: float
    units: Units = "mm"

    def __post_init__(self) -> None:
        _ = self.post

    @property
    def post(self) -> Post:
        """How programs are put into words."""
        return Post(dialect(self.machine.dialect), self.units)

    def limits(self, cutter: Cutter) -> Limits:
        """Say how far a cutter may go."""
        stepdown = cutting(cutter, self.material, self.machine).stepdown
        return Limits(self.depth, stepdown, cutter, self.stock, self.machine)
