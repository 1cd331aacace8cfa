"""From lines on the mesh to the strokes of a drawing."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains, resample
from relieffab.layers.lines.contrast import contrast_strength
from relieffab.layers.lines.creases import find_creases
from relieffab.layers.lines.drawing import Drawing
from relieffab.layers.lines.edges import Edges, find_edges
from relieffab.layers.lines.ends import lead_on
from relieffab.layers.lines.kinds import KINDS, PRINCIPAL, Kind
from relieffab.layers.lines.outline import outlines
from relieffab.layers.lines.snap import snap
from relieffab.layers.lines.surface import Surface, prepare
from relieffab.layers.lines.trace import (
    close_gaps,
    drop_short,
    hysteresis,
    narrowed,
    runs,
    simplify,
    soften,
)
from relieffab.layers.lines.visibility import borders_background, visible
from relieffab.layers.lines.zeros import edge_lines
from relieffab.layers.model import Stroke
from relieffab.layers.raster import Raster
from relieffab.layers.view import Placed

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LOW, HIGH = 0.25, 0.5
"""Strength at which a secondary line may go on, and what any line must reach somewhere."""
WELL_APART = 1.5
"""What a line must be off the stronger ones somewhere, in units of the spacing."""
SOFTNESS = 0.25
"""Deviation of the Gaussian along lines that cross triangles, as a share of the detail."""


@dataclass(frozen=True)
class _Line:
    """A line as it will be drawn, before it is simplified: X, Y, strength."""

    kind: str
    table: Floats
    closed: bool


@dataclass(frozen=True)
class _Rules:
    """Lengths that decide what becomes a stroke, in samples."""

    min_length: float
    gap: float
    fading: float
    spacing: float
    softness: float


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
    drawing = drawing or Drawing()
    step, min_length, spacing = grid.pitch, drawing.min_length, drawing.spacing
    rules = _Rules(
        min_length=min_length / step,
        gap=max(4.0, 0.2 * min_length / step),
        fading=0.5 * min_length / step,
        spacing=spacing / step,
        softness=SOFTNESS * drawing.detail / step,
    )
    outer = _outer(raster.mask, grid, min_length)
    drawn = list(outer)
    mesh = _Mesh.of(placed, drawing)
    for kind in KINDS:
        if kind.name not in drawing.kinds or kind.name == "outline":
            continue
        fine = resample(mesh.lines(kind), step)
        if kind.name == "contour":
            fine = snap(fine, raster.depth, grid)
        keep = visible(fine, raster.depth, grid)
        if kind.name == "contour":
            keep &= ~borders_background(fine, raster.mask, grid, reach=2.5 * step)
        if kind.name == "suggestive":
            telling = contrast_strength(fine, mesh.surface, raster, grid)
            fine = replace(fine, strength=np.minimum(fine.strength, telling))
        room = _room(fine.points[:, :2], drawn, spacing)
        if kind.of_surface is None:
            # A mesh's own edges come in pieces that meet, and may lie close.
            pieces = replace(rules, min_length=rules.min_length / 3)
            lines = _trace(kind.name, fine, keep, room, pieces)
        else:
            lines = _trace(kind.name, fine, keep, room, rules)
            lines = _thin_out(lines, spacing / 2 if kind.principal else spacing, rules)
        drawn += _meeting(lines, drawn, 2 * spacing)
    return tuple(_stroke(line, drawing) for line in drawn if line.kind in drawing.kinds)


def _outer(mask: Flags, grid: Grid, min_length: float) -> list[_Line]:
    lines = [points for points in outlines(mask, grid) if _length(points) >= min_length]
    return [
        _Line("outline", np.column_stack([points, np.ones(len(points))]), True)
        for points in sorted(lines, key=_length, reverse=True)
    ]


def _length(points: Floats) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


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
        return edge_lines(self.placed.vertices, self.edges.ends[here])


def _room(points: Floats, drawn: list[_Line], spacing: float) -> Floats:
    """Distance of points from the lines drawn before, in units of the spacing, 2 at most."""
    if not drawn or len(points) == 0:
        return np.full(len(points), 2.0)
    tree = cKDTree(np.concatenate([line.table[:, :2] for line in drawn]))
    far = max(2 * spacing, 1e-9)
    return np.minimum(tree.query(points, distance_upper_bound=far)[0], far) / (far / 2)


def _trace(kind: str, chains: Chains, keep: Flags, room: Floats, rules: _Rules) -> list[_Line]:
    """Cut the lines worth drawing out of sampled chains, the longest first."""
    lines = []
    for start, stop in pairwise(chains.begin):
        if keep[start:stop].sum() < rules.min_length / 2:
            continue
        here = slice(start, stop)
        table = np.column_stack([chains.points[here, :2], chains.strength[here]])
        lines += _cut(kind, table, keep[here], room[here], rules)
    return sorted(lines, key=lambda line: -len(line.table))


def _cut(kind: str, table: Floats, keep: Flags, room: Floats, rules: _Rules) -> list[_Line]:
    """Cut the lines worth drawing out of one."""
    closed = len(table) > 2 and bool((table[0, :2] == table[-1, :2]).all())
    if closed:
        first = int(np.argmin(keep))
        table = np.roll(table[:-1], -first, axis=0)
        keep, room = np.roll(keep[:-1], -first), np.roll(room[:-1], -first)
    sigma = 0.0 if kind in ("crease", "boundary") else rules.softness
    table = soften(table, sigma, closed=closed).copy()
    low = HIGH if kind in PRINCIPAL else LOW
    keep = close_gaps(keep, rules.gap) & close_gaps(table[:, 2] > low, rules.fading)
    table[:, 2] = np.maximum(table[:, 2], low)
    keep = close_gaps(hysteresis(keep, table[:, 2], HIGH), rules.gap)
    keep = _apart(keep, room, rules)
    if closed and keep.all():
        return [_Line(kind, table, True)]
    return [_Line(kind, table[a:b], False) for a, b in zip(*runs(keep), strict=True)]


def _apart(keep: Flags, room: Floats, rules: _Rules) -> Flags:
    """Keep what is long enough on its own, and lead it a little way to what it nears."""
    near = room < 1
    alone = drop_short(keep & close_gaps(~near, 2 * rules.spacing), rules.min_length)
    alone = hysteresis(alone, room, WELL_APART)
    return hysteresis(keep & ~narrowed(near, rules.spacing), alone.astype(np.float64), 1.0)


def _thin_out(lines: list[_Line], spacing: float, rules: _Rules) -> list[_Line]:
    """Leave out what runs beside a longer line of the same kind."""
    if not lines or spacing == 0:
        return lines
    owner = np.repeat(np.arange(len(lines)), [len(line.table) for line in lines])
    points = np.concatenate([line.table[:, :2] for line in lines])
    pairs = cKDTree(points).query_pairs(2 * spacing, output_type="ndarray")
    a, b = pairs[owner[pairs[:, 0]] != owner[pairs[:, 1]]].T
    room = np.full(len(points), 2.0)
    apart = np.hypot(*(points[a] - points[b]).T) / spacing
    np.minimum.at(room, np.where(owner[a] > owner[b], a, b), apart)
    out = []
    for k, line in enumerate(lines):
        clear = _apart(np.ones(len(line.table), bool), room[owner == k], rules)
        if clear.all():
            out.append(line)
            continue
        out += [_Line(line.kind, line.table[i:j], False) for i, j in zip(*runs(clear), strict=True)]
    return out


def _meeting(lines: list[_Line], drawn: Sequence[_Line], reach: float) -> list[_Line]:
    """Lead open lines on to what they all but reach."""
    closed = [line for line in lines if line.closed]
    tables = [line.table for line in lines if not line.closed]
    met = lead_on(tables, [line.table for line in [*drawn, *closed]], reach)
    fresh = iter(met)
    return [line if line.closed else replace(line, table=next(fresh)) for line in lines]


def _stroke(line: _Line, drawing: Drawing) -> Stroke:
    table = simplify(line.table, drawing.tolerance, closed=line.closed)
    share = 1.0 if line.kind in PRINCIPAL else drawing.secondary
    strength = share * np.clip(table[:, 2], 0.0, 1.0)
    return Stroke(table[:, :2], line.kind, strength, line.closed)
