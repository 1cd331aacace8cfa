import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab import profiles
from relieffab.relief.reach import lowest_tips
from relieffab.relief.style.chisels import CHISELS
from relieffab.relief.style.texture import _coarser, finer
from relieffab.relief.style.texture import textured as carve_into

PITCH = 0.05


def textured(smooth, pitch, strokes, cutter, depth):
    tips = lowest_tips(smooth, pitch, cutter.profile)
    return carve_into(smooth, tips, pitch, strokes, cutter, depth)


def along_a_row(deep, rows=81, cols=121):
    col = np.arange(20.0, 100.5, 0.5)
    return [(np.column_stack([np.full(len(col), rows // 2), col]), np.full(len(col), deep))]


@pytest.mark.parametrize("name", sorted(CHISELS))
def test_a_mark_in_level_ground_has_the_section_of_its_cutter(name):
    chisel = CHISELS[name]
    cutter = profiles.cutter(chisel.cutter)
    smooth = np.full((81, 121), -1.0)
    out = textured(smooth, PITCH, along_a_row(chisel.depth), cutter, 3.0)
    away = np.abs(np.arange(81) - 40) * PITCH
    want = np.minimum(-1.0 - chisel.depth + cutter.profile(away), -1.0)
    # Nodes take means over a pixel: where a flank of 45 degrees ends, an eighth of it is rounded.
    np.testing.assert_allclose(out[:, 60], want, atol=PITCH / 8 + 1e-3)
    assert out[40, 60] == pytest.approx(-1.0 - chisel.depth, abs=2e-3)


def test_on_a_slope_the_cutter_cuts_as_deep_as_asked():
    """A ball against a plane: the mark is as deep, vertically, whichever way the plane leans."""
    cutter = profiles.cutter("ball-2")
    row, col = np.indices((161, 161)) * PITCH
    for slope in ((0.4, 0.0), (0.0, 0.4), (0.3, 0.3)):
        smooth = -5.0 + slope[0] * row + slope[1] * col
        line = np.column_stack([np.full(201, 80.0), np.linspace(30, 130, 201)])
        out = textured(smooth, PITCH, [(line, np.full(201, 0.15))], cutter, 6.0)
        assert (smooth - out).max() == pytest.approx(0.15, rel=0.02)


def test_where_the_cutter_does_not_reach_there_is_no_mark():
    cutter = profiles.cutter("ball-2")
    smooth = np.full((81, 121), -1.0)
    smooth[:36], smooth[46:] = 0.0, 0.0  # a trench of 0.5 mm, narrower than the ball
    out = textured(smooth, PITCH, along_a_row(0.1), cutter, 3.0)
    assert (out[38:44] == smooth[38:44]).all()


def test_finer_and_coarser_keep_a_plane():
    row, col = np.indices((7, 9))
    plane = 0.2 * row - 0.1 * col
    fine = finer(plane)
    assert fine.shape == (13, 17)
    np.testing.assert_allclose(fine[1::2, 1::2], (plane[:-1, :-1] + plane[1:, 1:]) / 2)
    np.testing.assert_allclose(_coarser(fine)[1:-1, 1:-1], plane[1:-1, 1:-1], atol=1e-12)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    heights=arrays(float, (14, 17), elements=st.floats(-2.0, 0.0)),
    deep=arrays(float, 6, elements=st.floats(0.0, 0.5)),
    ends=arrays(float, (2, 2), elements=st.floats(0.0, 13.0)),
    name=st.sampled_from(sorted(CHISELS)),
)
def test_no_mark_breaks_the_bounds(heights, deep, ends, name):
    places = np.linspace(ends[0], ends[1], 6)
    out = textured(heights, 0.2, [(places, deep)], profiles.cutter(CHISELS[name].cutter), 2.0)
    assert (out >= -2.0).all() and (out <= heights).all()


def test_no_strokes_change_nothing():
    heights = np.zeros((4, 4))
    assert textured(heights, 0.1, [], profiles.cutter("ball-2"), 1.0) is heights
