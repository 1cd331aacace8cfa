"""A job from end to end: the whole chain into one folder."""

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from relieffab.errors import FindingsError, InputError
from relieffab.job import (
    certificate,
    drawn,
    looking,
    milling,
    pictures,
    programs,
    proof,
    reliefs,
    solids,
    styles,
)
from relieffab.job.folder import (
    ALL,
    PROGRAMS,
    SOLIDS,
    TEMPLATE,
    check_folder,
    finished_together,
)
from relieffab.job.report import Report, read_report, start_report, write_report
from relieffab.job.seen import Seen, look_at, read_model
from relieffab.job.settings import Chosen, Job, job_of
from relieffab.job.stocks import round_of, stock_files
from relieffab.layers.model import Layers
from relieffab.panel.blank import Drafting
from relieffab.panel.formats import FRAME, STOCK
from relieffab.progress import Progress, silent
from relieffab.relief.model import Floats, Relief
from relieffab.relief.store import read_relief
from relieffab.relief.style.model import Marks

Settings = Mapping[str, Chosen]


@contextmanager
def _timed(report: Report, stage: str, progress: Progress) -> Iterator[None]:
    progress(stage, 0, 1)
    start = time.perf_counter()
    yield
    report["timings"][stage] = round(time.perf_counter() - start, 3)
    progress(stage, 1, 1)


@contextmanager
def _reported(report: Report, folder: Path, kept: Path | None = None) -> Iterator[None]:
    """Write the report once all else went well; `kept` has files of earlier stages."""
    yield
    write_report(report, folder, kept=kept)


def _see(job: Job, report: Report, folder: Path, progress: Progress) -> Seen:
    with _timed(report, "model", progress):
        model = read_model(job)
    with _timed(report, "layers", progress):
        seen = look_at(model, job)
        report["model"], report["view"] = seen.model, seen.view
        looking.write_layers(seen.layers, job, folder)
    return seen


def _solve(
    job: Job, report: Report, folder: Path, progress: Progress
) -> tuple[Layers, Relief, tuple[Marks, ...]]:
    seen = _see(job, report, folder, progress)
    with _timed(report, "relief", progress):
        relief, report["relief"] = reliefs.solve_relief(seen.layers, job, seen.carve, progress)
    relief, marks = _mark(relief, seen.layers, job, report, folder, progress)
    report["relief"]["sha256"] = reliefs.write_relief(relief, folder)
    report["relief"]["seconds"] = report["timings"]["relief"]
    return seen.layers, relief, marks


def _mark(
    smooth: Relief, layers: Layers, job: Job, report: Report, folder: Path, progress: Progress
) -> tuple[Relief, tuple[Marks, ...]]:
    """Give the relief the marks of the job's style, if it has one."""
    if styles.style_of(job).plain:
        return smooth, ()
    with _timed(report, "style", progress):
        relief, marks, report["style"] = styles.mark(smooth, layers, job)
        styles.write_marks([marks], job, folder)
    report["relief"].update(reliefs.relief_part(relief))
    return relief, (marks,)


def _carve(
    relief: Relief,
    stock: Drafting,
    job: Job,
    report: Report,
    folder: Path,
    progress: Progress,
    walls: Floats | None = None,
) -> None:
    """Make the job's solid and write it, its picture in its 3MF, too.

    Before there is a panel, preview.png shows the relief.
    """
    with _timed(report, job.solid, progress):
        solid, facts = solids.make(relief, stock, job, progress, walls=walls)
    panel = solid if job.solid == "panel" else None
    with _timed(report, "picture", progress):
        if panel or "picture" not in report:
            picture = pictures.write_picture(relief, panel, job, folder, round_of(job))
            small, report["picture"] = picture
        if panel is None:
            file = folder / f"{job.solid}.png"
            small, facts["picture"] = pictures.write_solid_picture(solid, relief, job, file)
    with _timed(report, "export", progress):
        name = report["model"]["name"]
        part = solids.write_solid(solid, job, folder, name=name, picture=small)
        report[job.solid] = {**part, **facts}


def _prove(
    planned: Sequence[milling.Planned],
    relief: Relief,
    job: Job,
    report: Report,
    folder: Path,
    progress: Progress,
) -> None:
    """Write the programs and judge them from their files.

    Raises
    ------
    FindingsError
        If they would not carve the relief.
    """
    with _timed(report, "programs", progress):
        report.update(programs.write(planned, relief, job, report, folder))
    stock = milling.setup_of(job, relief.depth).stock
    with _timed(report, "verify", progress):
        verdict = proof.judge(relief, report, folder, progress)
        report["verification"] = {
            **proof.verification_part(verdict, relief),
            "certificate": certificate.certificate(report, folder),
            "pictures": proof.write_pictures(verdict, relief, stock, job, folder),
        }
    if not verdict.ok:
        raise FindingsError(
            "the programs do not carve this relief; nothing was written",
            found="\n    ".join(verdict.findings),
            hint="a finer resolution, a gentler --wall-angle, or finer cutters",
        )


