"""A template as PDF pages at 1:1: the one place that knows reportlab."""

import io
from collections.abc import Iterable
from typing import Any

from relieffab.template.marks import PALE, Line, Mark, Text, cross, rectangle
from relieffab.template.model import BORDER, FOOT, Template, foot_marks, panel_marks
from relieffab.template.pages import EDGE, OVERLAP, Page, Tiling, tile

MM = 72 / 25.4
FONT = "Helvetica"
DRAWING = "drawing"


def pages_of(template: Template, paper: str) -> Tiling:
    """Say which pages the PDF of a template has.

    Parameters
    ----------
    template : Template
    paper : str
        One of `pages.PAPERS`.

    Raises
    ------
    InputError
        If they are too many.
    """
    across, high = template.size
    return tile((-BORDER, -BORDER), (across + BORDER, high + BORDER), paper, FOOT)


def to_pdf(template: Template, paper: str) -> bytes:
    """Write a template as PDF; the same template gives the same bytes.

    Every page shows its window of the drawing, a scale bar, the depths' colours
    and its name; neighbours overlap by 10 mm and share crosses to lay them by.

    Parameters
    ----------
    template : Template
    paper : str
        One of `pages.PAPERS`.

    Raises
    ------
    InputError
        If it takes too many pages.
    """
    from reportlab.pdfgen.canvas import Canvas

    tiling = pages_of(template, paper)
    file = io.BytesIO()
    page_size = tuple(MM * side for side in tiling.paper)
    canvas = Canvas(file, pagesize=page_size, invariant=1, pageCompression=1)
    canvas.setTitle(_known(template.title))
    canvas.setAuthor("")
    canvas.setSubject("Template at 1:1")
    canvas.setCreator("relieffab")
    across, high = template.size
    # Drawn once, shown by every page.
    canvas.beginForm(DRAWING, -BORDER, -BORDER, across + BORDER, high + BORDER)
    for marks in panel_marks(template).values():
        _draw(canvas, marks)
    canvas.endForm()
    for page in tiling.pages():
        canvas.scale(MM, MM)
        _page(canvas, template, tiling, page)
        canvas.showPage()
    canvas.save()
    return file.getvalue()


def _page(canvas: Any, template: Template, tiling: Tiling, page: Page) -> None:
    """Draw one page: the window, and below it the foot."""
    wide, tall = tiling.window
    canvas.saveState()
    window = canvas.beginPath()
    window.rect(EDGE, EDGE + FOOT, wide, tall)
    canvas.clipPath(window, stroke=0)
    canvas.translate(EDGE - page.x, EDGE + FOOT - page.y)
    canvas.doForm(DRAWING)
    for x, y in tiling.joints():
        _draw(canvas, cross(x, y))
    canvas.restoreState()
    right = EDGE + wide
    marks = foot_marks(template, EDGE, EDGE)
    marks.append(rectangle(EDGE, EDGE + FOOT, right, EDGE + FOOT + tall, PALE))
    name = f"{page.name} of {tiling.last}"
    marks.append(Text(right, EDGE + 16.0, name, size=5.0, anchor="end"))
    if len(tiling.pages()) > 1:
        words = f"pages overlap by {OVERLAP:g} mm: lay cross on cross"
        marks.append(Text(right, EDGE + 0.8, words, anchor="end"))
    _draw(canvas, marks)


def _draw(canvas: Any, marks: Iterable[Mark]) -> None:
    for mark in marks:
        if isinstance(mark, Line):
            _line(canvas, mark)
        else:
            _text(canvas, mark)


def _line(canvas: Any, line: Line) -> None:
    from reportlab.lib.colors import HexColor

    canvas.setStrokeColor(HexColor(line.colour))
    canvas.setLineWidth(line.width)
    canvas.setLineCap(1)
    canvas.setLineJoin(1)
    path = canvas.beginPath()
    points = line.points.tolist()
    path.moveTo(*points[0])
    for point in points[1:]:
        path.lineTo(*point)
    if line.closed:
        path.close()
    canvas.drawPath(path, stroke=1, fill=0)


def _text(canvas: Any, text: Text) -> None:
    from reportlab.lib.colors import HexColor
    from reportlab.pdfbase.pdfmetrics import stringWidth

    words = _known(text.words)
    share = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor]
    canvas.saveState()
    canvas.translate(text.x, text.y)
    canvas.rotate(text.angle)
    canvas.setFont(FONT, text.size)
    canvas.setFillColor(HexColor(text.colour))
    start = -share * stringWidth(words, FONT, text.size)
    canvas.drawString(start, 0, words)
    canvas.restoreState()


def _known(words: str) -> str:
    """Keep the letters that a PDF's own fonts have."""
    return words.encode("cp1252", "replace").decode("cp1252")
