"""Marks on grounds where they can be foretold: as far apart and as deep as asked."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.style.chisels import CHISELS
from relieffab.relief.style.make import BESIDE, BORDER, carve_marks, clear_of_lines
from relieffab.relief.style.measure import measure
from relieffab.relief.style.model import Style, mark_width

DEPTH = 3.0
LIGHT = np.array([[0.0, 0.0, 1.0]])


def carved(ground, style):
    smooth = ground.smooth
    relief, marks = carve_marks(smooth, ground.layers, style, depth=smooth.depth)
    assert (relief.heights >= -smooth.depth).all() and (relief.heights <= smooth.heights).all()
    return relief, marks


@pytest.mark.parametrize("name", sorted(set(CHISELS) - {"hatch"}))
@pytest.mark.parametrize("shape", ["level", "ball"])
def test_marks_are_as_far_apart_and_as_deep_as_asked(name, shape, request):
    style = Style(name)
    relief, marks = carved(request.getfixturevalue(shape), style)
    found = measure(relief, marks, style)["figure"]
    assert found.spacing == pytest.approx(style.chisel.spacing, rel=0.1)
    assert found.depth == pytest.approx(style.chisel.depth, rel=0.1)
    assert found.within > 0.999 and found.left < 0.04


@pytest.mark.parametrize(("spacing", "depth"), [(0.8, 0.1), (2.0, 0.25)])
def test_spacing_depth_and_direction_are_free(level, spacing, depth):
    style = Style("gouge", spacing=spacing, depth=depth, direction=25.0)
    relief, marks = carved(level, style)
    found = measure(relief, marks, style)["figure"]
    assert found.spacing == pytest.approx(spacing, rel=0.05)
    assert found.depth == pytest.approx(depth, rel=0.05)
    ways = np.concatenate([np.diff(line, axis=0) for line in marks.lines])
    angles = np.degrees(np.arctan2(ways[:, 1], ways[:, 0])) % 180
    np.testing.assert_allclose(angles, 25.0, atol=0.1)


def test_hatching_is_deep_in_the_dark_and_absent_in_the_light(ball):
    relief, marks = carved(ball, Style("hatch"))
    cut = marks.smooth.heights - relief.heights
    x, y = np.meshgrid(*relief.grid.node_axes())
    inside = np.hypot(x - 12, y - 9) < 6.5
    # Both lights come from above: the near half is in the shade, darkest where the wall
    # around the figure keeps a vee up.
    dark, light = cut[inside & (y < 5)], cut[inside & (y > 12.5)]
    assert dark.max() > 0.15 and light.max() < 0.05


def test_pecks_are_round_whole_and_clear_of_figure_and_border(level):
    style = Style(ground="pecked")
    small = np.zeros(level.smooth.grid.shape, bool)
    small[60:120, 90:150] = True
    heights = np.where(nodes_of(small), -1.0, 0.0)
    smooth = replace(level.smooth, heights=heights, mask=small)
    relief, marks = carve_marks(smooth, level.layers, style, depth=3.0)
    found = measure(relief, marks, style)["ground"]
    assert found.spacing == pytest.approx(style.chisel.spacing, rel=0.1)
    assert found.depth == pytest.approx(style.chisel.depth, rel=0.1)
    assert found.within > 0.99
    cut = smooth.heights - relief.heights > 1e-9
    away = ndimage.distance_transform_edt(heights == 0) * smooth.grid.pitch
    assert not cut[away < BESIDE - 0.1].any()
    edge = round(BORDER / smooth.grid.pitch) - 1
    cut[edge:-edge, edge:-edge] = False
    assert not cut.any()


def test_marks_keep_off_drawn_lines_and_walls(lined):
    for name in CHISELS:
        style = replace(Style(name), direction=80.0)
        relief, _ = carved(lined, style)
        cut = lined.smooth.heights - relief.heights
        clear = clear_of_lines(lined.smooth, lined.layers)
        assert cut[88:93, 30:210].max() == 0
        # The wall falls 1 mm in a pixel: this is a sixth of one, sideways.
        assert cut[~clear].max() < 0.16
        assert cut.max() > 0.7 * style.chisel.depth


@settings(max_examples=15, deadline=None, derandomize=True)
@given(
    heights=arrays(float, (25, 33), elements=st.floats(-2.0, 0.0)),
    name=st.sampled_from(sorted(CHISELS)),
    ground=st.sampled_from(["plain", "pecked"]),
    direction=st.sampled_from([None, 10.0]),
)
def test_no_style_breaks_the_bounds(heights, name, ground, direction):
    grid = Grid(24, 32, 0.12, (0.0, 24 * 0.12))
    mask = np.zeros(grid.shape, bool)
    mask[3:-3, 3:-3] = True
    smooth = Relief(grid, np.where(nodes_of(mask), heights, 0.0), mask, 2.0)
    normals = np.random.default_rng(0).normal(size=(*grid.shape, 3))
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    shading = np.abs(normals[None, ..., 2]) * mask
    none = np.zeros(grid.shape)
    layers = Layers(grid, none, normals, mask, LIGHT, shading, none.copy())
    style = Style(name, ground=ground, direction=direction)
    relief, _ = carve_marks(smooth, layers, style, depth=2.0)
    assert (relief.heights >= -2.0).all() and (relief.heights <= smooth.heights).all()


def test_carving_again_gives_the_same_marks(ball):
    one, other = (carved(ball, Style("claw", ground="pecked"))[0] for _ in range(2))
    assert np.array_equal(one.heights, other.heights)


def test_marks_that_the_pixels_cannot_show_are_refused(level):
    with pytest.raises(InputError, match="finer than the relief's pixels"):
        carve_marks(level.smooth, level.layers, Style("gouge", depth=0.001), depth=3.0)


@pytest.mark.parametrize("name", ["flat", "gouge", "point"])
def test_a_wall_that_keeps_the_cutter_up_is_not_marked(level, name):
    """A trench too narrow for these cutters, in a level ground that is not."""
    grid, style = level.smooth.grid, Style(name, direction=0.0)
    x, y = np.meshgrid(*grid.node_axes())
    away = np.maximum(np.abs(y - 9.0) - 0.4, 0.0)
    inside = (np.abs(x - 12) < 9) & (np.abs(y - 9.0) < 3)
    heights = np.where(inside, np.minimum(4.0 * away - 2.4, 0.0), 0.0)
    smooth = replace(level.smooth, heights=heights, mask=level.smooth.mask)
    relief, marks = carve_marks(smooth, level.layers, style, depth=DEPTH)
    cut = smooth.heights - relief.heights
    assert cut[(heights > -2.2) & (heights < -0.1)].max() < 0.01
    assert cut.max() > 0.8 * style.chisel.depth
    assert all(len(line) > style.chisel.spacing / grid.pitch for line in marks.lines)


def test_strokes_go_where_the_cutter_finds_room(level):
    _, marks = carved(level, Style("flat"))
    clear = clear_of_lines(level.smooth, level.layers)
    room = ndimage.distance_transform_edt(clear) * level.smooth.grid.pitch
    for line in marks.lines:
        row, col = level.smooth.grid.to_index(*line.T)
        at = ndimage.map_coordinates(room, [row, col], order=1)
        assert at.min() >= 0.9 * mark_width(marks.cutter, 0.02) / 2
