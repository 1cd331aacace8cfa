import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.above import bend_of, bent_points, seen_from_above
from relieffab.relief.laid import laid
from relieffab.relief.model import Relief
from relieffab.round import Curved
from relieffab.stock import Stock

BOARD = Curved(40, 12, 9, 70)
STOCK = Stock(BOARD.breadth, BOARD.height, BOARD.thickness, curve=BOARD.radius)
GRID = Grid(48, 160, 0.25, (0.0, 12.0))


def flat(heights, mask=None):
    mask = np.ones(GRID.shape, bool) if mask is None else mask
    return Relief(GRID, heights, mask, 2.0)


def test_the_bend_is_that_of_the_board():
    assert bend_of(STOCK).middle == pytest.approx(20.0)
    assert bend_of(STOCK).radius == 70


def test_a_bare_board_is_its_face():
    seen = seen_from_above(flat(np.zeros(GRID.node_shape)), STOCK)
    x, _ = seen.grid.node_axes()
    assert x[0] == 0 and x[-1] == pytest.approx(STOCK.width, abs=1e-12)
    assert (seen.heights == STOCK.face(x)).all()
    assert seen.depth == pytest.approx(2.0 + BOARD.sagitta)
    assert seen.mask.all()


def test_smooth_forms_lie_where_they_are_bent_to():
    """Points of the flat relief, bent one by one, lie on what is seen from above."""
    x, y = GRID.node_axes()
    heights = -0.7 + 0.5 * np.sin(x / 3)[None, :] * np.cos(y / 2)[:, None]
    relief = flat(heights)
    seen = laid(relief, STOCK)
    rng = np.random.default_rng(5)
    places = rng.uniform([2, 1], [38, 11], (400, 2))
    bent = bend_of(STOCK).bent(np.column_stack([places, relief.height_at(*places.T)]))
    across, up = bent[:, 0] + STOCK.width / 2, bent[:, 2] - 70
    np.testing.assert_allclose(seen.height_at(across, places[:, 1]), up, atol=4e-3)
    np.testing.assert_allclose(bent_points(places, relief, STOCK)[:, 0], across, atol=1e-12)


def test_undercut_walls_are_filled_in():
    """Of a slot left of the middle one wall is seen from above, and the other leans over."""
    heights = np.zeros(GRID.node_shape)
    heights[:, 24:41] = -2.0  # X 6 to 10 of 40
    seen = seen_from_above(flat(heights), STOCK)
    x, _ = seen.grid.node_axes()
    below = STOCK.face(x) - seen.heights[20]
    half = STOCK.width / 2
    rim, foot = half + 70 * np.sin(-14.25 / 70), half + 68 * np.sin(-14 / 70)
    assert foot > rim + 0.6
    np.testing.assert_allclose(x[(below > 0.1) & (x < 7)].min(), rim, atol=0.3)
    np.testing.assert_allclose(x[below > 1.8].min(), foot, atol=0.3)
    # The other wall's foot lies under its rim: it stands upright there.
    rim, foot = half + 70 * np.sin(-9.75 / 70), half + 68 * np.sin(-10 / 70)
    assert foot > rim
    inside = x[below > 0.1].max()
    assert rim - 0.5 < inside <= rim
    assert below[x == inside] > 1.5


def test_the_figure_goes_with_it():
    mask = np.zeros(GRID.shape, bool)
    mask[12:36, 100:140] = True  # X 25 to 35
    seen = seen_from_above(flat(np.zeros(GRID.node_shape), mask), STOCK)
    wide = 70 * (np.sin(15 / 70) - np.sin(5 / 70))
    rows, cols = seen.mask.any(axis=1), seen.mask.any(axis=0)
    assert cols.sum() * seen.grid.pitch == pytest.approx(wide, abs=seen.grid.pitch)
    assert rows.sum() == pytest.approx(24, abs=1)
    assert seen.mask.sum() == rows.sum() * cols.sum()
