"""What the person sees: results on stdout, progress and messages on stderr."""

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from relieffab.cli.interrupt import heeding
from relieffab.job.folder import SOLIDS
from relieffab.job.marked import styles_in
from relieffab.job.settings import Chosen
from relieffab.job.sheet.heed import heeds
from relieffab.progress import Progress, silent


@contextmanager
def progress_bar() -> Iterator[Progress]:
    """Show one bar a stage on stderr; nothing where that is no terminal."""
    if not sys.stderr.isatty():
        yield heeding(silent)
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bars

    columns = (
        TextColumn("{task.description:<10}"),
        BarColumn(),
        TextColumn("{task.fields[count]:>24}"),
        TimeRemainingColumn(),
    )
    # What is printed meanwhile goes above the bars, but not where it goes into a file.
    shared = sys.stdout.isatty()
    with Bars(*columns, console=Console(stderr=True), redirect_stdout=shared) as bars:
        tasks: dict[str, Any] = {}

        def show(stage: str, done: float, total: float, unit: str = "") -> None:
            if stage not in tasks:
                tasks[stage] = bars.add_task(stage, count="")
            count = f"{done:,.0f} of {total:,.0f} {unit}" if unit else ""
            bars.update(tasks[stage], completed=done, total=total, count=count)

        yield heeding(show)


def message(text: str) -> None:
    """Tell the person something beside the result."""
    print(text, file=sys.stderr)


def print_json(report: Mapping[str, Any]) -> None:
    """Print a report as JSON."""
    print(json.dumps(report, indent=2, ensure_ascii=False))


def notes(report: Mapping[str, Any]) -> list[str]:
    """Gather what the person should know of a job."""
    return [heed.text for heed in heeds(report) if heed.kind != "finding"]


def result(report: Mapping[str, Any], folder: Path, *, as_json: bool) -> int:
    """Print what was made; return the exit status: 1 if the solid has findings."""
    for note in notes(report):
        message(f"note: {note}")
    found = report.get(report["settings"].get("solid", ""), {}).get("findings", [])
    for finding in found:
        message(f"finding: {finding}")
    if as_json:
        print_json(report)
    else:
        _lines(report, folder)
    return 1 if found else 0


def _lines(report: Mapping[str, Any], folder: Path) -> None:
    if "relief" in report:
        relief = report["relief"]
        size = f"{relief['cols'] - 1} x {relief['rows'] - 1} pixels of {relief['pitch_mm']:.4f} mm"
        print(f"relief   {folder / relief['file']}  {size}, {relief['depth_mm']:g} mm deep")
    for style in styles_in(report):
        for place, found in style["measured"].items():
            _marks(f"{place} of {style['relief']}" if "relief" in style else place, found)
    for name in SOLIDS:
        if name in report:
            _solid(name, report[name], folder)
    if "template" in report:
        part = report["template"]
        pages = f"{part['pages']} page{'s' * (part['pages'] != 1)} of {part['paper']}"
        print(f"template {folder / part['file']}  {pages}; template.svg and contours.svg beside it")
    _programs(report, folder)
    if "picture" in report:
        picture = report["picture"]
        print(f"picture  {folder / picture['file']}  ({picture['method']})")
    print(f"report   {folder / 'report.json'}, {folder / 'report.html'}")


def _marks(place: str, found: Mapping[str, Any]) -> None:
    if found["depth_mm"] is None:
        print(f"marks    none on the {place}: there is no room for one")
        return
    apart = f"{found['spacing_mm']:.2f} mm apart, " if found["spacing_mm"] else ""
    print(
        f"marks    of the {place}: {apart}{found['depth_mm']:.2f} mm deep; their cutter leaves "
        f"at most {found['tolerance_mm']:g} mm on {found['within_tolerance']:.1%} of them"
    )


def _solid(name: str, part: Mapping[str, Any], folder: Path) -> None:
    tight = "watertight" if part["watertight"] else "NOT watertight"
    print(
        f"{name:<8} {folder / part['file']}  {part['triangles']:,} triangles, {tight}, "
        f"within {part['max_error_mm']:.3f} mm"
    )
    if "draft" in part:
        draft = part["draft"]
        print(f"draft    {draft['least_deg']:.2f} degrees or more, {draft['asked_deg']:g} asked")
    for tile in part.get("tiles", []):
        size = " x ".join(f"{side:.1f}" for side in tile["size_mm"])
        print(f"part     {folder / tile['file']}  {size} mm")


def _programs(report: Mapping[str, Any], folder: Path) -> None:
    from relieffab.job.sheet.words import clock

    placing = ""
    for part in report.get("programs", []):
        if part.get("placing", "") != placing:
            placing = part["placing"]
            place = part["position"]
            zero = "work zero at X {:g} Y {:g} mm of the panel".format(*place["zero"])
            print(f"position {place['number']} of {place['count']}: {placing}; {zero}")
        print(
            f"program  {folder / part['file']}  {part['cutter']['name']}, {part['lines']:,} lines, "
            f"{clock(part['seconds'])}"
        )
    if "verification" in report:
        verdict(report["verification"])


def verdict(part: Mapping[str, Any]) -> None:
    """Print what simulation found."""
    for note in part.get("notes", []):
        message(f"note: {note}")
    word = "carves the relief" if part["ok"] else "DOES NOT carve the relief"
    print(
        f"verified {word}: gouge {part['gouge_mm']:.4f} mm, "
        f"{part['within_tolerance']:.2%} of the figure within {part['tolerance_mm']:g} mm"
    )
    for seam in part.get("seams", []):
        one, other = seam["between"]
        print(f"seam     of positions {one} and {other}: 99 % within {seam['error_mm']:.3f} mm")
    for finding in part["findings"]:
        message(f"finding: {finding}")


def configuration(settings: Mapping[str, Chosen], *, as_json: bool) -> None:
    """Print every setting with where it comes from."""
    if as_json:
        table = {name: {"value": c.text, "origin": c.origin} for name, c in settings.items()}
        print(json.dumps(table, indent=2, ensure_ascii=False))
        return
    for name, choice in settings.items():
        print(f"{name:<15} {choice.text or '-':<20} {choice.origin}")
