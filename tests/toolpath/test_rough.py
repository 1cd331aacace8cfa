"""Roughing levels: no deeper than the stepdown, all of what stands, and no more."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.remains import after
from relieffab.toolpath.rough import rough_passes, rough_work

GRID = Grid(100, 120, 0.1, (0.0, 10.0))
SLAB = Terrain.over(GRID, np.zeros(GRID.node_shape))
FLAT = Cutter("c", "flat", 1.5, 9.0, 1.0, 800.0, 200.0, 9000.0)
ALLOWANCE = 0.2


def pits():
    """A round pit with a post in it, 2.3 deep, and a shallow one beside it."""
    x, y = np.meshgrid(*GRID.node_axes())
    away = np.hypot(x - 4, y - 5)
    deep = np.where((away < 3.5) & (away > 0.5), -2.3, 0.0)
    return np.where(np.hypot(x - 9.8, y - 5) < 1.5, -0.6, deep)


@pytest.fixture(scope="module")
def levels():
    work = rough_work(Terrain.over(GRID, pits()), SLAB, FLAT, 0.8, ALLOWANCE)
    return work, rough_passes(work)


def dense(run):
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(run[:, :2], axis=0).T))])
    places = np.linspace(0, lengths[-1], max(int(lengths[-1] / 0.05), 2))
    return np.column_stack([np.interp(places, lengths, run[:, k]) for k in range(3)])


def test_each_level_is_no_deeper_than_the_stepdown_below_the_last(levels):
    _, parts = levels
    assert [part.number for part in parts] == [1, 2, 3]
    for part in parts:
        low = min(run[:, 2].min() for run in part.runs)
        assert low >= -0.8 * part.number - 1e-9


def test_levels_clear_all_but_the_allowance(levels):
    work, parts = levels
    left = np.zeros(GRID.node_shape)
    for part in parts:
        tips = np.concatenate([dense(run) for run in part.runs])
        left = after(left, GRID, FLAT, tips)
    excess = left - pits()
    assert excess[pits() < 0].min() > ALLOWANCE - 0.01
    x, y = np.meshgrid(*GRID.node_axes())
    away = np.hypot(x - 4, y - 5)
    clear = (away > 0.5 + 0.45) & (away < 3.5 - 0.45)
    assert excess[clear].max() < ALLOWANCE + 0.15
    tips = np.concatenate([dense(run) for part in parts for run in part.runs])
    lowest = tip_heights(work.relief, FLAT, *tips[:, :2].T, allowance=ALLOWANCE)
    assert (tips[:, 2] - lowest).min() > -0.003


def test_deep_levels_leave_shallow_places_alone(levels):
    _, parts = levels
    for part in parts[1:]:
        assert max(run[:, 0].max() for run in part.runs) < 8.0


def test_nothing_above_the_face_is_roughed():
    work = rough_work(
        Terrain.over(GRID, np.full(GRID.node_shape, -0.05)), SLAB, FLAT, 0.8, ALLOWANCE
    )
    assert rough_passes(work) == []


def test_conventional_milling_goes_the_other_way(levels):
    work, parts = levels
    turned = rough_passes(work, reverse=True)

    def area(run):
        x, y = run[:, 0], run[:, 1]
        return np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])

    assert sum(area(run) for run in parts[0].runs) > 0
    assert sum(area(run) for run in turned[0].runs) < 0
