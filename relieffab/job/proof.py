"""Proof: programs judged from their files, with all that a person or `send` may check it by."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from relieffab.cutter import Cutter
from relieffab.errors import FindingsError, InputError
from relieffab.gcode.program import Program
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.verify import Verification, verify
from relieffab.grid import Grid
from relieffab.job.certificate import RELIEF, file_hash, program_names
from relieffab.job.report import read_report
from relieffab.job.settings import Job
from relieffab.layers.shading import light_at
from relieffab.machine import Machine, Material, Rotary, Use
from relieffab.picture import deviation_map, png8, predicted_look
from relieffab.progress import Progress, silent
from relieffab.relief.laid import laid, upright
from relieffab.relief.model import Relief
from relieffab.relief.store import read_relief
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

Part = dict[str, Any]

DEVIATION, LOOK = "deviation.png", "look.png"
WIDEST = 2048  # pixels of the simulated surface that is lit


def judge(
    relief: Relief, report: Mapping[str, Any], folder: Path, progress: Progress = silent
) -> Verification:
    """Judge the programs on disk with the cutters and machine they were made for.

    Raises
    ------
    InputError
        If a program is missing, or the report does not hold what it takes.
    """
    made = made_for(report, folder, relief.depth)
    programs = [made.read(folder / name) for name in program_names(report)]
    milled = laid(relief, made.setup.stock)
    return verify(
        programs, made.cutters, milled, made.setup, positions=made.positions, progress=progress
    )


@dataclass(frozen=True)
class MadeFor:
    """What the programs of a job were made for.

    Parameters
    ----------
    setup : Setup
    cutters : tuple of Cutter
        One a program; a program that changes cutters counts once for each.
    positions : tuple of Position or None
        As many.
    """

    setup: Setup
    cutters: tuple[Cutter, ...]
    positions: tuple[Position | None, ...]

    def read(self, path: Path) -> Program:
        """Read one of the programs.

        Raises
        ------
        InputError
            If it is missing, or no program.
        """
        if not path.is_file():
            raise InputError("a program of the job is missing", where=str(path))
        text = path.read_text(encoding="latin-1")
        stock, dialect = self.setup.stock, self.setup.post.dialect
        return read_program(text, name=path.name, dialect=dialect, radius=stock.radius)


def made_for(report: Mapping[str, Any], folder: Path, depth: float) -> MadeFor:
    """Read back what the programs of a report were made for.

    Parameters
    ----------
    report : mapping
    folder : Path
        Where it lies.
    depth : float
        Of the relief, mm.

    Raises
    ------
    InputError
        If the report does not hold it.
    """
    try:
        places = [part.get("position") for part in report["programs"]]
        return MadeFor(
            _setup(report, depth),
            tuple(Cutter(**part["cutter"]) for part in report["programs"]),
            tuple(Position.of(place) if place else None for place in places),
        )
    except (KeyError, TypeError, ValueError) as fault:
        raise InputError(
            "the report does not say what its programs were made for",
            expected="machine, material, slab, and a cutter for each program",
            found=repr(fault),
            where=str(folder / "report.json"),
            hint="relieffab toolpath writes them again",
        ) from fault


def _setup(report: Mapping[str, Any], depth: float) -> Setup:
    """Read back what programs were made for."""
    material = {key: value for key, value in report["material"].items() if key != "notes"}
    material["use"] = tuple(
        Use(**{**use, "machines": tuple(use["machines"])}) for use in material["use"]
    )
    machine, stock = _machine(report["machine"]), Stock.of(report["slab"])
    return Setup(machine, Material(**material), stock, stock.lowest(depth), report["units"])


def _machine(values: Mapping[str, Any]) -> Machine:
    """Build a machine from what JSON holds of it."""
    lists = ("travel", "max_rate", "acceleration", "spindle")
    rotary = values.get("rotary")
    return Machine(
        **{
            **values,
            **{name: tuple(values[name]) for name in lists},
            "rotary": rotary and Rotary(**rotary),
        }
    )


@dataclass(frozen=True)
class Changes:
    """What is no longer as the job left it.

    Parameters
    ----------
    findings, notes : list of str
        What must stop a person, and what they should know.
    """

    findings: list[str]
    notes: list[str]


def changes(report: Mapping[str, Any], folder: Path) -> Changes:
    """Compare a folder with its report."""
    listed = {str(part["file"]): part for part in [*report.get("aids", []), *report["programs"]]}
    findings = [
        f"{path.name} lies in the folder but was not made by this job, and is not judged"
        for path in sorted(folder.glob("*.nc"))
        if path.name not in listed
    ]
    notes = [
        f"{name} was changed after it was written"
        for name, part in listed.items()
        if (folder / name).is_file() and file_hash(folder / name) != part.get("sha256")
    ]
    if file_hash(folder / RELIEF) != report.get("relief", {}).get("sha256"):
        notes.append(f"{RELIEF} was changed after it was written")
    return Changes(findings, notes)


def verification_part(verdict: Verification, relief: Relief, more: Sequence[str] = ()) -> Part:
    """Describe a verdict as report.json does."""
    findings = [*verdict.findings, *more]
    inside = verdict.deviation[verdict.figure]
    low, middle, high = np.percentile(inside, (1, 50, 99))
    return {
        "gouge_mm": round(verdict.gouge_mm, 5),
        "excess_p99_mm": round(verdict.excess_p99_mm, 5),
        "within_tolerance": round(verdict.within_tolerance, 5),
        "tolerance_mm": verdict.tolerance_mm,
        "deviation_mm": {
            "least": round(float(inside.min()), 5),
            "p01": round(float(low), 5),
            "median": round(float(middle), 5),
            "p99": round(float(high), 5),
            "most": round(float(inside.max()), 5),
        },
        "seams": [
            {
                "between": list(seam.between),
                "error_mm": round(seam.error_mm, 5),
                "within_tolerance": round(seam.within_tolerance, 5),
            }
            for seam in verdict.seams
        ],
        "nodes_per_pixel": round(relief.grid.pitch / verdict.grid.pitch),
        "air_cutting": round(verdict.air_cutting, 4),
        "ok": not findings,
        "findings": findings,
    }


def write_pictures(
    verdict: Verification, relief: Relief, stock: Stock, job: Job, folder: Path
) -> Part:
    """Write the map of what is left and the predicted look, upright; give their names.

    Parameters
    ----------
    verdict : Verification
    relief : Relief
    stock : Stock
        As it lies on the machine.
    job : Job
    folder : Path
    """
    deviation, figure = verdict.deviation, verdict.figure
    if stock.radius:
        deviation, figure = deviation.T, figure.T
    colours = deviation_map(deviation, figure, verdict.tolerance_mm)
    (folder / DEVIATION).write_bytes(png8(colours))
    milled = laid(relief, stock)
    carved = upright(carved_relief(verdict, milled), stock)
    wanted = upright(milled, stock)
    look = predicted_look(wanted, carved, light_at(*job.light), texture=job.texture)
    (folder / LOOK).write_bytes(png8(look))
    return {"deviation": DEVIATION, "look": LOOK}


def carved_relief(verdict: Verification, relief: Relief) -> Relief:
    """Take the simulated surface, within the relief's own grid, as a relief."""
    fine, grid = verdict.grid, relief.grid
    refine = round(grid.pitch / fine.pitch)
    step = next(k for k in (1, 2, 4, refine) if grid.cols * refine // k <= WIDEST or k == refine)
    top, left = (round(float(k)) for k in fine.to_index(*grid.to_xy(0.0, 0.0)))
    rows, cols = (k * refine for k in grid.shape)
    heights = verdict.carved[top : top + rows + 1 : step, left : left + cols + 1 : step]
    per = refine // step
    return Relief(
        Grid(grid.rows * per, grid.cols * per, grid.pitch / per, grid.origin),
        np.clip(heights.astype(float), -relief.depth, 0.0),
        np.kron(relief.mask, np.ones((per, per), bool)),
        relief.depth,
    )


def judged_again(program: Path) -> list[str]:
    """Judge a program that was changed since it was proved, with its job's others.

    Returns
    -------
    list of str
        What a person should know.

    Raises
    ------
    FindingsError
        If it would not carve the relief.
    InputError
        If it cannot be read as a program.
    """
    folder = program.parent
    verdict = judge(read_relief(folder / RELIEF), read_report(folder), folder)
    if not verdict.ok:
        raise FindingsError(
            f"{program.name} is not as it was proved, and does not carve the relief; nothing sent",
            found="\n    ".join(verdict.findings),
            where=str(program),
            hint="relieffab toolpath writes the programs again",
        )
    return [f"{program.name} is not as it was proved; judged again, it carves the relief"]
