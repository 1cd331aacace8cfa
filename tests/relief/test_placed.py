import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.compose import compose
from relieffab.relief.model import Relief, inner_nodes
from relieffab.relief.placed import Placed, fitted_round, scaled


def relief():
    """Noise in the middle of a small panel."""
    grid = Grid(12, 16, 0.5, (0.0, 6.0))
    mask = np.zeros(grid.shape, bool)
    mask[3:-3, 3:-3] = True
    noise = -2.0 * np.random.default_rng(3).random(grid.node_shape)
    return Relief(grid, np.where(inner_nodes(mask), noise, 0.0), mask, 2.0)


def test_scaled_about_its_own_corner():
    one = relief()
    small = scaled(one, 0.5)
    x, y = np.meshgrid(np.linspace(0, 8, 9), np.linspace(0, 6, 7))
    np.testing.assert_allclose(small.height_at(x / 2, y / 2), one.height_at(x, y), atol=1e-12)
    assert small.depth == one.depth


def test_fitted_round_nodes_are_taken_over_as_they_are():
    one = relief()
    parts, scale = fitted_round([Placed(one, (16.3, 0.1), "a")], 20.2)
    assert 1 - 0.5 / 20.2 < scale < 1
    assert parts[0].at == pytest.approx((16.3, 0.1), abs=0.25)
    made = compose(parts, (20.2, 9.0), joined=True)
    assert made.grid.cols == 41
    start = round(parts[0].grid.origin[0] / made.grid.pitch)
    top = round((made.grid.origin[1] - parts[0].grid.origin[1]) / made.grid.pitch)
    columns = np.arange(start, start + 17) % 41
    found = made.heights[top : top + 13][:, columns]
    np.testing.assert_allclose(found, one.heights, atol=1e-9)
    # Where all fits already nothing changes.
    assert fitted_round([Placed(one, (16.5, 0.5), "a")], 20.0)[1] == 1.0
