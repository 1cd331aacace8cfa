"""What a program was made for: from the report beside it, its header, or what a person says."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.dialect import dialect
from relieffab.gcode.program import Program
from relieffab.gcode.read import read_program
from relieffab.job.certificate import program_names
from relieffab.job.folder import REPORT
from relieffab.job.proof import made_for
from relieffab.job.report import read_report
from relieffab.machine import Machine
from relieffab.stock import Stock

THICK = 3.0  # times the deepest cut: the stock of a program that does not tell it, mm


@dataclass(frozen=True)
class Run:
    """Programs in the order in which they cut a stock, the last one asked for last.

    Parameters
    ----------
    programs : tuple of Program
        One a cutter, as on the whole panel.
    cutters : tuple of Cutter
    asked : tuple of Program
        The file's own, as it is written: one a cutter.
    machine : Machine
    stock : Stock
    """

    programs: tuple[Program, ...]
    cutters: tuple[Cutter, ...]
    asked: tuple[Program, ...]
    machine: Machine
    stock: Stock


def run_of(path: Path, *, cutter: str | None = None, machine: str | None = None) -> Run:
    """Find all that it takes to run a program.

    Parameters
    ----------
    path : Path
    cutter, machine : str, optional
        Names of profiles, for programs that do not tell.

    Raises
    ------
    InputError
        If it is no program, or nothing tells its cutter.
    """
    if not path.is_file():
        raise InputError("there is no such program", where=str(path))
    folder = path.parent
    if cutter is None and machine is None and (folder / REPORT).is_file():
        report = read_report(folder)
        if path.name in [part["file"] for part in report.get("programs", [])]:
            return _of_job(report, folder, path.name)
    return _alone(path, cutter, machine)


def _of_job(report: Mapping[str, Any], folder: Path, name: str) -> Run:
    """Take the programs of a job up to the one asked for."""
    made = made_for(report, folder, float(report["relief"]["depth_mm"]))
    names = program_names(report)
    programs: list[Program] = []
    own: tuple[Program, ...] = ()
    for file in names[: names.index(name) + 1]:
        own = made.read(folder / file).by_tool()
        at = len(programs)
        lies = [made.setup.at(place).stock for place in made.positions[at : at + len(own)]]
        if len(lies) != len(own) or report["programs"][at]["file"] != file:
            raise InputError(
                "the program changes cutters otherwise than its job did", where=str(folder / file)
            )
        whole = made.setup.stock
        programs += [part.moved(here, whole) for part, here in zip(own, lies, strict=True)]
    cutters = made.cutters[: len(programs)]
    return Run(tuple(programs), cutters, own, made.setup.machine, made.setup.stock)


def _alone(path: Path, cutter: str | None, machine: str | None) -> Run:
    """Take a program by itself, on what its header tells of machine, stock and cutters."""
    text = path.read_text(encoding="latin-1")
    told = header(text)
    own = profiles.machine(machine or told.get("machine", "").split(",")[0] or "3018-prover")
    stock = _told_stock(told)
    if stock is None and re.search(r"^[^(;]*A-?[\d.]", text, re.MULTILINE):
        raise InputError(
            "the program turns a rotary axis, and does not tell the stock that it turns",
            expected="`stock: round, ...` at its head, as programs of this tool have it",
            where=str(path),
        )
    radius = stock.radius if stock else 0.0
    parts = read_program(
        text, name=path.name, dialect=dialect(own.dialect), radius=radius
    ).by_tool()
    cuts = any((part.points[:, 2] < 0).any() for part in parts)
    names = [told[key] for key in sorted(told) if key.startswith("cutter")]
    if not cuts and (stock is None or not names):
        raise InputError("the program cuts nothing: it never goes below Z0", where=str(path))
    names = [cutter] if cutter else names
    if len(names) != len(parts):
        raise InputError(
            "the program does not tell its cutter" if not names else "the cutters do not fit",
            expected=f"{len(parts)} cutters",
            found=f"{len(names)} told",
            where=str(path),
            hint="--cutter NAME, see `relieffab machines cutters`",
        )
    cutters = tuple(profiles.cutter(name.split(",")[0]) for name in names)
    return Run(parts, cutters, parts, own, stock or _stock_round(parts, cutters))


def header(text: str) -> dict[str, str]:
    """Read the comments at a program's head that tell of it, `name: value` each.

    Examples
    --------
    >>> header("(cutter: flat-6, flat 6 mm)")
    {'cutter': 'flat-6, flat 6 mm'}
    """
    told: dict[str, str] = {}
    for line in text.splitlines():
        if not line.startswith(("(", ";")):
            break
        name, found, value = line.strip("(); ").partition(": ")
        if found:
            told.setdefault(name, value)
    return told


def _told_stock(told: Mapping[str, str]) -> Stock | None:
    zero = re.match(r"X ([-\d.]+) Y ([-\d.]+) mm .*Z ([-\d.]+) mm", told.get("work zero", ""))
    size = re.fullmatch(r"([\d.]+) x ([\d.]+) x ([\d.]+) mm", told.get("stock", ""))
    turned = re.match(r"round, ([\d.]+) mm thick, ([\d.]+) mm along X", told.get("stock", ""))
    if zero is None:
        return None
    x, y, z = map(float, zero.groups())
    if turned is not None:
        # How far round its figure goes is not told: the whole face is.
        radius, length = float(turned[1]) / 2, float(turned[2])
        return Stock(length, 2 * pi * radius, radius, (x, y, z), radius=radius)
    if size is None:
        return None
    width, height, thickness = map(float, size.groups())
    half = told.get("placing", "").startswith("turn")
    return Stock(width, height, thickness, (x, y, z), turned=half)


def _stock_round(parts: tuple[Program, ...], cutters: tuple[Cutter, ...]) -> Stock:
    """Put a stock round work zero and all that lies below it."""
    low = np.concatenate([[[0.0, 0.0, 0.0]], *(p.points[p.points[:, 2] < 0] for p in parts)])
    margin = 1.5 * max(cutter.diameter for cutter in cutters)
    start = np.where(low[:, :2].min(axis=0) < 0, low[:, :2].min(axis=0) - margin, 0.0)
    width, height = low[:, :2].max(axis=0) + margin - start
    thick = max(THICK * -float(low[:, 2].min()), 1.0)
    return Stock(float(width), float(height), thick, (-float(start[0]), -float(start[1]), 0.0))
