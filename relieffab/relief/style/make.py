"""A smooth relief to one that bears a chisel's marks."""

from collections.abc import Sequence
from dataclasses import replace
from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.relief.groove import inked
from relieffab.relief.model import Relief, inner_nodes, nodes_of, pixel_slopes
from relieffab.relief.reach import lowest_tips
from relieffab.relief.style.contact import axes, guarded_tips, kept_up, leaning
from relieffab.relief.style.field import fixed_field, form_field
from relieffab.relief.style.hatch import darkness
from relieffab.relief.style.model import Marks, Style, mark_width
from relieffab.relief.style.names import NONE
from relieffab.relief.style.peck import UNEVEN, pecks
from relieffab.relief.style.scatter import scatter
from relieffab.relief.style.streamlines import Spacing, streamlines
from relieffab.relief.style.strokes import SHORTEST, strokes
from relieffab.relief.style.texture import EVEN, Stroke, textured

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]
Complexes = NDArray[np.complex128]

STEEP = 1.2  # slope of walls and occlusions: no stroke climbs them
LINE = 0.05  # of a line's depth, where its groove begins
BARE = 0.02  # mm, the shallowest mark
WAVER = 0.01  # mm that a lattice makes a tip that touches seem to be kept up
YIELD = 8.0  # of what a cutter is kept up its mark loses: pressed on, it would mark what keeps it
BRIEF = 1.0  # spacings: what is left of a stroke and shorter is a dab, no mark of a chisel
BESIDE = 0.3  # mm of level ground between pecks and the figure
BORDER = 2.5  # mm of level ground at the edge of the panel
SEED = 1


def clear_of_lines(smooth: Relief, layers: Layers) -> Bools:
    """Nodes of the figure that no drawn line, wall or occlusion runs through."""
    steep = np.hypot(*pixel_slopes(smooth.heights, smooth.grid.pitch)) > STEEP
    grooved = inked(layers, 1.0) < -LINE
    return inner_nodes(layers.mask) & ~grooved & ~nodes_of(steep)


def _patches(shape: tuple[int, int], width: float, chance: np.random.Generator) -> Ints:
    """Part the nodes into patches about so many pixels wide, each around a place at random."""
    places = scatter(np.ones(shape, bool), width, chance)
    nodes = np.argwhere(np.ones(shape, bool))
    nearest: Ints = cKDTree(places).query(nodes)[1].reshape(shape).astype(np.int64)
    return nearest


def _field(layers: Layers, style: Style, clear: Bools) -> Complexes:
    if style.direction is not None:
        return fixed_field(style.direction, clear.shape)
    whole = clear[:-1, :-1] & clear[:-1, 1:] & clear[1:, :-1] & clear[1:, 1:]
    return form_field(layers, whole, around=style.chisel.around)


def _sampled(image: Floats, places: Floats) -> Floats:
    return ndimage.map_coordinates(image, places.T, order=1, mode="nearest")  # type: ignore[no-any-return]


def _held(
    found: Sequence[Stroke], smooth: Relief, tips: Floats, clear: Bools, style: Style
) -> list[Stroke]:
    """Set strokes by the cutter's axis, only as deep as takes nothing but clear ground.

    Where the cutter is kept up, by walls across a narrow floor or by a hollow rounder
    than itself, the stroke fades: pressed on, it would mark what keeps it up.
    """
    heights, pitch, cutter, chisel = smooth.heights, smooth.grid.pitch, style.tool, style.chisel
    lean = leaning(heights, pitch, clear)
    guard = guarded_tips(heights, clear, pitch, cutter, chisel.depth)
    slack = WAVER + STEEP * cutter.flat_radius  # a flat stands on its edge
    brief, out = BRIEF * chisel.spacing / pitch, []
    for places, deep in found:
        axis = axes(places, lean, cutter.tip_radius / pitch)
        # Pixels' steps along a line would be steps in the stroke beside it.
        most = chisel.depth - _evened(kept_up(heights, guard, places, axis, cutter, pitch))
        kept = np.maximum(kept_up(heights, tips, places, axis, cutter, pitch) - slack, 0.0)
        kept = _evened(ndimage.maximum_filter1d(kept, 2 * int(brief / 2) + 1))
        out += _runs(axis, np.minimum(deep, most) - YIELD * kept, brief)
    return out


def _evened(along: Floats) -> Floats:
    return ndimage.gaussian_filter1d(along, EVEN, mode="nearest")  # type: ignore[no-any-return]


