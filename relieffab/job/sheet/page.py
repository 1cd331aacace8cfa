"""Report to HTML: one page that holds its pictures, for the person at the machine."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from relieffab.html import renderer
from relieffab.job.folder import SOLIDS
from relieffab.job.marked import styles_in
from relieffab.job.settings import Job, job_of, resolve
from relieffab.job.sheet import tools
from relieffab.job.sheet.checklist import checklist
from relieffab.job.sheet.commands import commands
from relieffab.job.sheet.drawings import count_positions, drawings
from relieffab.job.sheet.heed import heeds
from relieffab.job.sheet.pictures import pictures
from relieffab.job.sheet.stocks import measures, zero
from relieffab.job.sheet.words import mm, sides
from relieffab.job.stocks import milled_of, round_of, stock_of
from relieffab.stock import Stock

_render = renderer("relieffab.job.sheet", "templates", "sheet.html", mm=mm, sides=sides)


def page(report: Mapping[str, Any], folders: Sequence[Path] = ()) -> str:
    """Lay a report out as HTML.

    Parameters
    ----------
    report : mapping
        What report.json holds.
    folders : sequence of Path
        Where its pictures may lie.

    Returns
    -------
    str
        One page that needs nothing beside it.
    """
    job = job_of(resolve([("report.json", report["settings"])]))
    bent = round_of(job)
    stock = _stock(report, job)
    shown = pictures(report, folders)
    kept = shown.pop("plan", None)
    return _render(
        report=report,
        job=job,
        title=str(report.get("model", {}).get("name", "relief")),
        heeds=heeds(report),
        pictures=shown,
        stock=stock,
        measures=measures(stock, bent),
        drawings=drawings(report, stock, bent, _depth(report, job), kept),
        positions=count_positions(report),
        zero=zero(stock),
        cutters=tools.cutters(report),
        programs=tools.programs(report),
        axes=tools.axes(report),
        total=tools.total(report) if report.get("programs") else "",
        reaches=tools.reaches(report),
        checklist=checklist(report, stock, bent),
        styles=styles_in(report),
        solids={name: report[name] for name in SOLIDS if name in report},
        hashes=_hashes(report),
        commands=commands(report),
    )


def _stock(report: Mapping[str, Any], job: Job) -> Stock:
    """Give the stock that programs were made for, or would be."""
    if "slab" in report:
        return Stock.of(report["slab"])
    return milled_of(job) if job.round is not None else stock_of(job)


def _depth(report: Mapping[str, Any], job: Job) -> float:
    return float(report["relief"]["depth_mm"]) if "relief" in report else job.depth


def _hashes(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """List what was proved as `sha256sum` does: sum, file."""
    parts = [*report.get("aids", []), *report.get("programs", [])]
    found = {str(part["file"]): str(part["sha256"]) for part in parts}
    if report.get("relief", {}).get("sha256"):
        found[report["relief"]["file"]] = report["relief"]["sha256"]
    return [(value, name) for name, value in found.items()]
