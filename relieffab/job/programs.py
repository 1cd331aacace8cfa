"""The programs of a job, written with all that judges them."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from relieffab.gcode.aids import outline_program, probe_program
from relieffab.gcode.ease import eased
from relieffab.gcode.estimate import estimate
from relieffab.gcode.pacing import paced
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import foretold, write_program
from relieffab.job.chain import setup_of
from relieffab.job.settings import Job
from relieffab.machine import cutting, known_use
from relieffab.relief.model import Relief
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
        report.json's `aids`, `programs`, `machine`, `material`, and `slab`: enough
        to judge the programs anywhere, whatever the profiles there say.
    """
    setup = setup_of(job, relief.depth)
    slab = Slab.whole(relief.grid, setup.stock)
    fit = {path.name: paced(path, setup) for path in paths}
    paths = _eased([one.path for one in fit.values()], setup, slab)
    starving = [one.warning for one in fit.values() if one.warning]
    notes = [*material_notes(setup, paths), *starving]
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
                "feeds": asdict(cutting(path.cutter, setup.material, setup.machine)),
                "lines": text.count("\n"),
                "seconds": round(estimate(part, setup.machine), 1),
                "starved": round(fit[path.name].pace.starved, 4),
                "simplified_mm": fit[path.name].tolerance,
                "cut_mm": round(path.cutting_length, 1),
                "bounds_mm": np.round(part.bounds, 4).tolist(),
                "sha256": file_hash(folder / name),
            }
            for path, part in zip(several, program.by_tool(), strict=True)
        ]
    return {
        "aids": _aids(setup, job, folder),
        "programs": parts,
        "units": setup.units,
        "machine": asdict(setup.machine),
        "material": {**asdict(setup.material), "notes": notes},
        "slab": asdict(setup.stock),
    }


def _eased(paths: Sequence[Toolpath], setup: Setup, slab: Slab) -> list[Toolpath]:
    """Ease each path on the stock that those before it leave."""
    trial, found = slab.copy(), []
    for path in paths:
        found.append(eased(path, setup, trial))
        trial.cut(foretold(found[-1], setup).on_panel(setup.stock), path.cutter)
    return found


def _aids(setup: Setup, job: Job, folder: Path) -> list[Part]:
    """Write what helps to set the job up."""
    texts = {"00-outline.nc": outline_program(setup)}
    if job.plate is not None:
        texts["00-probe.nc"] = probe_program(setup, job.plate)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="ascii", newline="\n")
    return [{"file": name, "sha256": file_hash(folder / name)} for name in texts]


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


def material_notes(setup: Setup, paths: Sequence[Toolpath]) -> list[str]:
    """Say what a person has to know of the material before cutting it."""
    notes, material = [], setup.material
    uses = {path.name: cutting(path.cutter, material, setup.machine) for path in paths}
    guessed = [name for name, use in uses.items() if not use.verified]
    if guessed:
        which = "" if len(guessed) == len(paths) else f" ({', '.join(guessed)})"
        notes.append(f"feeds for {material.title.lower()} are a careful guess{which}: start slower")
    if material.note:
        notes.append(material.note)
    for path in paths:
        known = known_use(path.cutter, material, setup.machine)
        wanted = (known.rpm if known else 0) or path.cutter.rpm * material.rpm
        if abs(path.rpm - wanted) > 1:
            notes.append(
                f"{path.name}: the spindle turns {path.rpm:g} rpm where {wanted:g} would be right"
            )
    return notes


def _numbered(notes: Sequence[str]) -> dict[str, str]:
    return {f"note {k}": note for k, note in enumerate(notes, 1)}


def file_hash(path: Path) -> str:
    """Return a file's SHA-256, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()
