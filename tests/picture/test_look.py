"""The predicted look: both surfaces in one light, side by side."""

import numpy as np

from relieffab.grid import Grid
from relieffab.picture.look import GAP, LINE, predicted_look
from relieffab.picture.stone import hillshade
from relieffab.relief.model import Relief


def bowl(per, deep=1.0):
    grid = Grid(30 * per, 40 * per, 0.5 / per, (0.0, 15.0))
    x, y = np.meshgrid(*grid.node_axes())
    heights = -deep * np.clip(1 - ((x - 10) / 8) ** 2 - ((y - 7.5) / 6) ** 2, 0, 1)
    return Relief(grid, heights, np.ones(grid.shape, bool), 1.0)


def test_left_is_wanted_and_right_is_carved():
    wanted, carved = bowl(1), bowl(1, deep=0.5)
    page = predicted_look(wanted, carved)
    assert page.shape == (30 + GAP + LINE, 80 + 3 * GAP, 3)
    assert np.array_equal(page[LINE : LINE + 30, GAP : GAP + 40], hillshade(wanted))
    right = page[LINE : LINE + 30, 2 * GAP + 40 : 2 * GAP + 80]
    assert np.array_equal(right, hillshade(carved))


def test_a_finer_surface_is_shown_as_large():
    page = predicted_look(bowl(1), bowl(4), width=40)
    left = page[LINE : LINE + 30, GAP : GAP + 40].astype(float)
    right = page[LINE : LINE + 30, 2 * GAP + 40 : 2 * GAP + 80].astype(float)
    assert np.abs(left - right).mean() < 3
