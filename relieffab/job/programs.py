"""The programs of a job, written with all that judges them."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from relieffab.gcode.aids import outline_program, probe_program
from relieffab.gcode.ease import eased
from relieffab.gcode.estimate import estimate
from relieffab.gcode.pacing import Paced, paced
from relieffab.gcode.read import read_program
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import foretold, write_program
from relieffab.job.certificate import file_hash
from relieffab.job.milling import Planned, setup_of
from relieffab.job.settings import Job
from relieffab.machine import cutting, known_use
from relieffab.progress import Progress, silent
from relieffab.relief.laid import laid
from relieffab.relief.model import Relief
from relieffab.toolpath.path import Toolpath

Part = dict[str, Any]

NUMBERS = {"rough": 1, "finish": 2, "lines": 3, "marks": 4}


def write(
    planned: Sequence[Planned], relief: Relief, job: Job, report: Mapping[str, Any], folder: Path
) -> Part:
    """Write one program a cutter, or one that changes cutters; so at each position.

    Returns
    -------
    dict
        report.json's `aids`, `programs`, `machine`, `material`, and `slab`: enough
        to judge the programs anywhere, whatever the profiles there say.
    """
    whole = setup_of(job, relief.depth)
    slab = Slab.whole(laid(relief, whole.stock).grid, whole.stock)
    places = []
    for position, paths in planned:
        setup = whole.at(position)
        places.append((setup, fitted_to(paths, setup, slab)))
    notes = notes_on(whole, [one for _, fit in places for one in fit])
    header = {**_origin(report), **_numbered(notes)}
    parts, aids = [], []
    for setup, fit in places:
        parts += _at_position(setup, fit, slab, job, header, folder)
        aids += _aids(setup, job, folder)
    return {
        "aids": aids,
        "programs": parts,
        "units": whole.units,
        "machine": asdict(whole.machine),
        "material": {**asdict(whole.material), "notes": notes},
        "slab": asdict(whole.stock),
    }


def _at_position(
    setup: Setup,
    fit: Sequence[Paced],
    slab: Slab,
    job: Job,
    header: Mapping[str, str],
    folder: Path,
) -> list[Part]:
    """Write the programs for the stock as it lies, and cut the slab by them."""
    fitted = {one.path.name: one for one in fit}
    parts = []
    for name, several in _files([one.path for one in fit], job):
        file = _prefix(setup) + name
        text = write_program(several, setup, slab, header=header)
        (folder / file).write_text(text, encoding="ascii", newline="\n")
        radius = setup.stock.radius
        program = read_program(text, name=file, dialect=setup.post.dialect, radius=radius)
        parts += [
            {
                "file": file,
                **_place(setup),
                "cutter": asdict(path.cutter),
                "rpm": path.rpm,
                "feeds": asdict(cutting(path.cutter, setup.material, setup.machine)),
                "lines": text.count("\n"),
                "seconds": round(estimate(part, setup.machine), 1),
                "starved": round(fitted[path.name].pace.starved, 4),
                "simplified_mm": fitted[path.name].tolerance,
                "cut_mm": round(path.cutting_length, 1),
                "bounds_mm": np.round(part.bounds, 4).tolist(),
                "sha256": file_hash(folder / file),
            }
            for path, part in zip(several, program.by_tool(), strict=True)
        ]
    return parts


def _prefix(setup: Setup) -> str:
    return f"{setup.position.number}-" if setup.position else ""


def _place(setup: Setup) -> Part:
    """Say how the stock lies, for whoever reads and for whoever judges."""
    if setup.position is None:
        return {}
    return {"position": asdict(setup.position), "placing": setup.position.placing}


def fitted_to(
    paths: Sequence[Toolpath], setup: Setup, slab: Slab, progress: Progress = silent
) -> list[Paced]:
    """Fit the paths of a position to its machine, and to the stock that those before leave.

    Parameters
    ----------
    paths : sequence of Toolpath
    setup : Setup
    slab : Slab
        Untouched; stays so.
    progress : Progress
    """
    trial, found = slab.copy(), []
    for k, path in enumerate(paths):
        progress("programs", k, len(paths))
        one = paced(path, setup)
        easy = eased(one.path, setup, trial)
        if easy is not one.path:
            one = replace(one, path=easy, program=foretold(easy, setup))
        trial.cut(one.program.on_panel(setup.stock), path.cutter)
        found.append(one)
    return found


def _aids(setup: Setup, job: Job, folder: Path) -> list[Part]:
    """Write what helps to set the job up."""
    texts = {"00-outline.nc": outline_program(setup)}
    if job.plate is not None:
        texts["00-probe.nc"] = probe_program(setup, job.plate)
    parts = []
    for name, text in texts.items():
        file = folder / f"{_prefix(setup)}{name}"
        file.write_text(text, encoding="ascii", newline="\n")
        parts.append({"file": file.name, "sha256": file_hash(file)})
    return parts


def _files(paths: Sequence[Toolpath], job: Job) -> list[tuple[str, list[Toolpath]]]:
    if job.cutter_change == "pause":
        return [("programs.nc", list(paths))]
    return [(_file(path), [path]) for path in paths]


def _file(path: Toolpath) -> str:
    stage, _, again = path.name.partition("-")
    return f"{NUMBERS[stage] + int(again or 1) - 1:02d}-{path.name}.nc"


def file_name(setup: Setup, path: Toolpath) -> str:
    """Name the file of a path that is a program of its own."""
    return _prefix(setup) + _file(path)


def notes_on(setup: Setup, fitted: Sequence[Paced]) -> list[str]:
    """Say what a person has to know of programs: of the material, and what starves."""
    paths = {one.path.name: one.path for one in fitted}
    starving = [one.warning for one in fitted if one.warning]
    return [*material_notes(setup, list(paths.values())), *dict.fromkeys(starving)]


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