def make(
    settings: Settings, folder: Path, *, overwrite: bool = False, progress: Progress = silent
) -> Report:
    """Carve a model: every stage, every file, judged from the files on disk.

    Parameters
    ----------
    settings : mapping of Chosen
        From `relieffab.job.load.gather`.
    folder : Path
        Where the files go; all of them or none.
    overwrite : bool
        Replace the files of a job that is there.
    progress : Progress

    Returns
    -------
    dict
        What report.json holds.

    Raises
    ------
    InputError
        If something asked for cannot be done.
    FindingsError
        If the programs would not carve the relief.
    """
    job = job_of(settings)
    milling.check(job)
    check_folder(folder, overwrite=overwrite)
    report = start_report(settings)
    with (
        finished_together(folder, ALL) as scratch,
        _reported(report, scratch),
        stock_files(job, scratch) as (stock, report["stock"]),
    ):
        layers, relief, marks = _solve(job, report, scratch, progress)
        _carve(relief, stock, job, report, scratch, progress)
        with _timed(report, "toolpaths", progress):
            planned = milling.plan_paths(relief, layers.strokes, job, progress, marks=marks)
        _prove(planned, relief, job, report, scratch, progress)
    return report


def make_layers(
    settings: Settings, folder: Path, *, overwrite: bool = False, progress: Progress = silent
) -> Report:
    """Take the three images of a model into a folder."""
    check_folder(folder, overwrite=overwrite)
    report = start_report(settings)
    with finished_together(folder, ALL) as scratch, _reported(report, scratch):
        _see(job_of(settings), report, scratch, progress)
    return report


def make_relief(
    settings: Settings, folder: Path, *, overwrite: bool = False, progress: Progress = silent
) -> Report:
    """Solve for the relief of a model into a folder."""
    job = job_of(settings)
    styles.check(job)
    round_of(job)
    reliefs.carving_of(job)
    check_folder(folder, overwrite=overwrite)
    report = start_report(settings)
    with finished_together(folder, ALL) as scratch, _reported(report, scratch):
        _, relief, _ = _solve(job, report, scratch, progress)
        with _timed(report, "picture", progress):
            _, report["picture"] = pictures.write_picture(relief, None, job, scratch)
    return report


def add_panel(settings: Settings, folder: Path, *, progress: Progress = silent) -> Report:
    """Make the panel of a relief that lies in a folder, or another solid, beside it.

    Files of other solids stay, as do their parts of the report.
    """
    job, report = job_of(settings), read_report(folder)
    solids.check(job)
    relief, walls = read_relief(folder / "relief.tiff"), reliefs.read_walls(folder)
    report["settings"] = start_report(settings)["settings"]
    with (
        finished_together(folder, (*SOLIDS[job.solid], STOCK, FRAME)) as scratch,
        _reported(report, scratch, folder),
        stock_files(job, scratch) as (stock, report["stock"]),
    ):
        _carve(relief, stock, job, report, scratch, progress, walls)
    return report


def add_toolpaths(settings: Settings, folder: Path, *, progress: Progress = silent) -> Report:
    """Plan, write and judge the programs of a relief that lies in a folder, beside it."""
    job, report = job_of(settings), read_report(folder)
    relief, strokes = read_relief(folder / "relief.tiff"), drawn.read_strokes(folder)
    marks = styles.read_marks(folder, report)
    milling.check(job, marks)
    report["settings"] = start_report(settings)["settings"]
    with finished_together(folder, PROGRAMS) as scratch, _reported(report, scratch, folder):
        with _timed(report, "toolpaths", progress):
            planned = milling.plan_paths(relief, strokes, job, progress, marks=marks)
        _prove(planned, relief, job, report, scratch, progress)
    return report


def add_template(settings: Settings, folder: Path, *, progress: Progress = silent) -> Report:
    """Draw the template of a relief that lies in a folder, beside it.

    Its contours are those of the form, without a chisel's marks.
    """
    job, report = job_of(settings), read_report(folder)
    marks, strokes = styles.read_marks(folder, report), drawn.read_strokes(folder)
    relief = marks[0].smooth if marks else read_relief(folder / "relief.tiff")
    report["settings"] = start_report(settings)["settings"]
    with (
        finished_together(folder, TEMPLATE) as scratch,
        _reported(report, scratch, folder),
        _timed(report, "template", progress),
    ):
        name = report["model"]["name"]
        report["template"] = drawn.write_template(relief, strokes, job, scratch, name=name)
    return report


def verify_again(folder: Path) -> dict[str, Any]:
    """Judge the programs of a folder as they are now; nothing is written.

    Returns
    -------
    dict
        What report.json holds as `verification`, with notes on what changed.
    """
    report = read_report(folder)
    if not report.get("programs"):
        raise InputError(
            "the job has no programs yet", where=str(folder), hint="relieffab toolpath FOLDER"
        )
    relief = read_relief(folder / "relief.tiff")
    verdict = proof.judge(relief, report, folder)
    changed = proof.changes(report, folder)
    return {**proof.verification_part(verdict, relief, changed.findings), "notes": changed.notes}
