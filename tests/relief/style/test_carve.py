import numpy as np
import pytest

from relieffab import profiles
from relieffab.relief.model import Relief
from relieffab.relief.style.carve import left_by
from relieffab.relief.style.make import carve_marks
from relieffab.relief.style.model import Marks, Style


def test_a_cutter_on_its_strokes_leaves_next_to_nothing(ball):
    relief, marks = carve_marks(ball.smooth, ball.layers, Style("gouge"), depth=3.0)
    left = left_by(relief, marks) - relief.heights
    assert left.min() >= 0
    marked = ball.smooth.heights - relief.heights > 1e-3
    assert np.percentile(left[marked], 99) < 0.02


def test_a_cutter_too_wide_leaves_what_it_cannot_reach(level):
    style = Style("point")
    relief, marks = carve_marks(level.smooth, level.layers, style, depth=3.0)
    wide = Marks(profiles.cutter("ball-6"), marks.smooth, marks.lines)
    marked = level.smooth.heights - relief.heights > 0.25
    fit, unfit = (left_by(relief, one) - relief.heights for one in (marks, wide))
    assert fit[marked].mean() < 0.02 and unfit[marked].mean() > 0.1


def test_the_tip_stands_where_it_first_touches(level):
    """Against the plain way: the highest of what every node asks."""
    style = Style("gouge")
    cutter, grid = style.tool, level.smooth.grid
    rng = np.random.default_rng(5)
    heights = np.where(level.smooth.heights < 0, -1 - 0.2 * rng.random(grid.node_shape), 0.0)
    relief = Relief(grid, heights, level.smooth.mask, 3.0)
    at = np.array([[11.93, 8.21]])
    left = left_by(relief, Marks(cutter, level.smooth, (np.repeat(at, 2, axis=0),)))
    x, y = np.meshgrid(*grid.node_axes())
    away = np.hypot(x - at[0, 0], y - at[0, 1])
    tip = (heights - cutter.profile(away)).max()
    want = np.maximum(np.minimum(level.smooth.heights, tip + cutter.profile(away)), heights)
    # A tip is known to the distance at which it touches slopes, no further.
    near = away < 0.6
    np.testing.assert_allclose(left[near], want[near], atol=1e-3)
    assert left[near].min() == pytest.approx(tip, abs=0.01)
