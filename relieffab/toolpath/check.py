"""What cannot be carved is refused before anything is planned."""

from collections.abc import Sequence

import numpy as np

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.machine import Machine
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

FINEST = 0.01  # mm, the closest rows that are no mistake


def check(
    relief: Relief,
    machine: Machine,
    cutters: Sequence[Cutter],
    stock: Stock,
    stepover: float,
    position: Position | None = None,
) -> None:
    """Refuse a job that these cutters, this machine or this stock cannot do.

    At a position the machine has to reach no more than its window.

    Raises
    ------
    InputError
        Saying what does not fit, and what would.
    """
    deepest = -float(relief.heights.min())
    if deepest < 1e-6:
        raise InputError(
            "there is nothing to cut: the relief is flat",
            hint="another view, or a larger depth",
        )
    _check_stock(relief, stock, deepest)
    _check_frame(relief, stock, cutters)
    check_tools(machine, cutters, stock, deepest, position)
    check_stepover(stepover, cutters[1])


def check_tools(
    machine: Machine,
    cutters: Sequence[Cutter],
    stock: Stock,
    depth: float,
    position: Position | None = None,
) -> None:
    """Refuse a machine or cutters that do not fit the stock, or its part, and the depth, mm.

    The depth is under Z0; flutes have to reach no further than under the face.
    """
    _check_travel(machine, position.size if position else (stock.width, stock.height), depth)
    for cutter in cutters:
        _check_cutter(cutter, stock, depth - stock.lowest(0.0))


def check_stepover(stepover: float, cutter: Cutter) -> None:
    """Refuse rows that do not move on, or that leave strips standing."""
    width = cutter.diameter if cutter.shape == "vee" else 2 * cutter.arc_end
    if not FINEST <= stepover <= width:
        raise InputError(
            f"the stepover cannot be {stepover:g} mm",
            expected=f"{FINEST} mm or more, at most the {width:.3g} mm the tip is wide",
            where=f"cutter {cutter.name}",
        )


def _check_stock(relief: Relief, stock: Stock, deepest: float) -> None:
    if deepest >= stock.thickness:
        raise InputError(
            "the relief would cut through the stock",
            expected=f"a depth under the thickness of {stock.thickness:g} mm",
            found=f"{deepest:g} mm",
            hint="a thicker stock or a smaller depth",
        )
    x, y = relief.grid.node_axes()
    slack = 1e-6 * max(stock.width, stock.height)
    if min(x[0], y[-1]) < -slack or x[-1] > stock.width + slack or y[0] > stock.height + slack:
        raise InputError(
            "the relief reaches beyond the stock",
            expected=f"X 0 to {stock.width:g}, Y 0 to {stock.height:g} mm",
            found=f"X {x[0]:g} to {x[-1]:g}, Y {y[-1]:g} to {y[0]:g} mm",
        )


def _check_frame(relief: Relief, stock: Stock, cutters: Sequence[Cutter]) -> None:
    """Refuse a cut that a cutter reaches only through a raised frame."""
    if stock.top == 0 or stock.frame is None:
        return
    widest = max(cutter.diameter for cutter in cutters)
    x, y = relief.grid.to_xy(*np.nonzero(relief.heights < 0))
    bad = ~stock.outline.inside(x, y, by=stock.frame.width + widest / 2)
    if bad.any():
        raise InputError(
            "a cutter would run into the raised frame",
            expected=f"half the widest cutter, {widest / 2:g} mm, between frame and cut",
            found=f"a cut at X {x[bad][0]:.2f} Y {y[bad][0]:.2f}",
            hint="a larger --margin, or narrower cutters",
        )


def _check_travel(machine: Machine, size: tuple[float, float], deepest: float) -> None:
    wanted = (*size, machine.safe_height + deepest)
    for axis, want, travel in zip("XYZ", wanted, machine.travel, strict=True):
        if want > travel:
            raise InputError(
                f"the panel is larger than the machine {machine.name} can reach",
                expected=f"at most {travel:g} mm in {axis}",
                found=f"{want:g} mm",
                hint="a smaller depth, or another machine"
                if axis == "Z"
                else "a smaller size, another machine, or a stock that is moved: "
                "--positions index or turn",
            )


def _check_cutter(cutter: Cutter, stock: Stock, deepest: float) -> None:
    if cutter.flute_length < deepest:
        raise InputError(
            f"the cutter {cutter.name} is too short for the relief",
            expected=f"a flute of at least {deepest:g} mm",
            found=f"{cutter.flute_length:g} mm",
            hint="a longer cutter or a smaller depth",
        )
    if cutter.diameter > min(stock.width, stock.height):
        raise InputError(
            f"the cutter {cutter.name} is larger than the panel",
            expected=f"at most {min(stock.width, stock.height):g} mm across",
            found=f"{cutter.diameter:g} mm",
        )
