"""From a mesh as it is seen to the strokes of a drawing."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains, resample
from relieffab.layers.lines.contrast import contrast_strength
from relieffab.layers.lines.creases import find_creases
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.edges import Edges, find_edges
from relieffab.layers.lines.kinds import KINDS, Kind
from relieffab.layers.lines.names import PRINCIPAL
from relieffab.layers.lines.outline import outlines
from relieffab.layers.lines.snap import snap
from relieffab.layers.lines.surface import Surface, prepare
from relieffab.layers.lines.tidy import Line, Rules, tidy
from relieffab.layers.lines.trace import length, simplify
from relieffab.layers.lines.visibility import borders_background, visible
from relieffab.layers.lines.zeros import edge_lines
from relieffab.layers.model import Stroke
from relieffab.layers.raster import Raster
from relieffab.layers.shading import face_normals
from relieffab.layers.view import Placed

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


def draw_strokes(
    placed: Placed, raster: Raster, grid: Grid, drawing: Drawing | None = None
) -> tuple[Stroke, ...]:
    """Draw what is seen of a mesh in lines.

    Parameters
    ----------
    placed : Placed
    raster : Raster
        Of the same mesh on the grid.
    grid : Grid
    drawing : Drawing, optional

    Returns
    -------
    tuple of Stroke
        Kind by kind, principal ones first, of each the longest first.
    """
    drawing = visible_lengths(drawing or Drawing(), grid.pitch)
    mesh = _Mesh.of(placed, drawing)
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


def _seen(kind: Kind, mesh: "_Mesh", raster: Raster, grid: Grid) -> tuple[Chains, Flags]:
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


@dataclass(frozen=True, eq=False)
class _Mesh:
    """A mesh with all its lines, seen or not."""

    placed: Placed
    edges: Edges
    creases: Flags
    surface: Surface

    @classmethod
    def of(cls, placed: Placed, drawing: Drawing) -> "_Mesh":
        edges = find_edges(placed.faces, len(placed.solid))
        creases = find_creases(placed.solid, placed.faces, edges, drawing.min_length)
        surface = prepare(
            placed.solid, placed.faces, creases, edges, detail=drawing.detail, eye=placed.eye
        )
        return cls(placed, edges, creases, surface)

    def lines(self, kind: Kind) -> Chains:
        if kind.of_surface is not None:
            return kind.of_surface(self.surface)
        here = self.creases if kind.name == "crease" else self.edges.faces[:, 1] < 0
        sides = self.edges.faces[here]
        seen = face_normals(self.placed.vertices, self.placed.faces[sides.ravel()])
        sine = np.hypot(seen[:, 0], seen[:, 1]) / np.maximum(np.linalg.norm(seen, axis=1), 1e-300)
        gentler = sine.reshape(-1, 2).min(axis=1)
        return edge_lines(self.placed.vertices, self.edges.ends[here], gentler)


def to_stroke(line: Line, drawing: Drawing) -> Stroke:
    """Leave out what a line does not need, and weigh it by its kind."""
    table = simplify(line.table, drawing.tolerance, closed=line.closed)
    share = 1.0 if line.kind in PRINCIPAL else drawing.secondary
    strength = share * np.clip(table[:, 2], 0.0, 1.0)
    return Stroke(table[:, :2], line.kind, strength, line.closed)
