"""A virtual stock: what is left of it once programs have run."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.program import Program
from relieffab.gcode.slab import Slab, lattice
from relieffab.grid import Grid
from relieffab.progress import Progress, silent
from relieffab.stock import Stock

Floats = NDArray[np.float64]

TOUCH = 1e-3  # mm a rapid or a shank may bite, for the arithmetic of the text


@dataclass(frozen=True, eq=False)
class Carved:
    """What is left of a stock; arrays are read-only.

    Parameters
    ----------
    grid : Grid
        A lattice `refine` times as fine as the relief's, every node of which
        that lies on the relief's grid is one of its nodes or between two.
    heights : (rows + 1, cols + 1) ndarray of float32
        Of what is left, at the lattice's nodes, mm; 0 is the untouched face.
    bites : tuple of (n,) ndarray
        For each program, the deepest bite of every move, mm.
    crashes : tuple of str
        Rapids and shanks that went through material, in words.
    """

    grid: Grid
    heights: NDArray[np.float32]
    bites: tuple[Floats, ...]
    crashes: tuple[str, ...]

    def __post_init__(self) -> None:
        self.heights.flags.writeable = False


def simulate(
    programs: Sequence[Program],
    cutters: Sequence[Cutter],
    grid: Grid,
    stock: Stock,
    *,
    refine: int = 2,
    progress: Progress = silent,
) -> Carved:
    """Carve a stock by programs, one after the other, each with its cutter.

    Rapids cut like any move.  The lattice covers the relief's grid and whatever
    else of the stock the programs cut.

    Parameters
    ----------
    programs : sequence of Program
    cutters : sequence of Cutter
        One a program.
    grid : Grid
        The relief's.
    stock : Stock
    refine : int
        Lattice nodes a pixel of the relief.
    progress : Progress
        Told of mm run.
    """
    if len(programs) != len(cutters):
        raise InputError(
            "each program needs its cutter",
            expected=f"{len(programs)} cutters",
            found=f"{len(cutters)}",
        )
    paths = [program.on_panel(stock) for program in programs]
    slab = Slab.over(lattice(grid, refine, _cut_box(paths, cutters, grid, stock)), stock)
    every, crashes = [], []
    for program, cutter, points in zip(programs, cutters, paths, strict=True):
        crashes += _rubs(slab, program, cutter, points)
        bites = slab.cut(points, cutter, progress)
        every.append(bites)
        crashes += _told(program, np.where(program.rapid, bites, 0.0), "a rapid goes through")
    return Carved(slab.grid, slab.heights, tuple(every), tuple(crashes))


def _rubs(slab: Slab, program: Program, cutter: Cutter, points: Floats) -> list[str]:
    """Find where the shank, which does not cut, would be pressed into what is left.

    It begins where the flutes end.  The cutter goes first: what it takes away is no
    longer in the shank's way.
    """
    shank = points + np.array([0.0, 0.0, cutter.flute_length])
    if not (shank[:, 2] < -TOUCH).any():
        return []
    left = slab.copy()
    left.cut(points, cutter)
    width = 2 * cutter.shank_radius
    plain = Cutter("shank", "flat", width, cutter.flute_length, 1.0, 1.0, 1.0, 1.0)
    return _told(program, left.cut(shank, plain), f"the shank of {cutter.name} rubs through")


def _told(program: Program, bites: Floats, words: str) -> list[str]:
    worst = int(bites.argmax())
    if bites[worst] <= TOUCH:
        return []
    return [f"{program.name} line {program.line[worst]}: {words} {bites[worst]:.3f} mm of material"]


def _cut_box(
    paths: Sequence[Floats], cutters: Sequence[Cutter], grid: Grid, stock: Stock
) -> Floats:
    """Least and greatest X and Y of the stock that some move below the face may reach."""
    left_top, right_bottom = grid.to_xy(0.0, 0.0), grid.to_xy(grid.rows, grid.cols)
    boxes = [np.array([left_top, right_bottom])]
    for points, cutter in zip(paths, cutters, strict=True):
        low = points[:, 2] < 0
        low[:-1] |= low[1:]
        low[1:] |= points[:-1, 2] < 0
        if low.any():
            xy = points[low, :2]
            boxes.append(np.array([xy.min(axis=0) - cutter.radius, xy.max(axis=0) + cutter.radius]))
    every = np.concatenate(boxes)
    return np.clip([every.min(axis=0), every.max(axis=0)], 0.0, [stock.width, stock.height])
