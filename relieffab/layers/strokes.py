"""From lines on the mesh to the strokes of a drawing."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers import contours
from relieffab.layers.chains import Chains, find_edges, resample
from relieffab.layers.drawing import line_image, strokes_to_svg
from relieffab.layers.model import Stroke
from relieffab.layers.outline import outlines
from relieffab.layers.raster import Raster
from relieffab.layers.trace import close_gaps, drop_short, hysteresis, runs, simplify, soften
from relieffab.layers.visibility import borders_background, visible

__all__ = ["draw_strokes", "line_image", "strokes_to_svg"]

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LOW, HIGH = {"suggestive": 0.25}, 0.5
"""Strength at which a line may go on (HIGH if not named), and what it must reach somewhere."""
SOFTNESS = 3.0
"""Deviation of the Gaussian along lines that cross triangles, samples."""
AHEAD = 6
"""Samples from a line's end that tell where it is heading."""
CREASE_ANGLE = 40.0
"""Faces that differ by more, in degrees, meet at a crease."""


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
    crossing: float


def draw_strokes(
    vertices: Floats,
    faces: NDArray[np.integer],
    raster: Raster,
    grid: Grid,
    *,
    detail: float = 1.2,
    min_length: float = 2.5,
    spacing: float = 0.6,
    tolerance: float = 0.01,
    view: Floats | None = None,
) -> tuple[Stroke, ...]:
    """Draw what is seen of a mesh in lines.

    Parameters
    ----------
    vertices : (v, 3) ndarray
        On the panel, mm, Z towards the viewer.
    faces : (f, 3) ndarray of int
        Outward-oriented where closed.
    raster : Raster
        Of the same mesh on the grid.
    grid : Grid
    detail : float
        Forms of this wavelength lose half their height before lines are sought,
        finer ones more, mm; 0 keeps all.
    min_length : float
        Shorter lines are left out, mm.
    spacing : float
        A weaker line that runs nearer than this beside a stronger one is left
        out, mm.
    tolerance : float
        How far a stroke may be simplified, mm.
    view : (v, 3) ndarray, optional
        Unit vectors from the surface to the viewer; along Z if not given.

    Returns
    -------
    tuple of Stroke
        Kind by kind, the longest first.
    """
    _refuse_no_lengths(detail=detail, min_length=min_length, spacing=spacing, tolerance=tolerance)
    step = grid.pitch
    rules = _Rules(min_length / step, max(4.0, 0.2 * min_length / step), 2 * spacing / step)
    vertices = np.asarray(vertices, dtype=np.float64)
    outer = _outer(raster.mask, grid, min_length)
    drawn = list(outer)
    found = _found(vertices, np.asarray(faces), detail=detail, shortest=min_length, view=view)
    for chains in found:
        fine = resample(chains, step)
        keep = visible(fine, raster.depth, grid)
        if chains.kind == "contour":
            keep &= ~borders_background(fine, raster.mask, grid, reach=2.5 * step)
        near = _near(fine.points[:, :2], drawn, spacing)
        lines = _trace(fine, keep, near, rules)
        if chains.kind == "contour":
            lines = _reach_outline(lines, outer, spacing + 2 * step)
        if chains.kind == "suggestive":
            lines = _thin_out(lines, spacing, rules)
        drawn += lines
    strokes = [_stroke(line, tolerance) for line in drawn]
    return tuple(sorted(strokes, key=lambda stroke: stroke.kind))


def _refuse_no_lengths(**lengths: float) -> None:
    for name, value in lengths.items():
        if not (np.isfinite(value) and value >= 0):
            raise InputError(
                f"{name} of the lines is not a length", expected="0 mm or more", found=f"{value} mm"
            )


def _outer(mask: Flags, grid: Grid, min_length: float) -> list[_Line]:
    lines = [points for points in outlines(mask, grid) if _length(points) >= min_length]
    return [
        _Line("outline", np.column_stack([points, np.ones(len(points))]), True)
        for points in sorted(lines, key=_length, reverse=True)
    ]


def _length(points: Floats) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _found(
    vertices: Floats,
    faces: NDArray[np.integer],
    *,
    detail: float,
    shortest: float,
    view: Floats | None,
) -> Iterator[Chains]:
    """All lines on the mesh, seen or not, the stronger kinds first."""
    edges = find_edges(faces, len(vertices))
    sharp = contours.sharp_edges(vertices, faces, edges, CREASE_ANGLE)
    sharp = contours.lasting_creases(vertices, edges, sharp, shortest)
    surface = contours.prepare(vertices, faces, sharp, edges, detail=detail, view=view)
    yield contours.contours(surface)
    yield contours.edge_lines(vertices, edges.ends[edges.faces[:, 1] < 0], "boundary")
    yield contours.edge_lines(vertices, edges.ends[sharp], "crease")
    yield contours.suggestive(surface)


