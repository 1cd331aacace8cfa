"""Positions: a panel longer than the machine, moved along or turned half round under it.

The stock stays whole.  At each position the cutter's axis keeps to a window of the
panel that lies within the machine's travel; work zero is at the same point of every
window.  Neighbouring windows overlap by at least the widest cutter: whatever lies
between them is cut, over its whole width, by one of the two.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.machine import Machine
from relieffab.stock import Stock

Floats = NDArray[np.float64]
Way = Literal["index", "turn"]

_INSET = 0.01
"""Ways end this far inside a window, mm: more than arcs bulge and steps round."""

_BACK = "to the left of", "nearer than"


@dataclass(frozen=True)
class Position:
    """How the stock lies while a part of it is cut; lengths in panel mm.

    Parameters
    ----------
    number, count : int
        From 1, of how many.
    low, high : tuple of float
        (X, Y) of the window's near left and far right corner.
    zero : tuple of float
        (X, Y) of work zero.
    turned : bool
        Whether the stock lies turned half round about Z.
    """

    number: int
    count: int
    low: tuple[float, float]
    high: tuple[float, float]
    zero: tuple[float, float]
    turned: bool = False

    @classmethod
    def of(cls, values: dict[str, Any]) -> "Position":
        """Build a position from what `dataclasses.asdict` made of it, JSON's lists included."""
        pairs = {name: tuple(values[name]) for name in ("low", "high", "zero")}
        return cls(**{**values, **pairs})

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the window, mm."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @property
    def placing(self) -> str:
        """What a person does with the stock before this position, in words."""
        if self.turned:
            return "turn the stock half round"
        axis = int(self.low[1] > 0)
        if not self.low[axis]:
            return "the stock lies as the panel is seen"
        return f"move the stock {self.low[axis]:g} mm {_BACK[axis]} where it lay at position 1"

    def holds(self, x: Floats, y: Floats) -> NDArray[np.bool_]:
        """Say which places a cutter's axis may be sent to."""
        (x0, y0), (x1, y1) = self.low, self.high
        inside: NDArray[np.bool_] = (x >= x0 + _INSET) & (x <= x1 - _INSET)
        return inside & (y >= y0 + _INSET) & (y <= y1 - _INSET)

    def overlap(self, other: "Position") -> tuple[Floats, Floats]:
        """Near left and far right corner of what both windows hold, panel mm."""
        return np.maximum(self.low, other.low), np.minimum(self.high, other.high)


def positions(
    stock: Stock,
    machine: Machine,
    cutters: Sequence[Cutter],
    way: Way,
    *,
    overlap: float,
    zero: tuple[float, float] = (0.0, 0.0),
) -> tuple[Position, ...]:
    """Choose the positions that a stock has to be cut in.

    Parameters
    ----------
    stock : Stock
    machine : Machine
    cutters : sequence of Cutter
    way : {'index', 'turn'}
        Moved along its longer side, by whole millimetres; or turned half round, once.
    overlap : float
        Of neighbouring windows, mm; for 'index' at least this.
    zero : tuple of float
        Where in each window work zero is, as the machine sees it: 0 to 1 from left to
        right and from near to far.

    Returns
    -------
    tuple of Position
        None where the machine reaches all of the stock.

    Raises
    ------
    InputError
        If no windows can do: the stock is too large both ways, longer than two reaches
        if it is turned, or a cutter is wider than the overlap.
    """
    if way not in get_args(Way):
        raise InputError("there is no such way", expected="index or turn", found=repr(way))
    size = stock.width, stock.height
    beyond = [axis for axis in (0, 1) if size[axis] > machine.travel[axis]]
    if not beyond:
        return ()
    axis = beyond[0]
    _check(size, machine, cutters, beyond, overlap)
    spans = (_indexed if way == "index" else _turned)(size[axis], machine, axis, overlap)
    found = []
    for k, (start, end) in enumerate(spans):
        low, high = [0.0, 0.0], list(size)
        low[axis], high[axis] = start, end
        turned = way == "turn" and k == 1
        at = [1 - part if turned else part for part in zero]
        x, y = (a + (b - a) * part for a, b, part in zip(low, high, at, strict=True))
        corners = (low[0], low[1]), (high[0], high[1])
        found.append(Position(k + 1, len(spans), *corners, (x, y), turned))
    return tuple(found)


def _check(
    size: tuple[float, float],
    machine: Machine,
    cutters: Sequence[Cutter],
    beyond: list[int],
    overlap: float,
) -> None:
    if len(beyond) > 1:
        raise InputError(
            f"the panel is too large both ways for the machine {machine.name}",
            expected=f"at most {machine.travel[0]:g} mm in X or {machine.travel[1]:g} mm in Y",
            found=f"{size[0]:g} x {size[1]:g} mm",
            hint="a smaller size, or another machine",
        )
    widest = max(cutters, key=lambda cutter: cutter.diameter)
    if overlap < widest.diameter:
        raise InputError(
            f"the cutter {widest.name} is wider than the positions' overlap",
            expected=f"{widest.diameter:g} mm or more",
            found=f"{overlap:g} mm",
            where="overlap",
        )
    if overlap + 1 > machine.travel[beyond[0]]:
        raise InputError(
            f"the positions' overlap leaves the machine {machine.name} no way to go on",
            expected=f"under {machine.travel[beyond[0]] - 1:g} mm",
            found=f"{overlap:g} mm",
            where="overlap",
        )


def _indexed(length: float, machine: Machine, axis: int, overlap: float) -> list[tuple[float, ...]]:
    """Part a length into the fewest windows, whole and even millimetres apart."""
    count = ceil((length - overlap) / floor(machine.travel[axis] - overlap))
    step = ceil((length - overlap) / count)
    return [(float(k * step), min(k * step + step + overlap, length)) for k in range(count)]


def _turned(length: float, machine: Machine, axis: int, overlap: float) -> list[tuple[float, ...]]:
    half = (length + overlap) / 2
    if half > machine.travel[axis]:
        raise InputError(
            f"half the panel is larger than the machine {machine.name} can reach",
            expected=f"at most {2 * machine.travel[axis] - overlap:g} mm in {'XY'[axis]}",
            found=f"{length:g} mm",
            hint="--positions index",
        )
    return [(0.0, half), (length - half, length)]
