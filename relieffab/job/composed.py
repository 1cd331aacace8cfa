"""Folders of reliefs to one folder: the reliefs of several jobs on one panel."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from relieffab.errors import InputError
from relieffab.job import looking, pictures, reliefs
from relieffab.job.drawn import read_strokes
from relieffab.job.folder import ALL, check_folder, finished_together
from relieffab.job.report import Report, read_report, start_report, write_report
from relieffab.job.settings import Chosen, Job, job_of, resolve
from relieffab.job.stocks import round_of, stock_of
from relieffab.layers.model import Stroke
from relieffab.panel.sinking import check_clear
from relieffab.progress import Progress, silent
from relieffab.relief.compose import Placed, compose, fitted_round
from relieffab.relief.laid import parted
from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.store import read_relief

# What a plaque of them all takes from the reliefs, so that they must agree on it.
SHARED = ("wall_angle",)

Place = tuple[Path, tuple[float, float]]


def _agreed(reports: Sequence[Report]) -> dict[str, str]:
    """Gather the settings that all reliefs share."""
    found = {}
    for name in SHARED:
        values = {str(report["settings"].get(name, "")) for report in reports}
        if len(values) > 1:
            raise InputError(
                f"the reliefs differ in {name}", expected="one", found=", ".join(sorted(values))
            )
        found[name] = values.pop()
    return {name: text for name, text in found.items() if text}


def _moved(
    stroke: Stroke, at: tuple[float, float], scale: float, around: float | None
) -> list[Stroke]:
    moved = replace(stroke, points=scale * stroke.points + at)
    return [moved] if around is None else parted(moved, around)


def _report(
    settings: Mapping[str, Chosen],
    reports: Sequence[Report],
    places: Sequence[Place],
    relief: Relief,
) -> Report:
    """Begin the report: what lies where; depth and walls are the reliefs' own."""
    texts = {name: choice.text for name, choice in settings.items() if choice.text}
    own = {**_agreed(reports), "depth": f"{relief.depth:g}mm"}
    report = start_report(resolve([("relief", own), ("flag", texts)]))
    names = list(dict.fromkeys(part["model"]["name"] for part in reports))
    notes = [note for part in reports for note in part["model"].get("notes", [])]
    report["model"] = {"name": ", ".join(names), "notes": list(dict.fromkeys(notes))}
    report["reliefs"] = [
        {"model": part["model"], "place_mm": list(at), "sha256": part["relief"].get("sha256")}
        for part, (_, at) in zip(reports, places, strict=True)
    ]
    return report


def make(
    settings: Mapping[str, Chosen],
    places: Sequence[Place],
    folder: Path,
    *,
    overwrite: bool = False,
    progress: Progress = silent,
) -> Report:
    """Lay the reliefs of finished folders out on one panel.

    Parameters
    ----------
    settings : mapping of Chosen
        The panel's: size, thickness, outline, frame, holes.
    places : sequence of (folder, (X, Y))
        Where the near left corner of each relief's own panel comes, mm; on a panel that goes
        all the way round, X may be anything.
    folder : Path
        Where the files go: what `panel`, `template` and `toolpath` work on.
    overwrite : bool
    progress : Progress

    Returns
    -------
    dict
        What report.json holds.

    Raises
    ------
    InputError
        If a folder holds no relief, or the panel not all of them.
    """
    check_folder(folder, overwrite=overwrite)
    reports = [read_report(path) for path, _ in places]
    job = job_of(settings)
    progress("compose", 0, 1)
    parts = [Placed(read_relief(path / "relief.tiff"), at, path.name) for path, at in places]
    bent, stock = round_of(job), stock_of(job)
    joined, scale = bent is not None and bent.all_round, 1.0
    if joined:
        parts, scale = fitted_round(parts, job.size[0])
    relief = compose(parts, job.size, joined=joined)
    check_clear(nodes_of(relief.mask), relief.grid, stock, relief.depth)
    report = _report(settings, reports, places, relief)
    around = job.size[0] if joined else None
    strokes = [
        stroke
        for part, (path, _) in zip(parts, places, strict=True)
        for drawn in read_strokes(path)
        for stroke in _moved(drawn, part.at, scale, around)
    ]
    with finished_together(folder, ALL) as scratch:
        _write(relief, strokes, job, report, scratch)
        write_report(report, scratch)
    progress("compose", 1, 1)
    return report


def _write(
    relief: Relief, strokes: Sequence[Stroke], job: Job, report: Report, folder: Path
) -> None:
    looking.write_drawing(strokes, job, folder)
    report["relief"] = reliefs.relief_part(relief)
    report["relief"]["sha256"] = reliefs.write_relief(relief, folder)
    _, report["picture"] = pictures.write_picture(relief, None, job, folder)
