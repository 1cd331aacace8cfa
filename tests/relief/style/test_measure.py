import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.relief.style.measure import _furrows, _pecks, measure, middles
from relieffab.relief.style.model import Marks, Style


def furrows(apart, angle, depth, shape=(120, 160)):
    """Parabolic furrows at an angle from rows' axis, and where their middles lie."""
    row, col = np.indices(shape)
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    side = (row * c + col * s + apart / 2) % apart - apart / 2
    return depth * np.maximum(1 - (side / (0.45 * apart)) ** 2, 0.0)


@pytest.mark.parametrize("angle", [0.0, 28.0, 90.0])
@pytest.mark.parametrize("apart", [5.0, 9.3])
def test_known_furrows_are_measured(apart, angle):
    spacing, depth = _furrows(furrows(apart, angle, 0.2), 1.15 * apart)
    assert spacing == pytest.approx(apart, rel=0.02)
    assert depth == pytest.approx(0.2, rel=0.03)


def test_middles_are_found_to_a_part_of_a_pixel():
    places, across = middles(furrows(9.3, 28.0, 0.2), 9.3)
    c, s = np.cos(np.radians(28)), np.sin(np.radians(28))
    inner = (places > 8).all(axis=1) & (places < [112, 152]).all(axis=1)
    side = places[inner] @ np.array([c, s])
    assert np.abs((side + 4.65) % 9.3 - 4.65).max() < 0.3
    np.testing.assert_allclose(np.abs(across[inner] @ np.array([c, s])), 1.0, atol=0.01)


def test_known_pecks_are_measured():
    row, col = np.indices((90, 90))
    away = np.hypot(row % 15 - 7, col % 18 - 9)
    spacing, depth = _pecks(0.3 * np.maximum(1 - (away / 5) ** 2, 0.0), 14.0)
    assert spacing == pytest.approx(15.0)
    assert depth == pytest.approx(0.3)


def test_without_marks_there_is_nothing_to_measure():
    grid = Grid(20, 20, 0.2, (0.0, 4.0))
    heights = np.full(grid.node_shape, -0.5)
    relief = Relief(grid, heights, np.ones(grid.shape, bool), 1.0)
    style = Style("gouge", ground="pecked")
    found = measure(relief, Marks(style.tool, relief, ()), style)
    for one in found.values():
        assert np.isnan([one.spacing, one.depth, one.within, one.left]).all() and one.area == 0
    assert np.isnan(_pecks(np.zeros((9, 9)), 3.0)).all()
