"""The judgement of programs: what they would leave, beside what was wanted."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import pi

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.limits import Limits, travel_findings
from relieffab.gcode.missed import missed_patch
from relieffab.gcode.program import Program
from relieffab.gcode.read import read_program
from relieffab.gcode.simulate import Carved, simulate
from relieffab.grid import Grid
from relieffab.machine import Machine
from relieffab.relief.model import Relief
from relieffab.stock import Stock

Floats = NDArray[np.float64]

HALF_STEP = 0.0005  # mm, half of what a written coordinate can express
LEAST_WITHIN = 0.9  # share of the figure that has to be within the tolerance


@dataclass(frozen=True, eq=False)
class Verification:
    """What programs would do to the stock, judged against the relief.

    Parameters
    ----------
    gouge_mm : float
        Deepest cut below the relief, anywhere on the lattice: flat face too.
    excess_p99_mm : float
        99th percentile of what is left above the relief within the figure.
    within_tolerance : float
        Share of the figure's lattice nodes no further than `tolerance_mm` from
        the relief, up or down.
    tolerance_mm : float
    ok : bool
        Whether there are no findings.
    findings : tuple of str
        What is wrong, one sentence each.
    grid : Grid
        The lattice.
    deviation : (rows + 1, cols + 1) ndarray
        Carved height less the relief's at the lattice's nodes, mm; negative
        where too much is gone.  Read-only.
    """

    gouge_mm: float
    excess_p99_mm: float
    within_tolerance: float
    tolerance_mm: float
    ok: bool
    findings: tuple[str, ...]
    grid: Grid = field(repr=False)
    deviation: Floats = field(repr=False)

    def __post_init__(self) -> None:
        self.deviation.flags.writeable = False


def verify(
    programs: Sequence[Program | str],
    cutters: Sequence[Cutter],
    relief: Relief,
    stock: Stock,
    machine: Machine,
    *,
    tolerance: float = 0.1,
    gouge_limit: float = 0.02,
) -> Verification:
    """Run programs on a virtual stock and compare what is left with the relief.

    Heights are compared vertically, at the nodes of a lattice twice as fine as
    the relief's: there the triangulated relief is known without interpolation
    error, and a vertical distance is never less than the one along the wall's
    normal, so that it cannot hide a gouge.  On steep walls it overstates: half
    a written step of 0.001 mm sideways is 0.02 mm downwards at 88.5 degrees.
    What that half step explains is not called a gouge.

    Parameters
    ----------
    programs : sequence of Program or str
        In the order in which they run; texts are read first.
    cutters : sequence of Cutter
        One a program.
    relief : Relief
    stock : Stock
    machine : Machine
    tolerance : float
        Accepted difference, mm.
    gouge_limit : float
        Accepted gouge, mm.

    Raises
    ------
    InputError
        If a text is no program, or the relief has no figure.
    """
    if not programs:
        raise InputError("there is no program to verify")
    if not relief.mask.any():
        raise InputError("the relief has no figure to judge by")
    read = [
        read_program(program, name=f"program {k}") if isinstance(program, str) else program
        for k, program in enumerate(programs, 1)
    ]
    carved = simulate(read, cutters, relief.grid, stock)
    deviation = carved.heights - _wanted(carved.grid, relief)
    inside = deviation[figure_nodes(relief, carved.grid)]
    gouge, place = _gouge(carved, relief, deviation)
    within = float((np.abs(inside) <= tolerance).mean())
    findings = [
        text
        for program, cutter in zip(read, cutters, strict=True)
        for text in _motion(program, Limits(relief.depth, cutter, stock, machine))
    ]
    findings += _together(read, machine) + list(carved.bites)
    if gouge > gouge_limit:
        findings.append(f"gouges the relief by {gouge:.3f} mm at {place} on the panel")
    if within < LEAST_WITHIN:
        findings.append(f"only {within:.1%} of the figure is within {tolerance:g} mm of the relief")
    findings += _missed(carved.grid, relief, deviation, _finisher(read, cutters), tolerance)
    return Verification(
        gouge_mm=gouge,
        excess_p99_mm=max(0.0, float(np.percentile(inside, 99))),
        within_tolerance=within,
        tolerance_mm=tolerance,
        ok=not findings,
        findings=tuple(findings),
        grid=carved.grid,
        deviation=deviation,
    )


def figure_nodes(relief: Relief, grid: Grid) -> NDArray[np.bool_]:
    """Mark the lattice's nodes that lie on or at the edge of a pixel of the figure.

    Parameters
    ----------
    relief : Relief
    grid : Grid
        A lattice made from the relief's grid.

    Returns
    -------
    (rows + 1, cols + 1) ndarray of bool
    """
    refine = round(relief.grid.pitch / grid.pitch)
    top, left = (round(float(k)) for k in grid.to_index(*relief.grid.to_xy(0.0, 0.0)))
    pixels = np.kron(relief.mask, np.ones((refine, refine), bool))
    nodes = np.zeros(grid.node_shape, bool)
    rows, cols = pixels.shape
    for i in (0, 1):
        for j in (0, 1):
            nodes[top + i : top + i + rows, left + j : left + j + cols] |= pixels
    return nodes


def _wanted(grid: Grid, relief: Relief) -> Floats:
    """Give the relief's height at the lattice's nodes, a few rows at a time, mm."""
    x, y = grid.node_axes()
    bands = np.array_split(y, max(1, len(y) // 32))
    return np.concatenate([relief.height_at(x[None, :], band[:, None]) for band in bands])


def _gouge(carved: Carved, relief: Relief, deviation: Floats) -> tuple[float, str]:
    """Find the deepest gouge, mm, beyond what half a written step sideways explains."""
    rows, cols = np.nonzero(deviation < 0)
    if not len(rows):
        return 0.0, ""
    x, y = carved.grid.to_xy(rows.astype(float), cols.astype(float))
    sides = [(dx, dy) for dx in (-HALF_STEP, HALF_STEP) for dy in (-HALF_STEP, HALF_STEP)]
    around = [relief.height_at(x + dx, y + dy) for dx, dy in [(0.0, 0.0), *sides]]
    depth = np.min(around, axis=0) - carved.heights[rows, cols]
    worst = int(depth.argmax())
    return max(0.0, float(depth[worst])), f"X {x[worst]:.2f} Y {y[worst]:.2f}"


def _finisher(programs: Sequence[Program], cutters: Sequence[Cutter]) -> Cutter:
    """Pick the cutter that finishes the surface: the one that cuts the longest way."""
    lengths = [program.cutting_length for program in programs]
    return cutters[int(np.argmax(lengths))]


def _missed(
    grid: Grid, relief: Relief, deviation: Floats, cutter: Cutter, tolerance: float
) -> list[str]:
    """Report a patch larger than the cutter that it could have cut and did not."""
    refine = round(relief.grid.pitch / grid.pitch)
    top, left = (round(float(k)) for k in grid.to_index(*relief.grid.to_xy(0.0, 0.0)))
    rows, cols = relief.grid.node_shape
    excess = np.where(figure_nodes(relief, grid), deviation, 0.0)[top::refine, left::refine]
    area = missed_patch(relief, excess[:rows, :cols], cutter, tolerance)
    if area <= pi * cutter.radius**2:
        return []
    return [
        f"{cutter.name} left {area:.1f} mm² in one patch more than {tolerance:g} mm too high, "
        "though it could reach it"
    ]


def _motion(program: Program, limits: Limits) -> list[str]:
    """List what is wrong with a program's motion by itself."""
    points = program.on_panel(limits.stock)
    findings = list(limits.findings(points, program.feed, program.line))
    below = (points[:, 2] < 0) & ~program.rapid & (program.spindle <= 0)
    if below.any():
        line = program.line[below.argmax()]
        findings.append(f"cuts with the spindle off ({below.sum()} moves, first at line {line})")
    if program.blind_line:
        findings.append(f"moves sideways before it sets a height (line {program.blind_line})")
    return [f"{program.name}: {text}" for text in findings]


def _together(programs: Sequence[Program], machine: Machine) -> list[str]:
    """Check the travel of all programs from their one work zero."""
    if len(programs) < 2:
        return []
    corners = np.concatenate([program.bounds for program in programs])
    return [f"all programs: {text}" for text in travel_findings(corners, machine)]
