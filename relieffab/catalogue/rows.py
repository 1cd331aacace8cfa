"""What the catalogue tells of a job: a row of its table, out of the job's report."""

from collections.abc import Mapping
from typing import Any
from urllib.parse import quote

from relieffab.catalogue.entries import Entry
from relieffab.catalogue.task import Fault, Result
from relieffab.catalogue.thumbnail import THUMBNAIL
from relieffab.job import readers
from relieffab.job.folder import SOLIDS

Row = dict[str, Any]

DONE, KEPT, FAILED, WAITING = "done", "kept", "failed", "waiting"
"""Done now, done before, failed, not yet begun."""


def waiting(entry: Entry) -> Row:
    """Return the row of a job that is still to come."""
    return {"name": entry.name, "model": entry.model, "note": entry.note, "status": WAITING}


def row(entry: Entry, result: Result, status: str, tries: int = 0) -> Row:
    """Return the row of a job that was done, now or before, or has failed.

    Parameters
    ----------
    entry : Entry
    result : dict or Fault
        The job's report, or why there is none.
    status : {'done', 'kept'}
        Of a job that did not fail.
    tries : int
        How often it was begun.
    """
    begun = {**waiting(entry), "tries": tries}
    if isinstance(result, Fault):
        failed = {**begun, "status": FAILED, "message": result.message}
        return {**failed, "trace": result.trace} if result.trace else failed
    return {**begun, "status": status, **_facts(result), "files": _files(entry.name, result)}


def _facts(report: Mapping[str, Any]) -> Row:
    programs = report.get("programs", [])
    solid = report.get(report["settings"].get("solid", ""), {})
    return {
        "stage": report["batch"]["stage"],
        "seconds": report["batch"]["seconds"],
        "worker": report["batch"]["worker"],
        "size_mm": list(readers.size(report["settings"]["size"])),
        "depth_mm": report["relief"]["depth_mm"] if "relief" in report else None,
        "cutting_s": sum(part["seconds"] for part in programs) if programs else None,
        "programs": len(programs),
        "carves": report["verification"]["ok"] if "verification" in report else None,
        "findings": solid.get("findings", []),
        "notes": report["model"].get("notes", []),
    }


def _files(name: str, report: Mapping[str, Any]) -> dict[str, str]:
    """Name the files worth a link, as a page beside their folder would."""
    files = {"report": "report.html", "thumbnail": THUMBNAIL}
    if "relief" in report:
        files |= {"picture": "preview.png", "relief": report["relief"]["file"]}
    else:
        files |= {"picture": "layers/lambert.png", "drawing": "layers/lines.svg"}
    files |= {solid: report[solid]["file"] for solid in SOLIDS if solid in report}
    return {kind: quote(f"{name}/{file}") for kind, file in files.items()}
