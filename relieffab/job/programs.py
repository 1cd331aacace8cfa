"""The programs of a job: written with all that judges them, and judged from their files."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from relieffab.cutter import Cutter
from relieffab.errors import InputError
from relieffab.gcode.estimate import estimate
from relieffab.gcode.pacing import paced
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.verify import Verification, verify
from relieffab.gcode.write import write_program
from relieffab.job.chain import setup_of
from relieffab.job.settings import Job
from relieffab.machine import Machine, Material
from relieffab.progress import Progress, silent
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

Part = dict[str, Any]

NUMBERS = {"rough": 1, "finish": 2, "lines": 3}


def write(
    paths: Sequence[Toolpath], relief: Relief, job: Job, report: Mapping[str, Any], folder: Path
) -> Part:
    """Write one program a cutter, or one that changes cutters.

    Returns
    -------
    dict
        report.json's `programs`, `machine`, `material`, and `slab`: enough to
        judge the programs anywhere, whatever the profiles there say.
    """
    setup = setup_of(job, relief.depth)
    slab = Slab.whole(relief.grid, setup.stock)
    fit = {path.name: paced(path, setup) for path in paths}
    paths = [one.path for one in fit.values()]
    starving = [one.warning for one in fit.values() if one.warning]
    notes = [*material_notes(setup.material, paths), *starving]
    header = {**_origin(report), **_numbered(notes)}
    parts = []
    for name, several in _files(paths, job):
        text = write_program(several, setup, slab, header=header)
        (folder / name).write_text(text, encoding="ascii", newline="\n")
        program = read_program(text, name=name, dialect=setup.post.dialect)
        parts += [
            {
                "file": name,
                "cutter": asdict(path.cutter),
                "rpm": path.rpm,
                "lines": text.count("\n"),
                "seconds": round(estimate(part, setup.machine), 1),
                "starved": round(fit[path.name].pace.starved, 4),
                "simplified_mm": fit[path.name].tolerance,
                "cut_mm": round(path.cutting_length, 1),
                "bounds_mm": np.round(part.bounds, 4).tolist(),
                "sha256": _hash(folder / name),
            }
            for path, part in zip(several, program.by_tool(), strict=True)
        ]
    return {
        "programs": parts,
        "units": setup.units,
        "machine": asdict(setup.machine),
        "material": {**asdict(setup.material), "notes": notes},
        "slab": asdict(setup.stock),
    }


def _files(paths: Sequence[Toolpath], job: Job) -> list[tuple[str, list[Toolpath]]]:
    if job.cutter_change == "pause":
        return [("programs.nc", list(paths))]
    return [(f"{NUMBERS[path.name]:02d}-{path.name}.nc", [path]) for path in paths]


def _origin(report: Mapping[str, Any]) -> dict[str, str]:
    """Say what the programs come from, so that the job can be done again."""
    model, settings = report["model"], report["settings"]
    facts = {"model": model["name"]}
    if model.get("sha256"):
        facts["model sha256"] = model["sha256"]
    if report.get("relief", {}).get("sha256"):
        facts["relief sha256"] = report["relief"]["sha256"]
    return facts | {"settings": ", ".join(f"{name}={text}" for name, text in settings.items())}


def material_notes(material: Material, paths: Sequence[Toolpath]) -> list[str]:
    """Say what a person has to know of the material before cutting it."""
    notes = []
    if not material.verified:
        notes.append(f"feeds for {material.title.lower()} are a careful guess: start slower")
    if material.note:
        notes.append(material.note)
    for path in paths:
        wanted = path.cutter.rpm * material.rpm
        if abs(path.rpm - wanted) > 1:
            notes.append(
                f"{path.name}: the spindle turns {path.rpm:g} rpm where {wanted:g} would be right"
            )
    return notes


def _numbered(notes: Sequence[str]) -> dict[str, str]:
    return {f"note {k}": note for k, note in enumerate(notes, 1)}


def _hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def judge(
    relief: Relief, report: Mapping[str, Any], folder: Path, progress: Progress = silent
) -> Verification:
    """Judge the programs on disk with the cutters and machine they were made for.

    Raises
    ------
    InputError
        If a program is missing, or the report does not hold what it takes.
    """
    try:
        setup = _setup(report, relief.depth)
        cutters = [Cutter(**part["cutter"]) for part in report["programs"]]
        files = [folder / name for name in _names(report)]
    except (KeyError, TypeError, ValueError) as fault:
        raise InputError(
            "the report does not say what its programs were made for",
            expected="machine, material, slab, and a cutter for each program",
            found=repr(fault),
            where=str(folder / "report.json"),
            hint="relieffab toolpath writes them again",
        ) from fault
    programs = []
    for path in files:
        if not path.is_file():
            raise InputError("a program of the job is missing", where=str(path))
        text = path.read_text(encoding="latin-1")
        programs.append(read_program(text, name=path.name, dialect=setup.post.dialect))
    return verify(programs, cutters, relief, setup, progress=progress)


def _names(report: Mapping[str, Any]) -> list[str]:
    """Name the files of the programs, each once, in their order."""
    return list(dict.fromkeys(str(part["file"]) for part in report["programs"]))


def _setup(report: Mapping[str, Any], depth: float) -> Setup:
    """Read back what programs were made for."""
    material = {key: value for key, value in report["material"].items() if key != "notes"}
    return Setup(
        Machine(**{**report["machine"], **_tuples(report["machine"])}),
        Material(**material),
        Stock(**{**report["slab"], "work_zero": tuple(report["slab"]["work_zero"])}),
        depth,
        report["units"],
    )


def _tuples(machine: Mapping[str, Any]) -> dict[str, tuple[float, ...]]:
    return {
        name: tuple(machine[name]) for name in ("travel", "max_rate", "acceleration", "spindle")
    }


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
    listed = {str(part["file"]): part for part in report["programs"]}
    findings = [
        f"{path.name} lies in the folder but was not made by this job, and is not judged"
        for path in sorted(folder.glob("*.nc"))
        if path.name not in listed
    ]
    notes = [
        f"{name} was changed after it was written"
        for name, part in listed.items()
        if _hash(folder / name) != part.get("sha256")
    ]
    if _hash(folder / "relief.tiff") != report.get("relief", {}).get("sha256"):
        notes.append("relief.tiff was changed after it was written")
    return Changes(findings, notes)


def verification_part(verdict: Verification, more: Sequence[str] = ()) -> Part:
    """Describe a verdict as report.json does."""
    findings = [*verdict.findings, *more]
    return {
        "gouge_mm": round(verdict.gouge_mm, 5),
        "excess_p99_mm": round(verdict.excess_p99_mm, 5),
        "within_tolerance": round(verdict.within_tolerance, 5),
        "tolerance_mm": verdict.tolerance_mm,
        "air_cutting": round(verdict.air_cutting, 4),
        "ok": not findings,
        "findings": findings,
    }
