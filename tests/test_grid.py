import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid


def test_pixels_are_square_and_cover_the_panel():
    grid = Grid.on_panel((120.0, 90.0), (1024, 768))
    assert grid.shape == (768, 1024)
    x, y = grid.node_axes()
    assert (x[0], x[-1], y[0], y[-1]) == pytest.approx((0, 120, 90, 0))


def test_a_panel_of_another_shape_keeps_square_pixels_in_its_middle():
    grid = Grid.on_panel((100.0, 100.0), (1024, 768))
    assert grid.shape == (768, 768)
    assert grid.origin == pytest.approx((0, 100))
    tall = Grid.on_panel((50.3, 90.0), (100, 100))
    x, _ = tall.node_axes()
    assert x[0] + x[-1] == pytest.approx(50.3)
    assert x[0] >= 0


def test_rows_run_against_y_and_back():
    grid = Grid(10, 20, 0.5, (3.0, 8.0))
    assert grid.to_xy(2, 4) == (5.0, 7.0)
    assert grid.to_index(5.0, 7.0) == (2.0, 4.0)
    rng = np.random.default_rng(0)
    row, col = rng.uniform(0, 10, (2, 50))
    np.testing.assert_allclose(grid.to_index(*grid.to_xy(row, col)), (row, col), atol=1e-12)


@pytest.mark.parametrize("values", [(0, 4, 1.0), (4, 0, 1.0), (4, 4, 0.0), (4, 4, float("nan"))])
def test_grids_without_pixels_or_pitch_are_refused(values):
    with pytest.raises(InputError):
        Grid(*values, (0.0, 0.0))
