"""Depth in passes: nothing below the relief, nothing deeper than the stepdown."""

from dataclasses import replace

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.passes import Ground, Work, at_depth, passes
from relieffab.toolpath.remains import after
from relieffab.toolpath.trace import SKIN, sample

GRID = Grid(60, 80, 0.1, (0.0, 6.0))
BALL = Cutter("c", "ball", 0.8, 9.0, 1.0, 800.0, 200.0, 9000.0)
ROW = np.array([[0.3, 3.02], [7.7, 3.02]])


def pit():
    x, y = np.meshgrid(*GRID.node_axes())
    return np.where(np.hypot(x - 4, y - 3) < 2.5, -1.8 + 0.2 * np.sin(3 * x), 0.0)


@pytest.fixture
def work():
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    return Work(Ground(Terrain.over(GRID, pit()), BALL, SKIN), slab, 0.5, 0.004, 0.02, 0.05)


def heights_along(runs, x):
    z = np.full_like(x, np.nan)
    for given in runs:
        run = given if given[0, 0] < given[-1, 0] else given[::-1]
        inside = (x >= run[0, 0]) & (x <= run[-1, 0])
        z[inside] = np.interp(x[inside], run[:, 0], run[:, 2])
    return z


def test_each_pass_takes_no_more_than_the_stepdown_and_the_last_reaches_the_bottom(work):
    low, top = work.follow(sample([ROW], work.step))
    x = np.linspace(0.3, 7.7, 4001)
    floor = tip_heights(work.relief, BALL, x, np.full_like(x, 3.02))
    standing = np.zeros_like(x)
    found = list(passes(work, low, top))
    assert len(found) == 4
    for part in found:
        z = heights_along(part.runs, x)
        cut = ~np.isnan(z)
        assert (z - floor)[cut].min() > 0
        assert (standing - z)[cut].max() <= 0.5 + work.tolerance
        standing[cut] = np.minimum(standing[cut], z[cut])
    assert (standing - floor)[np.abs(x - 4) < 1.9].max() < 0.03


def test_one_pass_is_enough_where_little_stands(work):
    x, y = np.meshgrid(*GRID.node_axes())
    tips = np.stack([x, y, tip_heights(work.relief, BALL, x, y) + 0.1], axis=-1).reshape(-1, 3)
    left = after(np.zeros(GRID.node_shape), GRID, BALL, tips)
    near = replace(work, stock=Terrain.over(GRID, left))
    low, top = near.follow(sample([ROW], near.step))
    assert [part.number for part in passes(near, low, top)] == [1]


def test_nothing_is_cut_where_nothing_stands(work):
    done = replace(work, stock=work.relief, least=0.3)
    low, top = done.follow(sample([ROW], done.step))
    assert list(passes(done, low, top)) == []


def test_lines_at_depth_stay_above_what_their_pass_may_reach(work):
    low, top = work.follow(sample([ROW], work.step))
    part = next(iter(passes(work, low, top)))
    pair = np.array([[2.0, 3.0], [2.3, 3.4]])
    (bridge,) = at_depth(part, [pair])
    assert np.allclose(bridge[[0, -1], :2], pair)
    assert bridge[:, 2].min() >= -0.5
    assert at_depth(part, []) == []
