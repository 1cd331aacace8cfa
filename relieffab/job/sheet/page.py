"""Report to HTML: one page that holds its pictures, for the person at the machine."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from relieffab.job.folder import SOLIDS
from relieffab.job.settings import Job, job_of, resolve
from relieffab.job.sheet import plan, section, tools
from relieffab.job.sheet.checklist import checklist, zero
from relieffab.job.sheet.commands import commands
from relieffab.job.sheet.drawing import Drawing
from relieffab.job.sheet.heed import heeds
from relieffab.job.sheet.pictures import Picture, pictures
from relieffab.job.sheet.words import mm, sides
from relieffab.job.stocks import stock_of
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

if TYPE_CHECKING:
    from jinja2 import Template


@cache
def _template() -> "Template":
    from jinja2 import Environment, PackageLoader, StrictUndefined

    there = Environment(
        loader=PackageLoader("relieffab.job.sheet"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    there.filters.update(mm=mm, sides=sides)
    return there.get_template("sheet.html")


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
    stock = Stock.of(report["slab"]) if "slab" in report else stock_of(job)
    shown = pictures(report, folders)
    kept = shown.pop("plan", None)
    return _template().render(
        report=report,
        job=job,
        title=str(report.get("model", {}).get("name", "relief")),
        heeds=heeds(report),
        pictures=shown,
        stock=stock,
        plans=_plans(report, stock, kept),
        section=section.draw(stock, _depth(report, job), report.get("machine")),
        zero=zero(stock),
        cutters=tools.cutters(report),
        programs=tools.programs(report),
        total=tools.total(report) if report.get("programs") else "",
        reaches=tools.reaches(report),
        checklist=checklist(report, stock),
        solids={name: report[name] for name in SOLIDS if name in report},
        hashes=_hashes(report),
        commands=commands(report),
    )


def _depth(report: Mapping[str, Any], job: Job) -> float:
    return float(report["relief"]["depth_mm"]) if "relief" in report else job.depth


def _plans(
    report: Mapping[str, Any], stock: Stock, kept: Picture | None
) -> list[tuple[str, Drawing]]:
    """Draw the stock once for each position, and say how it lies."""
    parts = report.get("programs", [])
    places = {part["placing"]: part["position"] for part in parts if "position" in part}
    travel = report["machine"]["travel"] if parts else None
    drawn = []
    for placing, place in (places or {"": None}).items():
        position = Position.of(place) if place else None
        lies = plan.lying(stock, position)
        here = [part for part in parts if part.get("placing", "") == placing]
        shown = plan.Plan(lies, position, plan.bounds_of(here, lies), travel, _seen(report, kept))
        words = f"Position {position.number} of {position.count}: {placing}" if position else ""
        drawn.append((words, plan.draw(shown)))
    return drawn


def _seen(report: Mapping[str, Any], kept: Picture | None) -> Any:
    """Find where on the panel the picture of the height field belongs."""
    if kept is None:
        return None
    relief = report["relief"]
    x, y = relief["origin_mm"]
    wide, tall = ((relief[name] - 1) * relief["pitch_mm"] for name in ("cols", "rows"))
    return kept.uri, np.array([x, y - tall]), np.array([x + wide, y])


def _hashes(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """List what was proved as `sha256sum` does: sum, file."""
    parts = [*report.get("aids", []), *report.get("programs", [])]
    found = {str(part["file"]): str(part["sha256"]) for part in parts}
    if report.get("relief", {}).get("sha256"):
        found[report["relief"]["file"]] = report["relief"]["sha256"]
    return [(value, name) for name, value in found.items()]
