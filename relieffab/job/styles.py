"""The style of a job: its marks on the relief, in files, and in the report."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from itertools import count
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from relieffab import profiles
from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.job.folder import SMOOTH
from relieffab.job.marked import styles_in
from relieffab.job.settings import Job
from relieffab.job.stocks import stock_of
from relieffab.layers.lines.names import MARK
from relieffab.layers.lines.svg import strokes_from_svg, strokes_to_svg
from relieffab.layers.model import Layers, Stroke
from relieffab.relief.model import Floats, Relief
from relieffab.relief.store import read_relief, to_tiff
from relieffab.relief.style.make import BORDER, carve_marks
from relieffab.relief.style.measure import measure
from relieffab.relief.style.model import Marks, Style

Part = dict[str, Any]

LINES = "layers/marks.svg"


def style_of(job: Job) -> Style:
    """Return the style that a job asks for."""
    return Style(
        job.style,
        spacing=job.mark_spacing,
        depth=job.mark_depth,
        direction=job.mark_direction,
        cutter=profiles.cutter(job.mark_cutter) if job.mark_cutter else None,
        ground=job.ground,
    )


def check(job: Job) -> None:
    """Refuse marks that the relief cannot hold or its pixels cannot show."""
    style = style_of(job)
    if not style.plain:
        style.check(job.depth, Grid.on_panel(job.size, job.resolution).pitch)


def carve(smooth: Relief, layers: Layers, job: Job) -> tuple[Relief, Marks]:
    """Carve the marks of a job's style."""
    style = style_of(job)
    stock, grid = stock_of(job), smooth.grid
    # What stands beside the face keeps every cutter off by half its width.
    cutters = (job.rough, job.finish, job.lines)
    widest = max(style.tool.radius, *(profiles.cutter(name).radius for name in cutters))
    x, y = np.meshgrid(*grid.node_axes())
    ground = stock.on_face(x, y, max(BORDER, widest if stock.top > 0 else 0.0))
    return carve_marks(smooth, layers, style, depth=job.depth, ground=ground)


def mark(smooth: Relief, layers: Layers, job: Job) -> tuple[Relief, Marks, Part]:
    """Carve the marks and measure them; the part is report.json's `style`."""
    style = style_of(job)
    relief, marks = carve(smooth, layers, job)
    chisel = style.chisel
    measured = {
        place: {
            "spacing_mm": _number(found.spacing),
            "depth_mm": _number(found.depth),
            "area_mm2": _number(found.area),
            "within_tolerance": _number(found.within),
            "left_p99_mm": _number(found.left),
            "tolerance_mm": found.tolerance,
        }
        for place, found in measure(relief, marks, style).items()
    }
    return (
        relief,
        marks,
        {
            "marks": style.marks,
            "ground": style.ground,
            "spacing_mm": chisel.spacing,
            "depth_mm": chisel.depth,
            "direction_deg": style.direction,
            "cutter": asdict(style.tool),
            "strokes": len(marks.lines),
            "measured": measured,
            "files": [SMOOTH, LINES],
        },
    )


def _number(value: float) -> float | None:
    return round(value, 4) if isfinite(value) else None


def _drawings() -> Iterator[str]:
    """Name the files of the marks' lines, one a cutter."""
    yield LINES
    stem, _, kind = LINES.rpartition(".")
    yield from (f"{stem}-{k}.{kind}" for k in count(2))


def write_marks(marks: Sequence[Marks], job: Job, folder: Path) -> None:
    """Write what `read_marks` reads: the relief before the marks, and their lines.

    Parameters
    ----------
    marks : sequence of Marks
        One for each cutter, in the order in which the report's styles name them; one at least.
    job : Job
    folder : Path
    """
    (folder / SMOOTH).write_bytes(to_tiff(marks[0].smooth))
    for one, file in zip(marks, _drawings(), strict=False):
        drawn = [Stroke(line, MARK, np.ones(len(line))) for line in one.lines]
        drawing = strokes_to_svg(drawn, job.size, width=job.line_width)
        (folder / file).write_text(drawing, encoding="utf-8")


def read_marks(folder: Path, report: Mapping[str, Any]) -> tuple[Marks, ...]:
    """Read the marks of a job's folder, one for each cutter; none where its relief has none."""
    cutters = dict.fromkeys(Cutter(**style["cutter"]) for style in styles_in(report))
    if not cutters:
        return ()
    smooth = read_relief(folder / SMOOTH)
    return tuple(
        Marks(cutter, smooth, _lines(folder / file))
        for cutter, file in zip(cutters, _drawings(), strict=False)
    )


def _lines(where: Path) -> tuple[Floats, ...]:
    found = strokes_from_svg(where.read_text(encoding="utf-8"), where=str(where))
    return tuple(stroke.points for stroke in found)