def _near(points: Floats, drawn: list[_Line], spacing: float) -> Flags:
    """Tell which points lie within `spacing` mm of a line drawn before."""
    if not drawn or len(points) == 0:
        return np.zeros(len(points), bool)
    tree = cKDTree(np.concatenate([line.table[:, :2] for line in drawn]))
    return np.isfinite(tree.query(points, distance_upper_bound=spacing)[0])


def _trace(chains: Chains, keep: Flags, near: Flags, rules: _Rules) -> list[_Line]:
    """Cut the lines worth drawing out of sampled chains, the longest first."""
    lines = []
    for start, stop in pairwise(chains.begin):
        if keep[start:stop].sum() < rules.min_length / 2:
            continue
        here = slice(start, stop)
        table = np.column_stack([chains.points[here, :2], chains.strength[here]])
        lines += _cut(chains.kind, table, keep[here], near[here], rules)
    return sorted(lines, key=lambda line: -len(line.table))


def _cut(kind: str, table: Floats, keep: Flags, near: Flags, rules: _Rules) -> list[_Line]:
    """Cut the lines worth drawing out of one."""
    closed = len(table) > 2 and bool((table[0, :2] == table[-1, :2]).all())
    if closed:
        first = int(np.argmin(keep))
        table = np.roll(table[:-1], -first, axis=0)
        keep, near = np.roll(keep[:-1], -first), np.roll(near[:-1], -first)
    sigma = 0.0 if kind in ("crease", "boundary") else SOFTNESS
    table = soften(table, sigma, closed=closed)
    keep = close_gaps(keep, rules.gap)
    keep = hysteresis(keep, table[:, 2], LOW.get(kind, HIGH), HIGH)
    keep = close_gaps(keep, rules.gap)
    keep = drop_short(keep & close_gaps(~near, rules.crossing, ends=True), rules.min_length)
    if closed and keep.all():
        return [_Line(kind, table, True)]
    return [_Line(kind, table[a:b], False) for a, b in zip(*runs(keep), strict=True)]


def _thin_out(lines: list[_Line], spacing: float, rules: _Rules) -> list[_Line]:
    """Leave out what runs beside a longer line of the same kind."""
    if not lines:
        return lines
    owner = np.repeat(np.arange(len(lines)), [len(line.table) for line in lines])
    points = np.concatenate([line.table[:, :2] for line in lines])
    pairs = cKDTree(points).query_pairs(spacing, output_type="ndarray")
    a, b = pairs[owner[pairs[:, 0]] != owner[pairs[:, 1]]].T
    near = np.zeros(len(points), bool)
    near[np.where(owner[a] > owner[b], a, b)] = True
    out = []
    for k, line in enumerate(lines):
        clear = close_gaps(~near[owner == k], rules.crossing, ends=True)
        if clear.all():
            out.append(line)
            continue
        clear = drop_short(clear, rules.min_length)
        out += [_Line(line.kind, line.table[i:j], False) for i, j in zip(*runs(clear), strict=True)]
    return out


def _reach_outline(lines: list[_Line], outer: list[_Line], reach: float) -> list[_Line]:
    """Lead open ends that stop within `reach` mm of the outline up to it."""
    if not outer:
        return lines
    rim = np.concatenate([line.table for line in outer])
    tree = cKDTree(rim[:, :2])

    def _lead(table: Floats) -> Floats:
        """Add a point of the outline before the first one, the one most straight ahead."""
        ahead = table[0, :2] - table[min(AHEAD, len(table) - 1), :2]
        within = np.array(tree.query_ball_point(table[0, :2], reach), dtype=np.int64)
        jump = rim[within, :2] - table[0, :2]
        onward = jump @ ahead
        aside = np.abs(jump[:, 0] * ahead[1] - jump[:, 1] * ahead[0])
        if not (onward > aside).any():
            return table
        best = within[np.where(onward > aside, aside, np.inf).argmin()]
        return np.concatenate([rim[best : best + 1], table])

    return [
        line if line.closed else _Line(line.kind, _lead(_lead(line.table)[::-1])[::-1], False)
        for line in lines
    ]


def _stroke(line: _Line, tolerance: float) -> Stroke:
    table = simplify(line.table, tolerance, closed=line.closed)
    return Stroke(table[:, :2], line.kind, np.clip(table[:, 2], 0.0, 1.0), line.closed)
