"""What a job makes of the drawing in its folder: strokes again, and the template."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.job.settings import Job
from relieffab.job.stocks import stock_of
from relieffab.layers.lines.svg import strokes_from_svg
from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief
from relieffab.template.model import make_template
from relieffab.template.pdf import pages_of, to_pdf
from relieffab.template.svg import to_svg


def read_strokes(folder: Path) -> tuple[Stroke, ...]:
    """Read the drawing that `looking.write_layers` left.

    Raises
    ------
    InputError
        If there is none, or it is not as it was written.
    """
    drawing = folder / "layers" / "lines.svg"
    if not drawing.is_file():
        raise InputError("the job has no drawing", where=str(drawing))
    return strokes_from_svg(drawing.read_text(encoding="utf-8"), where=str(drawing))


def write_template(
    relief: Relief, strokes: Sequence[Stroke], job: Job, folder: Path, *, name: str
) -> dict[str, Any]:
    """Write the template, one sheet and pages, and the depth contours alone.

    The part is report.json's `template`.
    """
    template = make_template(relief, strokes, stock_of(job), line_width=job.line_width, name=name)
    (folder / "template.svg").write_text(to_svg(template), encoding="utf-8")
    (folder / "contours.svg").write_text(to_svg(replace(template, strokes=())), encoding="utf-8")
    (folder / "template.pdf").write_bytes(to_pdf(template, job.paper))
    return {
        "file": "template.pdf",
        "files": ["template.svg", "contours.svg", "template.pdf"],
        "paper": job.paper,
        "pages": len(pages_of(template, job.paper).pages()),
        "contour_step_mm": template.step,
    }
