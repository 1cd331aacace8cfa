"""The folder of a job: its page, and the picture that stands for it."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.job.folder import LAYERS
from relieffab.job.report import read_report
from relieffab.job.sheet.heed import heeds
from relieffab.job.show.image import read_image
from relieffab.job.show.shown import Shown, stock_facts
from relieffab.stock import Stock

PAGE = "report.html"


def show_folder(folder: Path) -> Shown:
    """Show a job: report.html; preview.png, or the three layers where there is none."""
    report = read_report(folder)
    page = folder / PAGE
    if not page.is_file():
        raise InputError("the job's page is missing", expected=PAGE, where=str(folder))
    notes = tuple(f"{heed.kind}: {heed.text}" for heed in heeds(report))
    return Shown("job", _facts(report), _picture(report, folder), page, notes)


def show_layers(folder: Path) -> Shown:
    """Show the three images of a model beside each other."""
    images = [read_image(folder.parent / name) for name in LAYERS if name.endswith(".png")]
    return Shown("picture", {"layers": ["depth", "shading", "lines"]}, np.hstack(images))


def _picture(report: Mapping[str, Any], folder: Path) -> NDArray[np.uint8] | None:
    if "picture" in report:
        return read_image(folder / report["picture"]["file"])
    return show_layers(folder / "layers").image if "view" in report else None


def _facts(report: Mapping[str, Any]) -> dict[str, Any]:
    facts: dict[str, Any] = {"model": report["model"]["name"]}
    if "relief" in report:
        facts["depth_mm"] = report["relief"]["depth_mm"]
    if "slab" in report:
        facts |= stock_facts(Stock.of(report["slab"]))
    if report.get("programs"):
        facts["machine"] = report["machine"]["name"]
        facts["material"] = report["material"]["name"]
        facts["cutters"] = list(dict.fromkeys(p["cutter"]["name"] for p in report["programs"]))
        facts["programs"] = list(dict.fromkeys(part["file"] for part in report["programs"]))
        facts["seconds"] = round(sum(part["seconds"] for part in report["programs"]), 1)
    if "verification" in report:
        facts["carves_the_relief"] = report["verification"]["ok"]
    return facts
