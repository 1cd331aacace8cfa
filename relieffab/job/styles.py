"""The style of a job: its marks on the relief, in files, and in the report."""

from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from relieffab import profiles
from relieffab.grid import Grid
from relieffab.job.folder import MARKS
from relieffab.job.settings import Job
from relieffab.job.stocks import stock_of
from relieffab.layers.lines.names import MARK
from relieffab.layers.lines.svg import strokes_from_svg, strokes_to_svg
from relieffab.layers.model import Layers, Stroke
from relieffab.relief.model import Relief
from relieffab.relief.store import read_relief, to_tiff
from relieffab.relief.style.make import BORDER, carve_marks
from relieffab.relief.style.measure import measure
from relieffab.relief.style.model import Marks, Style

Part = dict[str, Any]

SMOOTH, LINES = MARKS


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
            "files": list(MARKS),
        },
    )


def _number(value: float) -> float | None:
    return round(value, 4) if isfinite(value) else None


def write_marks(marks: Marks, job: Job, folder: Path) -> None:
    """Write what `read_marks` reads: the relief before the marks, and their lines."""
    (folder / SMOOTH).write_bytes(to_tiff(marks.smooth))
    drawn = [Stroke(line, MARK, np.ones(len(line))) for line in marks.lines]
    drawing = strokes_to_svg(drawn, job.size, width=job.line_width)
    (folder / LINES).write_text(drawing, encoding="utf-8")


def read_marks(folder: Path, job: Job) -> Marks | None:
    """Read the marks of a job's folder; None where its relief has none of its own.

    A panel composed of others has marks and none of their lines: its programs cut
    them as any other form.
    """
    if not (folder / SMOOTH).is_file():
        return None
    where = folder / LINES
    lines = strokes_from_svg(where.read_text(encoding="utf-8"), where=str(where))
    smooth = read_relief(folder / SMOOTH)
    return Marks(style_of(job).tool, smooth, tuple(stroke.points for stroke in lines))
