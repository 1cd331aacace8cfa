"""The judgement of programs: what they would leave, beside what was wanted."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import pi

import numpy as np
from numpy.typing import NDArray

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.gouge import deepest_gouge
from relieffab.gcode.limits import Limits, travel_findings
from relieffab.gcode.missed import missed_patch
from relieffab.gcode.program import Program
from relieffab.gcode.read import read_program
from relieffab.gcode.seams import Seam, seam_findings, seams_of
from relieffab.gcode.setup import Setup
from relieffab.gcode.simulate import simulate
from relieffab.grid import Grid
from relieffab.machine import Machine
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief, sunk_pixels
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

REFINE, LARGE = 4, 4_000_000
"""Lattice nodes a pixel, half of that for reliefs of more pixels than `LARGE`."""

AIR = 1e-3  # mm of material, below which a move cuts nothing
LEAST_WITHIN = 0.9  # share of the figure that has to be within the tolerance


@dataclass(frozen=True, eq=False)
class Verification:
    """What programs would do to the stock, judged against the relief.

    Parameters
    ----------
    gouge_mm : float
        Deepest cut into the relief, square to it, anywhere: flat face too.
    excess_p99_mm : float
        99th percentile of what is left above the relief within the figure and on marks
        beside it.
    within_tolerance : float
        Share of the lattice nodes there no further than `tolerance_mm` from
        the relief, up or down.
    tolerance_mm : float
    air_cutting : float
        Share of the length of moves at a feed that cuts nothing.
    ok : bool
        Whether there are no findings.
    findings : tuple of str
        What is wrong, one sentence each.
    grid : Grid
        The lattice.
    figure : (rows + 1, cols + 1) ndarray of bool
        Nodes of the lattice on the figure and on marks beside it, as of a pecked ground.
    deviation : (rows + 1, cols + 1) ndarray of float32
        Carved height less the relief's at the lattice's nodes, mm; negative
        where too much is gone.  Read-only.
    carved : (rows + 1, cols + 1) ndarray of float32
        What is left of the stock at the lattice's nodes, mm.  Read-only.
    seams : tuple of Seam
        Where the parts of a panel meet that is cut at several positions.
    """

    gouge_mm: float
    excess_p99_mm: float
    within_tolerance: float
    tolerance_mm: float
    air_cutting: float
    ok: bool
    findings: tuple[str, ...]
    grid: Grid = field(repr=False)
    figure: NDArray[np.bool_] = field(repr=False)
    deviation: Singles = field(repr=False)
    carved: Singles = field(repr=False)
    seams: tuple[Seam, ...] = ()

    def __post_init__(self) -> None:
        self.deviation.flags.writeable = False


def verify(
    programs: Sequence[Program | str],
    cutters: Sequence[Cutter],
    relief: Relief,
    setup: Setup,
    *,
    positions: Sequence[Position | None] = (),
    tolerance: float = 0.1,
    gouge_limit: float = 0.005,
    refine: int | None = None,
    progress: Progress = silent,
) -> Verification:
    """Run programs on a virtual stock and compare what is left with the relief.

    Heights are compared at the nodes of a lattice four times as fine as the
    relief's, where the triangulated relief is known without interpolation error.
    Excess is vertical, a gouge is square to the surface.  The depth of each pass is
    asked at the relief's own nodes: what stands between them, thinner than a pixel,
    is no load on a cutter.

    On a round stock the lattice lies on its face, and heights are radii less the face's.
    Ways round are measured there, where they are longest: no gouge seems less than it is.

    Parameters
    ----------
    programs : sequence of Program or str
        In the order in which they run; texts are read first.
    cutters : sequence of Cutter
        One a program; a program that changes cutters counts once for each.
    relief : Relief
    setup : Setup
        Machine, material and stock.
    positions : sequence of Position or None, optional
        One a program, as cutters are, where the stock is moved between them.
    tolerance : float
        Accepted difference, mm.
    gouge_limit : float
        Accepted gouge, mm.
    refine : int, optional
        Lattice nodes a pixel; four, or two for a relief of more than 4 million pixels.
    progress : Progress
        Told of mm run.

    Raises
    ------
    InputError
        If a text is no program, or the relief has no figure.
    """
    if not programs:
        raise InputError("there is no program to verify")
    if not relief.mask.any():
        raise InputError("the relief has no figure to judge by")
    if refine is None:
        refine = REFINE if relief.mask.size <= LARGE else REFINE // 2
    read = [part for program in _read(programs, setup) for part in program.by_tool()]
    setups = [setup.at(position) for position in positions or [None] * len(read)]
    read = [
        program.moved(its.stock, setup.stock) for program, its in zip(read, setups, strict=True)
    ]
    carved = simulate(read, cutters, relief.grid, setup.stock, refine=refine, progress=progress)
    coarse = simulate(read, cutters, relief.grid, setup.stock, refine=1)
    deviation = carved.heights - _wanted(carved.grid, relief, setup.stock)
    figure = figure_nodes(relief, carved.grid, setup.stock)
    inside = deviation[figure]
    gouge, x, y = deepest_gouge(relief, carved.grid, carved.heights, deviation)
    within = float((np.abs(inside) <= tolerance).mean())
    findings = [
        text
        for program, cutter, its, bites in zip(read, cutters, setups, coarse.bites, strict=True)
        for text in _motion(program, setup.stock, its.limits(cutter), bites)
    ]
    for position in dict.fromkeys(its.position for its in setups):
        fixed = [p for p, its in zip(read, setups, strict=True) if its.position == position]
        findings += _together(fixed, setup.machine)
    findings += carved.crashes
    if gouge > gouge_limit:
        findings.append(f"gouges the relief by {gouge:.3f} mm at X {x:.2f} Y {y:.2f} on the panel")
    if within < LEAST_WITHIN:
        findings.append(f"only {within:.1%} of the figure is within {tolerance:g} mm of the relief")
    places = [its.position for its in setups if its.position]
    seams = seams_of(places, cutters, carved.grid, np.where(figure, deviation, np.nan), tolerance)
    findings += seam_findings(seams, tolerance, LEAST_WITHIN)
    finisher, radius = _finisher(read, cutters), setup.stock.radius
    within_figure = np.where(figure, deviation, 0.0)
    findings += _missed(carved.grid, relief, within_figure, finisher, tolerance, radius)
    return Verification(
        gouge_mm=gouge,
        excess_p99_mm=max(0.0, float(np.percentile(inside, 99))),
        within_tolerance=within,
        tolerance_mm=tolerance,
        air_cutting=air_cutting(read, carved.bites),
        ok=not findings,
        findings=tuple(findings),
        grid=carved.grid,
        figure=figure,
        deviation=deviation,
        carved=carved.heights,
        seams=seams,
    )


def _read(programs: Sequence[Program | str], setup: Setup) -> list[Program]:
    dialect, radius = setup.post.dialect, setup.stock.radius
    return [
        read_program(program, name=f"program {k}", dialect=dialect, radius=radius)
        if isinstance(program, str)
        else program
        for k, program in enumerate(programs, 1)
    ]


def air_cutting(programs: Sequence[Program], bites: Sequence[Floats]) -> float:
    """Measure how much of the way at a feed takes no material.

    Parameters
    ----------
    programs : sequence of Program
    bites : sequence of (n,) ndarray
        Deepest bite of every move, mm.

    Returns
    -------
    float
        Share of the length, 0 to 1.
    """
    total = sum(program.cutting_length for program in programs)
    idle = sum(
        float(program.lengths[~program.rapid & (deepest < AIR)].sum())
        for program, deepest in zip(programs, bites, strict=True)
    )
    return idle / total if total else 0.0


def figure_nodes(relief: Relief, grid: Grid, stock: Stock) -> NDArray[np.bool_]:
    """Mark the lattice's nodes that lie on or at the edge of a pixel of figure or marks.

    Parameters
    ----------
    relief : Relief
    grid : Grid
        A lattice made from the relief's grid.
    stock : Stock
        As it lies on the machine: what is under its face is to be cut.

    Returns
    -------
    (rows + 1, cols + 1) ndarray of bool
    """
    refine = round(relief.grid.pitch / grid.pitch)
    top, left = (round(float(k)) for k in grid.to_index(*relief.grid.to_xy(0.0, 0.0)))
    face = stock.face(relief.grid.node_axes()[0])
    sunk = sunk_pixels(relief.heights - face, relief.mask)
    pixels = np.kron(sunk, np.ones((refine, refine), bool))
    nodes = np.zeros(grid.node_shape, bool)
    rows, cols = pixels.shape
    for i in (0, 1):
        for j in (0, 1):
            nodes[top + i : top + i + rows, left + j : left + j + cols] |= pixels
    return nodes


def _wanted(grid: Grid, relief: Relief, stock: Stock) -> Singles:
    """Give the relief's height at the lattice's nodes, a few rows at a time, mm.

    Beyond the relief the stock's face goes on.
    """
    x, y = grid.node_axes()
    face = stock.face(x)
    bands = np.array_split(y, max(1, len(y) // 32))
    return np.concatenate(
        [
            np.minimum(relief.height_at(x[None, :], band[:, None]), face).astype(np.float32)
            for band in bands
        ]
    )


def _finisher(programs: Sequence[Program], cutters: Sequence[Cutter]) -> Cutter:
    """Pick the cutter that finishes the surface: the one that cuts the longest way."""
    lengths = [program.cutting_length for program in programs]
    return cutters[int(np.argmax(lengths))]


def _missed(
    grid: Grid,
    relief: Relief,
    deviation: Singles,
    cutter: Cutter,
    tolerance: float,
    radius: float,
) -> list[str]:
    """Report a patch larger than the cutter that it could have cut and did not.

    The deviation is 0 but where something is to be cut.
    """
    refine = round(relief.grid.pitch / grid.pitch)
    top, left = (round(float(k)) for k in grid.to_index(*relief.grid.to_xy(0.0, 0.0)))
    rows, cols = relief.grid.node_shape
    excess = deviation[top::refine, left::refine].astype(float)
    area = missed_patch(relief, excess[:rows, :cols], cutter, tolerance, radius)
    if area <= pi * cutter.radius**2:
        return []
    return [
        f"{cutter.name} left {area:.1f} mm² in one patch more than {tolerance:g} mm too high, "
        "though it could reach it"
    ]


def _motion(program: Program, stock: Stock, limits: Limits, bites: Floats) -> list[str]:
    """List what is wrong with a program's motion by itself."""
    points = program.on_panel(stock)
    findings = list(limits.findings(points, program.feed, bites, program.line))
    below = (points[:, 2] < 0) & ~program.rapid & (program.spindle <= 0)
    if below.any():
        line = program.line[below.argmax()]
        findings.append(f"cuts with the spindle off ({below.sum()} moves, first at line {line})")
    if program.blind_line:
        findings.append(f"moves sideways before it sets a height (line {program.blind_line})")
    return [f"{program.name}: {text}" for text in findings]


def _together(programs: Sequence[Program], machine: Machine) -> list[str]:
    """Check the travel of programs from one work zero."""
    if len(programs) < 2:
        return []
    corners = np.concatenate([program.bounds for program in programs])
    return [f"all programs: {text}" for text in travel_findings(corners, machine)]