def _runs(places: Floats, deep: Floats, brief: float) -> list[Stroke]:
    """Leave out the stretches of a stroke that are hardly there, and what is brief between."""
    there = np.concatenate([[False], deep >= BARE, [False]])
    edges = np.flatnonzero(np.diff(there.astype(int)))
    pairs = zip(edges[::2], edges[1::2], strict=True)
    return [(places[a:b], deep[a:b]) for a, b in pairs if b - a > brief]


def figure_strokes(smooth: Relief, layers: Layers, style: Style, tips: Floats) -> list[Stroke]:
    """Lay a chisel's strokes over the figure.

    Parameters
    ----------
    smooth : Relief
    layers : Layers
    style : Style
    tips : (rows + 1, cols + 1) ndarray
        Lowest places of the style's tool over the relief, mm.

    Returns
    -------
    list of tuple of (k, 2) and (k,) ndarray
        Rows and columns of the cutter's axis, in nodes, and depths in mm.
    """
    chisel, pitch, chance = style.chisel, smooth.grid.pitch, np.random.default_rng(SEED)
    clear = clear_of_lines(smooth, layers)
    room = ndimage.distance_transform_edt(clear)
    field, patch = _field(layers, style, clear), None
    apart = chisel.spacing / pitch
    if chisel.patch:
        patch = _patches(room.shape, chisel.patch * apart, chance)
        turns = np.radians(chisel.turn) * chance.uniform(-1, 1, int(patch.max()) + 1)
        field = field * np.exp(2j * turns[patch])
    least = _least_room(style.tool)
    lines = streamlines(field, room, Spacing(apart, SHORTEST * apart, least / pitch), patch)
    found = strokes(lines, chisel, apart, chance)
    if chisel.tone:
        dark = darkness(layers, chisel.spacing)
        found = [(places, deep * _sampled(dark, places)) for places, deep in found]
    return _held(found, smooth, tips, clear, style)


def _least_room(cutter: Cutter) -> float:
    """Distance from a line within which the cutter makes no mark at all, mm."""
    return mark_width(cutter, BARE) / 2


def _bordered(grid: Grid) -> Bools:
    """Nodes that a border parts from the edge of the grid."""
    inner = np.zeros(grid.node_shape, bool)
    wide = ceil(BORDER / grid.pitch)
    inner[wide:-wide, wide:-wide] = True
    return inner


def ground_strokes(smooth: Relief, ground: Bools, style: Style) -> list[Stroke]:
    """Scatter pecks over the ground, whole ones, clear of the figure and of its bounds."""
    chisel, pitch = style.chisel, smooth.grid.pitch
    figure = nodes_of(smooth.mask) | (smooth.heights < 0)
    beside = ndimage.distance_transform_edt(~figure) * pitch >= BESIDE
    room = ndimage.distance_transform_edt(np.pad(ground & beside, 1))[1:-1, 1:-1] * pitch
    whole = room >= mark_width(style.tool, (1 + UNEVEN) * chisel.depth) / 2
    return pecks(whole, chisel.spacing / pitch, chisel.depth, np.random.default_rng(SEED))


def carve_marks(
    smooth: Relief, layers: Layers, style: Style, *, depth: float, ground: Bools | None = None
) -> tuple[Relief, Marks]:
    """Carve a style's marks into a relief.

    Parameters
    ----------
    smooth : Relief
        Shallower than `depth` by the style's `headroom`, or its lowest places get none.
    layers : Layers
        That it was made from.
    style : Style
    depth : float
        Bound of the relief with its marks, mm.
    ground : (rows + 1, cols + 1) ndarray of bool, optional
        Nodes that a pecked ground may take; all but a border if not given.  The figure
        and what is beside it stay free.

    Returns
    -------
    relief : Relief
        -depth <= h <= the smooth one's.
    marks : Marks
        The ways of the cutter that makes them.

    Raises
    ------
    InputError
        If the marks are too deep for the relief or too fine for its pixels.
    """
    style.check(depth, smooth.grid.pitch)
    tips = lowest_tips(smooth.heights, smooth.grid.pitch, style.tool.profile)
    found = [] if style.marks == NONE else figure_strokes(smooth, layers, style, tips)
    if style.pecked:
        found = found + ground_strokes(
            smooth, _bordered(smooth.grid) if ground is None else ground, style
        )
    heights = textured(smooth.heights, tips, smooth.grid.pitch, found, style.tool, depth)
    lines = tuple(np.column_stack(smooth.grid.to_xy(*places.T)) for places, _ in found)
    relief = replace(smooth, heights=heights, depth=depth)
    return relief, Marks(style.tool, replace(smooth, depth=depth), lines)
