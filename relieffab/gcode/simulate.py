"""A virtual stock: what is left of it once programs have run."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.program import Program
from relieffab.gcode.sweep import BAND_ROWS, profile_numbers, sweep
from relieffab.grid import Grid
from relieffab.progress import Progress, silent
from relieffab.stock import Stock

Floats = NDArray[np.float64]

CHUNK = 25_000  # moves between two words of progress
TOUCH = 1e-3  # mm a rapid may bite, for the arithmetic of the text


@dataclass(frozen=True, eq=False)
class Carved:
    """What is left of a stock; arrays are read-only.

    Parameters
    ----------
    grid : Grid
        A lattice `refine` times as fine as the relief's, every node of which
        that lies on the relief's grid is one of its nodes or between two.
    heights : (rows + 1, cols + 1) ndarray
        Of what is left, at the lattice's nodes, mm; 0 is the untouched face.
    bites : tuple of str
        Rapids that went through material, in words.
    """

    grid: Grid
    heights: Floats
    bites: tuple[str, ...]

    def __post_init__(self) -> None:
        self.heights.flags.writeable = False


def lattice(grid: Grid, refine: int, box: Floats) -> Grid:
    """Refine a grid, and grow it by whole pixels until it holds a box.

    Parameters
    ----------
    grid : Grid
    refine : int
        Lattice nodes a pixel.
    box : (2, 2) ndarray
        Least and greatest X and Y to hold, panel mm.
    """
    if refine < 1:
        raise InputError("the lattice cannot be coarser than the relief", found=f"refine {refine}")
    top, left = grid.to_index(box[0, 0], box[1, 1])
    bottom, right = grid.to_index(box[1, 0], box[0, 1])
    up, west = max(0, ceil(-top - 1e-9)), max(0, ceil(-left - 1e-9))
    down = max(0, ceil(bottom - grid.rows - 1e-9))
    east = max(0, ceil(right - grid.cols - 1e-9))
    origin = grid.to_xy(-float(up), -float(west))
    rows, cols = grid.rows + up + down, grid.cols + west + east
    return Grid(rows * refine, cols * refine, grid.pitch / refine, origin)


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

    At each node the cutter's exact surface is followed along every move, rapids
    included, so the result is exact there up to 1e-6 mm.  The lattice covers
    the relief's grid and whatever else of the stock the programs cut.  A
    cutter's shank is no wider than its flutes and meets the stock only where
    the tip is deeper than the flutes are long, which `Limits` forbids.

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
    fine = lattice(grid, refine, _cut_box(paths, cutters, grid, stock))
    heights = np.zeros(fine.node_shape)
    total = sum(float(program.lengths.sum()) for program in programs)
    done, bites = 0.0, []
    for program, cutter, points in zip(programs, cutters, paths, strict=True):
        worst, move = 0.0, 0
        for start in range(0, len(points), CHUNK):
            stop = min(start + CHUNK, len(points))
            bite, k = _carve(heights, fine, cutter, points, program.rapid, (start, stop))
            if bite > worst:
                worst, move = bite, k
            done += float(program.lengths[start:stop].sum())
            progress("carving", done, total, "mm")
        if worst > TOUCH:
            bites.append(
                f"{program.name} line {program.line[move]}: "
                f"a rapid goes through {worst:.3f} mm of material"
            )
    return Carved(fine, heights, tuple(bites))


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


def _carve(
    heights: Floats,
    fine: Grid,
    cutter: Cutter,
    points: Floats,
    rapid: NDArray[np.bool_],
    moves: tuple[int, int],
) -> tuple[float, int]:
    """Make some moves of a path; give the deepest bite of a rapid, mm, and its move."""
    start, stop = moves
    before = points[max(start - 1, 0) : max(start, 1)]
    run = np.concatenate([before, points[start:stop]])
    local = np.column_stack([run[:, 0] - fine.origin[0], fine.origin[1] - run[:, 1], run[:, 2]])
    fast = np.concatenate([[False], rapid[start:stop]])
    bands = -(-heights.shape[0] // BAND_ROWS)
    # Scattered, so that threads with a share of them each have as much to do.
    order = np.argsort(np.arange(bands) * 0.6180339887498949 % 1.0)
    bites = sweep(heights, local, fast, profile_numbers(cutter), fine.pitch, order)
    worst = bites[bites[:, 0].argmax()]
    return float(worst[0]), start + int(worst[1]) - 1
