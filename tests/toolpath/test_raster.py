"""Rows lie where something stands, a stepover apart."""

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.toolpath.raster import rows, standing

GRID = Grid(40, 60, 0.1, (1.0, 6.0))


def disc():
    x, y = np.meshgrid(*GRID.node_axes())
    return np.where(np.hypot(x - 4, y - 4) < 1.2, -1.0, 0.0)


def test_standing_covers_the_figure_and_not_the_face():
    relief = disc()
    where = standing(relief, np.zeros_like(relief), 0.05, 2)
    sunk = relief[:-1, :-1] < 0
    assert where[sunk].all()
    assert where.mean() < 0.5


def test_what_is_done_is_left_alone():
    relief = disc()
    stock = relief.copy()
    assert not standing(relief, stock, 0.05, 2).any()
    stock[20, 30] += 0.2
    assert 9 <= standing(relief, stock, 0.05, 2).sum() <= 49


def test_rows_are_even_and_close_enough():
    trace = rows(GRID, np.ones(GRID.shape, bool), 0.33, 0.07)
    lines = np.unique(trace.xy[:, 1])
    assert np.diff(lines).max() <= 0.33
    assert np.ptp(np.diff(lines)) < 1e-9
    assert trace.steps[trace.joined].max() <= 0.07 + 1e-12
    assert len(np.unique(trace.run)) == len(lines)


def test_a_row_is_broken_where_nothing_stands():
    where = np.ones(GRID.shape, bool)
    where[:, 20:30] = False
    trace = rows(GRID, where, 1.0, 0.05)
    assert len(np.unique(trace.run)) == 2 * len(np.unique(trace.xy[:, 1]))
    inside = (trace.xy[:, 0] > 3.0 + 1e-9) & (trace.xy[:, 0] < 4.0 - 1e-9)
    assert not inside.any()
    assert trace.steps[trace.joined].max() == pytest.approx(0.05)


def test_nowhere_gives_no_rows():
    assert len(rows(GRID, np.zeros(GRID.shape, bool), 1.0, 0.1)) == 0
