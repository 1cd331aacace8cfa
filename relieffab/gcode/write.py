"""A toolpath as text: G-code of the Grbl 1.1 dialect, plain enough for any other."""

import textwrap
import unicodedata
from collections.abc import Iterator, Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from relieffab import __version__
from relieffab.errors import FindingsError, InputError
from relieffab.gcode.estimate import motion_seconds
from relieffab.gcode.limits import Limits
from relieffab.machine import Machine
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

PER_MM = 1000  # steps of a written coordinate
LINE_LENGTH = 79  # characters Grbl takes in a line
SPIN_UP = 4.0  # seconds


def write_program(
    toolpath: Toolpath,
    machine: Machine,
    stock: Stock,
    *,
    depth: float,
    header: Mapping[str, str] | None = None,
) -> str:
    """Write a toolpath as a program that starts, runs and ends by itself.

    Absolute millimetres from the stock's work zero, to 0.001 mm: X and Y to
    the nearest step, Z to the next one up, so that rounding never cuts deeper.
    Moves shorter than a step are left out.

    Parameters
    ----------
    toolpath : Toolpath
    machine : Machine
    stock : Stock
    depth : float
        Of the relief, positive, mm: no move goes below it.
    header : mapping of str to str, optional
        Settings to put into comments at the head.

    Returns
    -------
    str
        ASCII, lines of at most 79 characters.

    Raises
    ------
    FindingsError
        If the motion breaks a limit of depth, flutes, stock, travel or feed;
        nothing is written then.
    """
    steps, feed = _steps(toolpath, machine, stock)
    panel = steps / PER_MM + np.asarray(stock.work_zero)
    _guard(toolpath, Limits(depth, toolpath.cutter, stock, machine), panel, feed)
    seconds = motion_seconds(panel, feed, machine) + SPIN_UP
    lines = [
        *_comments(toolpath, panel, machine, seconds, header or {}),
        "G21 G90 G17 G94 G54",
        f"G0 Z{number(int(steps[0, 2]))}",
        f"M3 S{_spindle(toolpath, machine)}",
        f"G4 P{SPIN_UP:g}",
        f"G0 X{number(int(steps[0, 0]))} Y{number(int(steps[0, 1]))}",
        *_moves(steps, feed),
        "M5",
        "M30",
    ]
    return "\n".join(lines) + "\n"


def _steps(toolpath: Toolpath, machine: Machine, stock: Stock) -> tuple[Ints, Floats]:
    """Round to written steps, and add the way in and out at the safe height."""
    scaled = (toolpath.points - np.asarray(stock.work_zero)) * PER_MM
    steps = np.rint(scaled).astype(np.int64)
    steps[:, 2] = np.ceil(scaled[:, 2] - 1e-6).astype(np.int64)
    safe = int(np.ceil((machine.safe_height - stock.work_zero[2]) * PER_MM - 1e-6))
    ends = steps[[0, -1]]
    ends[:, 2] = np.maximum(ends[:, 2], safe)
    steps = np.concatenate([ends[:1], steps, ends[1:]])
    feed = np.concatenate([[np.inf], toolpath.feed, [np.inf]])
    moved = np.concatenate([[True], (np.diff(steps, axis=0) != 0).any(axis=1)])
    return steps[moved], np.floor(feed[moved] * 10 + 1e-6) / 10


def _guard(toolpath: Toolpath, limits: Limits, points: Floats, feed: Floats) -> None:
    where = f"toolpath {toolpath.name}"
    if not feed.min() > 0:
        raise InputError("a feed is too slow to write", expected="0.1 mm/min or more", where=where)
    findings = limits.findings(points, feed)
    if findings:
        raise FindingsError(
            "the toolpath breaks a limit; no program was written",
            found="; ".join(findings),
            where=where,
        )


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


@lru_cache(maxsize=1 << 17)
def number(steps: int) -> str:
    """Write thousandths of a mm as mm, in as few characters as it takes.

    Examples
    --------
    >>> number(12500), number(-4), number(0)
    ('12.5', '-0.004', '0')
    """
    sign = "-" if steps < 0 else ""
    whole, part = divmod(abs(steps), PER_MM)
    return f"{sign}{whole}.{part:03d}".rstrip("0").rstrip(".")


def _moves(steps: Ints, feed: Floats) -> Iterator[str]:
    """Write every move but the first; each word only where it changes."""
    x, y, z = steps[0].tolist()
    mode, rate = "G0", np.inf
    for (to_x, to_y, to_z), to_rate in zip(steps[1:].tolist(), feed[1:].tolist(), strict=True):
        line = ""
        to_mode = "G0" if to_rate == np.inf else "G1"
        if to_mode != mode:
            line = mode = to_mode
        if to_x != x:
            line += "X" + number(to_x)
        if to_y != y:
            line += "Y" + number(to_y)
        if to_z != z:
            line += "Z" + number(to_z)
        if mode == "G1" and to_rate != rate:
            line += f"F{to_rate:.1f}".removesuffix(".0")
            rate = to_rate
        x, y, z = to_x, to_y, to_z
        yield line


def _comments(
    toolpath: Toolpath,
    points: Floats,
    machine: Machine,
    seconds: float,
    header: Mapping[str, str],
) -> Iterator[str]:
    """Say at the head what the program is, in comments no controller acts on."""
    cutter = toolpath.cutter
    low, high = points.min(axis=0), points.max(axis=0)
    bounds = "  ".join(
        f"{axis} {a:.3f} to {b:.3f}" for axis, a, b in zip("XYZ", low, high, strict=True)
    )
    facts = {
        "relieffab": __version__,
        "program": toolpath.name,
        "cutter": f"{cutter.name}, {cutter.shape} {cutter.diameter:g} mm",
        "spindle": f"{toolpath.rpm:g} rpm",
        "machine": machine.name,
        "bounds on the panel, mm": bounds,
        "time": f"{int(seconds // 60)} min {int(seconds % 60)} s",
    }
    for name, value in [*facts.items(), *header.items()]:
        for part in textwrap.wrap(harmless(f"{name}: {value}"), LINE_LENGTH - 2):
            yield f"({part})"


def harmless(text: str) -> str:
    """Bring a comment down to bytes no controller acts on.

    Grbl obeys `!`, `~`, `?` and every byte from 0x80 wherever they stand, and
    a comment ends at its first closing parenthesis.

    Examples
    --------
    >>> harmless("Säge (schnell!)")
    'Sage schnell'
    """
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    return "".join(c for c in plain if " " <= c <= "}" and c not in "!?()$%;")
