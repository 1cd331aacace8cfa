"""Creases of the cutter-location surface, and lines through thinned pixels."""

import numpy as np

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain
from relieffab.toolpath.passes import Ground, Work
from relieffab.toolpath.pencil import chains, creases, kinks
from relieffab.toolpath.trace import SKIN, sample

GRID = Grid(80, 80, 0.1, (0.0, 8.0))
BALL = Cutter("c", "ball", 1.0, 9.0, 1.0, 800.0, 200.0, 9000.0)


def work_over(heights):
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    return Work(Ground(Terrain.over(GRID, heights), BALL, SKIN), slab, 1.0, 0.004, 0.01, 0.05)


def test_a_valley_has_its_crease_along_its_bottom():
    x, y = np.meshgrid(*GRID.node_axes())
    valley = np.minimum(0.8 * np.abs(x - 4.05) - 2.0, 0.0)
    lines = creases(work_over(np.where(np.abs(y - 4) < 3, valley, 0.0)))
    line = max(lines, key=lambda line: np.ptp(line[:, 1]))
    dense = sample([line], 0.1).xy
    middle = dense[np.abs(dense[:, 1] - 4) < 2]
    assert np.abs(middle[:, 0] - 4.05).max() < 0.11
    assert np.ptp(line[:, 1]) > 3.5


def test_bends_rounder_than_the_cutter_are_no_creases():
    x, _ = np.meshgrid(*GRID.node_axes())
    lines = creases(work_over(np.minimum(0.2 * (x - 4) ** 2 - 2.0, 0.0) - 0.5))
    # The grid's own borders are walls, and have a foot each.
    assert min(np.abs(line - 4).max(axis=1).min() for line in lines) > 2.5


def test_kinks_are_second_differences():
    low = np.abs(np.arange(-3.0, 4.0))[None, :].repeat(5, axis=0)
    found = kinks(low)
    assert found[2, 3] == 2.0
    assert found[2, 1] == 0.0


def test_chains_follow_a_line_from_end_to_end():
    picked = np.zeros((20, 30), bool)
    picked[5, 3:20] = True
    picked[np.arange(6, 12), np.arange(20, 26)] = True
    (line,) = chains(picked)
    assert len(line) == picked.sum()
    assert sorted([line[0].tolist(), line[-1].tolist()]) == [[5, 3], [11, 25]]
    assert np.abs(np.diff(line, axis=0)).max() == 1


def test_nothing_has_no_chains():
    assert chains(np.zeros((5, 5), bool)) == []
