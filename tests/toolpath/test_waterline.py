"""Lines at one height, and lines at even distances from a border."""

from itertools import pairwise

import numpy as np

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Places, Terrain
from relieffab.toolpath.passes import Ground, Work
from relieffab.toolpath.trace import SKIN
from relieffab.toolpath.waterline import length, offsets, waterlines

GRID = Grid(80, 80, 0.1, (0.0, 8.0))
BALL = Cutter("c", "ball", 1.0, 9.0, 1.0, 800.0, 200.0, 9000.0)


def bowl_work():
    """A round pit of radius 3 with a wall of 60 degrees down to -2."""
    x, y = np.meshgrid(*GRID.node_axes())
    heights = np.clip(1.732 * (np.hypot(x - 4, y - 4) - 3.0), -2.0, 0.0)
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    return Work(Ground(Terrain.over(GRID, heights), BALL, SKIN), slab, 1.0, 0.004, 0.01, 0.05)


def test_waterlines_go_round_a_pit_at_even_heights():
    lines = waterlines(bowl_work(), np.ones(GRID.shape, bool), 0.5)
    assert len(lines) == 4
    for k, line in enumerate(lines[:3], 1):
        # The ball's tip lies under its centre, a radius inwards of the wall's own square.
        away = np.hypot(*(line - 4.0).T)
        z = -0.5 * k
        on_wall = 3.0 + (z + 0.5 - 0.5 * 2.0) / 1.732
        assert np.abs(away - on_wall).max() < 0.02
        assert np.array_equal(line[0], line[-1])


def test_only_steep_pixels_have_waterlines():
    steep = np.zeros(GRID.shape, bool)
    assert waterlines(bowl_work(), steep, 0.5) == []
    steep[:, :40] = True
    lines = waterlines(bowl_work(), steep, 0.5)
    assert max(line[:, 0].max() for line in lines) < 4.4


def square(size):
    inside = np.zeros((60, 60), bool)
    inside[10 : 10 + size, 10 : 10 + size] = True
    return inside, Places((0.0, 6.0), 0.0, 0.1, 0.1, 60, 60)


def test_offsets_lie_a_stepover_apart_from_the_middle_outwards():
    lines = offsets(*square(30), 0.5)
    widths = [np.ptp(line[:, 0]) for line in lines]
    assert np.allclose(np.diff(widths), 1.0, atol=0.05)
    assert widths[-1] == max(widths)
    assert 2.8 < widths[-1] < 2.95


def test_stock_lies_to_the_right_of_offsets():
    for line in offsets(*square(30), 0.5):
        x, y = line.T
        area = 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
        # What is still to be cut lies outside of each line: counter-clockwise.
        assert area > 0


def test_each_line_begins_near_the_end_of_the_one_before():
    lines = offsets(*square(30), 0.5)
    for one, other in pairwise(lines):
        assert np.hypot(*(other[0] - one[-1])) < 0.75


def test_patches_are_cleared_one_after_another():
    inside, places = square(16)
    inside[40:56, 40:56] = True
    sides = [line[0, 0] > 3.5 for line in offsets(inside, places, 0.3)]
    assert len(sides) == 6
    assert np.count_nonzero(np.diff(sides)) == 1


def test_length():
    assert length(np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 5.0]])) == 6.0
