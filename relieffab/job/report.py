"""report.json: what a job is, found and took."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from relieffab import __version__
from relieffab.errors import InputError
from relieffab.job.folder import REPORT, SOLIDS
from relieffab.job.settings import Chosen

SCHEMA = 1

# The order in which keys stand in the file.
KEYS = (
    "schema",
    "version",
    "model",
    "view",
    "settings",
    "reliefs",
    "relief",
    "style",
    *SOLIDS,
    "stock",
    "template",
    "machine",
    "material",
    "slab",
    "units",
    "aids",
    "programs",
    "verification",
    "picture",
    "batch",
    "timings",
)

Report = dict[str, Any]


def start_report(chosen: Mapping[str, Chosen]) -> Report:
    """Begin a report with the settings as they were chosen."""
    settings = {name: choice.text for name, choice in chosen.items() if choice.text}
    return {"schema": SCHEMA, "version": __version__, "settings": settings, "timings": {}}


def write_report(report: Report, folder: Path, *, kept: Path | None = None) -> None:
    """Write report.json and report.html.

    Parameters
    ----------
    report : dict
    folder : Path
        Where they go, beside the files that are new.
    kept : Path, optional
        Where files of earlier stages lie, whose pictures belong to the page, too.
    """
    # What lays the page out is of no use to those who only read reports.
    from relieffab.job.sheet.page import page

    ordered = {key: report[key] for key in KEYS if key in report}
    text = json.dumps(ordered, indent=2, ensure_ascii=False, allow_nan=False)
    (folder / REPORT).write_text(text + "\n", encoding="utf-8")
    (folder / "report.html").write_text(
        page(ordered, [folder, *([kept] if kept else [])]), encoding="utf-8"
    )


def read_report(folder: Path) -> Report:
    """Read the report of a folder that a job left.

    Raises
    ------
    InputError
        If there is none, or it is not one of ours.
    """
    path = folder / REPORT
    if not path.is_file():
        raise InputError(
            "this folder holds no job",
            expected=f"a {REPORT} in it",
            where=str(folder),
            hint="relieffab relief MODEL -o FOLDER, or relieffab make",
        )
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, OSError) as fault:
        raise InputError("the report cannot be read", found=str(fault), where=str(path)) from fault
    if not isinstance(report, dict) or report.get("schema") != SCHEMA:
        raise InputError(
            "the report is of another schema",
            expected=str(SCHEMA),
            found=str(report.get("schema") if isinstance(report, dict) else type(report).__name__),
            where=str(path),
        )
    if not isinstance(report.get("settings"), dict) or not isinstance(report.get("model"), dict):
        raise InputError("the report says nothing of settings and model", where=str(path))
    report["model"].setdefault("name", "model")
    return report
