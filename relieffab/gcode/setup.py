"""Setup: all that stands round the cutter while a program runs."""

from dataclasses import dataclass, replace

from relieffab.cutter import Cutter
from relieffab.gcode.dialect import dialect
from relieffab.gcode.limits import Limits
from relieffab.gcode.post import Post, Units
from relieffab.machine import Machine, Material, cutting
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position


@dataclass(frozen=True)
class Setup:
    """What programs are written for, and judged by.

    Parameters
    ----------
    machine : Machine
    material : Material
    stock : Stock
    depth : float
        Of the relief under Z0, positive, mm: no program goes below it.
    units : {'mm', 'in'}
        Of the programs.
    position : Position, optional
        Where the stock is cut part by part.

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
    position: Position | None = None

    def __post_init__(self) -> None:
        _ = self.post

    @property
    def post(self) -> Post:
        """How programs are put into words."""
        return Post(dialect(self.machine.dialect), self.units, self.stock.radius)

    def at(self, position: Position | None) -> "Setup":
        """Move the stock to a position; with none it stays."""
        if position is None:
            return self
        zero = (*position.zero, self.stock.work_zero[2])
        stock = replace(self.stock, work_zero=zero, turned=position.turned)
        return replace(self, stock=stock, position=position)

    @property
    def window(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Near left and far right corner of what is cut, panel mm."""
        if self.position is None:
            return (0.0, 0.0), (self.stock.width, self.stock.height)
        return self.position.low, self.position.high

    def limits(self, cutter: Cutter) -> Limits:
        """Say how far a cutter may go."""
        stepdown = cutting(cutter, self.material, self.machine).stepdown
        return Limits(self.depth, stepdown, cutter, self.stock, self.machine, self.position)
