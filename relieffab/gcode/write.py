"""Toolpaths as text: one program for a machine, read back and judged before it is given out."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from relieffab.errors import FindingsError, InputError
from relieffab.gcode.header import comments
from relieffab.gcode.moves import lines, moves_of
from relieffab.gcode.program import Program
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.machine import Machine
from relieffab.toolpath.path import Toolpath

SPIN_UP = 4.0  # seconds


def write_program(
    paths: Toolpath | Sequence[Toolpath],
    setup: Setup,
    slab: Slab,
    *,
    header: Mapping[str, str] | None = None,
) -> str:
    """Write toolpaths as a program that starts, runs and ends by itself.

    Absolute coordinates from the stock's work zero; X and Y to the nearest step,
    Z to the next one up, so that rounding never cuts deeper.  Several toolpaths
    become one program with a change of cutter (M6) before each.

    Parameters
    ----------
    paths : Toolpath or sequence of Toolpath
    setup : Setup
        Machine, material, stock and depth: what sets the limits.
    slab : Slab
        The stock as the programs before this one leave it: no pass may take more
        of it than the cutter's stepdown.  It is cut by the program.
    header : mapping of str to str, optional
        Facts to put into comments at the head, after the program's own.

    Returns
    -------
    str
        ASCII, in lines no longer than the dialect takes.

    Raises
    ------
    InputError
        If the dialect cannot say what is asked, or the spindle cannot turn so.
    FindingsError
        If the motion, read back from the text, breaks a limit of depth, pass, flutes,
        stock, travel or feed; the slab is as it was then.
    """
    several = [paths] if isinstance(paths, Toolpath) else list(paths)
    _check(several, setup)
    body = list(_body(several, setup))
    program = _read(body, setup)
    _guard(several, program, setup, slab)
    head = comments(several, program, setup, header or {})
    return "\n".join([*head, *body]) + "\n"


def foretold(path: Toolpath, setup: Setup) -> Program:
    """Read a toolpath as it would be written, limits aside."""
    _check([path], setup)
    return _read(_body([path], setup), setup)


def _read(body: Iterable[str], setup: Setup) -> Program:
    return read_program("\n".join(body), dialect=setup.post.dialect, radius=setup.stock.radius)


def check_change(cutters: int, setup: Setup) -> None:
    """Refuse several cutters in one program where the controller changes none."""
    dialect = setup.post.dialect
    if cutters > 1 and "M6" not in dialect.codes:
        raise InputError(
            f"{dialect.title} changes no cutters within a program",
            expected="one program a cutter",
            found=f"{cutters} cutters",
            where=f"machine {setup.machine.name}",
            hint="--cutter-change files",
        )


def _check(paths: Sequence[Toolpath], setup: Setup) -> None:
    if not paths:
        raise InputError("there is no toolpath to write", expected="one or more")
    check_change(len(paths), setup)
    for path in paths:
        slowest = path.feed.min()
        if slowest < np.inf and float(setup.post.feed(slowest)) <= 0:
            raise InputError(
                "a feed is too slow to write",
                expected="0.1 mm/min or more",
                where=f"toolpath {path.name}",
            )


def _body(paths: Sequence[Toolpath], setup: Setup) -> Iterator[str]:
    """Write all lines but the comments."""
    post, machine = setup.post, setup.machine
    first, *rest = post.dialect.start or ("",)
    yield f"{post.units_word} G90 {first}".rstrip()
    for line in rest:
        yield line.format(blend=post.blend())
    if post.turns:
        yield "G93"
    for number, path in enumerate(paths, 1):
        moves = moves_of(path, machine, setup.stock, post)
        x, y, z = moves.steps[0].tolist()
        if len(paths) > 1:
            yield f"M6 T{number}"
            if "G43" in post.dialect.codes:
                yield f"G43 H{number}"
        rapid = ("", "")
        if post.dialect.rapid_feed:
            rates = machine.max_rate[2], min(machine.max_rate[:2])
            rapid = f" F{post.feed(rates[0])}", f" F{post.feed(rates[1])}"
        yield f"G0 Z{post.number(z)}{rapid[0]}"
        yield f"M3 S{_spindle(path, machine)}"
        yield f"G4 P{SPIN_UP * post.dialect.dwell:g}"
        yield f"G0 X{post.number(x)} {post.across(y)}{rapid[1]}"
        yield from lines(moves, post, machine)
        yield "M5"
    if post.turns:
        yield "G94"
    yield post.dialect.end


def _spindle(toolpath: Toolpath, machine: Machine) -> int:
    """Scale the true speed to the controller's own setting, $30."""
    slow, fast = machine.spindle
    if not slow <= toolpath.rpm <= fast * (1 + 1e-9) or fast <= 0:
        raise InputError(
            "the spindle cannot turn that fast or slowly",
            expected=f"{slow:g} to {fast:g} rpm on {machine.name}",
            found=f"{toolpath.rpm:g} rpm",
            where=f"toolpath {toolpath.name}",
        )
    return max(1, round(toolpath.rpm / fast * machine.spindle_max_setting))


def _guard(paths: Sequence[Toolpath], program: Program, setup: Setup, slab: Slab) -> None:
    """Refuse what breaks a limit; else let the slab be cut."""
    trial = slab.copy()
    for path, part in zip(paths, program.by_tool(), strict=True):
        points = part.on_panel(setup.stock)
        bites = trial.cut(points, path.cutter)
        findings = setup.limits(path.cutter).findings(points, part.feed, bites)
        if findings:
            raise FindingsError(
                "the toolpath breaks a limit; no program was written",
                found="; ".join(findings),
                where=f"toolpath {path.name}",
            )
    np.copyto(slab.heights, trial.heights)
