"""Depth of gouges where geometry gives it, and against every point of the surface."""

import numpy as np
import pytest

from relieffab.gcode.gouge import deepest_gouge
from relieffab.grid import Grid
from relieffab.relief.model import Relief

GRID = Grid(20, 20, 0.1, (0.0, 2.0))


def relief_of(heights):
    return Relief(GRID, heights, np.ones(GRID.shape, bool), 4.0)


def deepest(relief, change):
    grid = Grid(80, 80, 0.025, (0.0, 2.0))
    x, y = np.meshgrid(*grid.node_axes())
    wanted = relief.height_at(x, y)
    heights = (wanted + change(x, y)).astype(np.float32)
    return deepest_gouge(relief, grid, heights, (heights - wanted).astype(np.float32))


@pytest.mark.parametrize("slope", [0.0, 0.5, 1.0, 5.0, 20.0])
def test_a_spot_of_a_slope(slope):
    x = GRID.node_axes()[0]
    heights = np.broadcast_to(-np.abs(x - 1.0) * min(slope, 3.9), GRID.node_shape).copy()
    down = 0.05
    spot = deepest(relief_of(heights), lambda x, y: -down * np.isclose(x, 0.5) * np.isclose(y, 1.0))
    right = down / np.hypot(1, min(slope, 3.9))
    assert right * (1 - 1e-5) <= spot[0] <= right * 1.3
    assert spot[1:] == pytest.approx((0.5, 1.0))


def test_nothing_gone_and_nothing_but_rounding():
    flat = relief_of(np.zeros(GRID.node_shape))
    assert deepest(flat, lambda x, y: 0.1 + 0 * x)[0] == 0
    assert deepest(flat, lambda x, y: -5e-7 + 0 * x)[0] == 0


def test_a_wall_moved_sideways():
    heights = np.zeros(GRID.node_shape)
    heights[:, 10:] = -4.0
    x0 = 0.9
    found = deepest(relief_of(heights), lambda x, y: -3.0 * np.isclose(x, x0))
    # 3 mm down at the crest of a wall that falls 4 mm in 0.1: the wall is 0.075 mm away.
    assert 0.0749 < found[0] < 0.075 * 1.3
