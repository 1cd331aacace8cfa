import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.template.contours import depth_contours


def test_contours_of_a_cone_are_circles_at_their_depths(bowl):
    contours = depth_contours(bowl, 0.6)
    assert [one.level for one in contours] == [1, 2, 3, 4]
    assert [one.depth for one in contours] == pytest.approx([0.6, 1.2, 1.8, 2.4])
    for one in contours:
        radius = 15 * (1 - one.depth / 3)
        away = np.hypot(one.points[:, 0] - 30, one.points[:, 1] - 20)
        assert np.abs(away - radius).max() < 0.02
        assert one.length == pytest.approx(2 * np.pi * radius, rel=0.01)


def test_contours_lie_on_the_relief_at_their_depth(bowl):
    for one in depth_contours(bowl, 0.5):
        np.testing.assert_allclose(bowl.height_at(*one.points.T), -one.depth, atol=0.02)


def test_a_relief_at_its_grids_edge_gives_closed_lines_along_it():
    grid = Grid(20, 30, 1.0, (0.0, 20.0))
    relief = Relief(grid, np.full((21, 31), -2.0), np.ones((20, 30), bool), 2.0)
    (one,) = depth_contours(relief, 1.0)
    assert one.length == pytest.approx(100.0, rel=0.05)


def test_specks_and_a_level_face_give_no_lines():
    grid = Grid(20, 30, 0.1, (0.0, 2.0))
    heights = np.zeros((21, 31))
    mask = np.ones((20, 30), bool)
    assert depth_contours(Relief(grid, heights, mask, 2.0), 0.4) == []
    heights = heights.copy()
    heights[10, 10] = -2.0
    assert depth_contours(Relief(grid, heights, mask, 2.0), 0.4) == []
