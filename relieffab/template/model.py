"""Template: what stands on the paper, and how it is made of a relief."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.lines.names import NAMES
from relieffab.layers.lines.svg import pen_width
from relieffab.layers.model import Stroke
from relieffab.outline import Outline
from relieffab.relief.model import Relief
from relieffab.stock import Stock
from relieffab.template.contours import Contour, depth_contours, depth_text
from relieffab.template.labels import depth_labels
from relieffab.template.marks import (
    INK,
    LIGHT,
    Line,
    Mark,
    Text,
    cross,
    plain,
    polyline,
    scale_bar,
)

Floats = NDArray[np.float64]

STEPS = 5
COLOURS = ["#12908e", "#2a62d4", "#7a35c0", "#c2207e"]
"""Of the contours between the steps, the deepest last."""
BESIDE = 5.0  # mm from the panel's corners to the crosses there
BORDER = 9.0  # mm around the panel that its crosses need
FOOT = 24.0  # mm high: scale, key and title


@dataclass(frozen=True, eq=False)
class Template:
    """A drawing of a panel at 1:1.

    Parameters
    ----------
    size : tuple of float
        The panel's X and Y, mm; its near left corner is the origin.
    edges : tuple of (n, 2) ndarray
        The panel's outline, its frame's and its holes', closed, mm.
    title : str
    step : float
        Between depth contours, mm.
    contours : tuple of Contour
    labels : tuple of Line or Text
        The contours' depths, and gaps for them.
    strokes : tuple of Stroke
        The drawn lines; none for a map of the depth alone.
    line_width : float
        Of lines that bound a form, mm.
    """

    size: tuple[float, float]
    edges: tuple[Floats, ...]
    title: str
    step: float
    contours: tuple[Contour, ...]
    labels: tuple[Mark, ...]
    strokes: tuple[Stroke, ...]
    line_width: float


def make_template(
    relief: Relief,
    strokes: Sequence[Stroke],
    stock: Stock,
    *,
    line_width: float = 0.6,
    name: str = "relief",
) -> Template:
    """Draw a relief: its lines, and contours at every fifth of its depth.

    Parameters
    ----------
    relief : Relief
    strokes : sequence of Stroke
    stock : Stock
        The panel.
    line_width : float, optional
        Of lines that bound a form, mm; the others are half as wide.
    name : str, optional
        Of what is carved.
    """
    step = relief.depth / STEPS
    contours = depth_contours(relief, step)
    across, high = stock.width, stock.height
    title = (
        f"{plain(name)}: {across:g} x {high:g} mm, {relief.depth:g} mm deep, "
        f"contours every {depth_text(step)} mm"
    )
    labels = depth_labels(contours, relief, strokes, COLOURS)
    return Template(
        (across, high),
        edges_of(stock),
        title,
        step,
        tuple(contours),
        tuple(labels),
        tuple(strokes),
        line_width,
    )


def edges_of(stock: Stock) -> tuple[Floats, ...]:
    """Draw a stock seen from above: outline, frame, holes; each closed, mm."""
    found = [stock.outline.polygon()]
    if stock.frame:
        found += [stock.outline.polygon(by=by) for by in sorted({stock.frame.width, stock.rim})]
    for hole in stock.holes:
        for across in {hole.diameter, 2 * hole.radius}:
            circle = Outline("round", across, across).polygon()
            found.append(circle + hole.at - across / 2)
    return tuple(found)


def panel_marks(template: Template) -> dict[str, list[Mark]]:
    """Gather what lies on the panel, by layer, in the panel's own coordinates."""
    across, high = template.size
    panel: list[Mark] = [Line(edge, closed=True) for edge in template.edges]
    for x in (-BESIDE, across + BESIDE):
        for y in (-BESIDE, high + BESIDE):
            panel += cross(x, y)
    contours: list[Mark] = [
        Line(contour.points, COLOURS[contour.level - 1], closed=True)
        for contour in template.contours
    ]
    layers = {"panel": panel, "depth contours": contours}
    for kind in NAMES:
        lines: list[Mark] = [
            Line(
                stroke.points,
                LIGHT if stroke.light else INK,
                pen_width(kind, template.line_width),
                stroke.closed,
            )
            for stroke in template.strokes
            if stroke.kind == kind
        ]
        if lines:
            layers[kind] = lines
    # Over the lines: a depth must be legible.
    return {**layers, "depths": [*template.labels]}


def foot_marks(template: Template, x: float, y: float) -> list[Mark]:
    """Lay out scale, key and title from (x, y) up, `FOOT` high."""
    marks = scale_bar(x, y + 18.5)
    marks.append(Text(x, y + 10.3, "depth in mm"))
    for k, colour in enumerate(COLOURS):
        start = x + 24 + 20 * k
        marks.append(polyline([(start, y + 11.2), (start + 8, y + 11.2)], colour, 0.5))
        words = depth_text((k + 1) * template.step)
        marks.append(Text(start + 9.5, y + 10.3, words, colour=colour))
    marks.append(Text(x, y + 5.4, template.title))
    marks.append(Text(x, y + 0.8, "print at 100 % (actual size): the bar measures 100 mm"))
    return marks
