"""From a mesh as it is seen to the strokes of a drawing."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains, resample
from relieffab.layers.lines.contrast import contrast_strength
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.kinds import KINDS, Kind
from relieffab.layers.lines.names import PRINCIPAL
from relieffab.layers.lines.outline import outlines
from relieffab.layers.lines.snap import snap
from relieffab.layers.lines.study import Study
from relieffab.layers.lines.tidy import Line, Rules, tidy
from relieffab.layers.lines.trace import length, simplify
from relieffab.layers.lines.visibility import borders_background, visible
from relieffab.layers.model import Stroke
from relieffab.layers.raster import Raster
from relieffab.layers.view import Placed

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


def draw_strokes(
    placed: Placed,
    raster: Raster,
    grid: Grid,
    drawing: Drawing | None = None,
    *,
    study: Study | None = None,
) -> tuple[Stroke, ...]:
    """Draw what is seen of a mesh in lines.

    Parameters
    ----------
    placed : Placed
    raster : Raster
        Of the same mesh on the grid.
    grid : Grid
    drawing : Drawing, optional
    study : Study, optional
        Of the same mesh as placed, by `visible_lengths` of the drawing; made if not given.

    Returns
    -------
    tuple of Stroke
        Kind by kind, principal ones first, of each the longest first.
    """
    drawing = visible_lengths(drawing or Drawing(), grid.pitch)
    mesh = study or Study.of(placed, drawing)
    drawn = outer_lines(raster.mask, grid, drawing.min_length)
    for kind in KINDS:
        if kind.name in drawing.kinds and kind.name != "outline":
            chains, keep = _seen(kind, mesh, raster, grid)
            drawn += tidy(kind.name, chains, keep, drawn, Rules.of(kind, drawing, grid.pitch))
    return tuple(to_stroke(line, drawing) for line in drawn if line.kind in drawing.kinds)


def visible_lengths(drawing: Drawing, pitch: float) -> Drawing:
    """Raise lengths that no picture of this pitch could show, but for those set to 0."""
    least = {"detail": 4 * pitch, "min_length": 12 * pitch, "spacing": 3 * pitch}
    return replace(
        drawing,
        **{
            name: max(getattr(drawing, name), floor)
            for name, floor in least.items()
            if getattr(drawing, name) > 0
        },
    )


def outer_lines(mask: Flags, grid: Grid, min_length: float) -> list[Line]:
    """Draw the figure's outline, the longest part first."""
    lines = [points for points in outlines(mask, grid) if length(points) >= min_length]
    return [
        Line("outline", np.column_stack([points, np.ones(len(points))]), True)
        for points in sorted(lines, key=length, reverse=True)
    ]


def _seen(kind: Kind, mesh: Study, raster: Raster, grid: Grid) -> tuple[Chains, Flags]:
    """All lines of a kind, sampled at the pitch, and which samples are seen."""
    chains = resample(mesh.lines(kind), grid.pitch)
    keep = np.ones(len(chains.points), bool)
    if kind.name == "contour":
        chains, keep = snap(chains, raster.depth, grid)
        keep &= ~borders_background(chains, raster.mask, grid, reach=2.5 * grid.pitch)
    if kind.name == "suggestive":
        telling = contrast_strength(chains, mesh.surface, raster, grid)
        chains = replace(chains, strength=np.minimum(chains.strength, telling))
    return chains, keep & visible(chains, raster.depth, grid)


def to_stroke(line: Line, drawing: Drawing) -> Stroke:
    """Leave out what a line does not need, and weigh it by its kind."""
    table = simplify(line.table, drawing.tolerance, closed=line.closed)
    share = 1.0 if line.kind in PRINCIPAL else drawing.secondary
    strength = share * np.clip(table[:, 2], 0.0, 1.0)
    return Stroke(table[:, :2], line.kind, strength, line.closed)
