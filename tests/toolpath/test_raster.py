"""Rows lie where something stands, a stepover apart."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.finish import scallop_stepover
from relieffab.toolpath.passes import Ground, Work
from relieffab.toolpath.raster import graded_rows, rows, standing
from relieffab.toolpath.trace import SKIN

GRID = Grid(40, 60, 0.1, (1.0, 6.0))
BALL = Cutter("c", "ball", 0.8, 9.0, 1.0, 800.0, 200.0, 9000.0)


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


def work_over(heights, cutter=BALL, least=0.01):
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    return Work(Ground(Terrain.over(GRID, heights), cutter, SKIN), slab, 1.0, 0.004, least, 0.05)


EVERYWHERE = np.ones(GRID.shape, bool)


@pytest.mark.parametrize("angle", [0.0, 30.0, 90.0, -120.0])
def test_rows_are_even_and_close_enough(angle):
    work = work_over(np.full(GRID.node_shape, -0.5))
    trace = rows(work, EVERYWHERE, angle, 0.33)
    turn = np.radians(angle)
    across = trace.xy @ [np.sin(turn), -np.cos(turn)]
    lines = np.unique(across.round(9))
    assert np.diff(lines).max() <= 0.33
    assert np.ptp(np.diff(lines)) < 1e-8
    assert trace.steps[trace.joined].max() <= 0.05 + 1e-9
    # Each row lies to the right of the one before, and goes the way of the angle.
    assert (np.diff(across) > -1e-9).all()
    assert (np.diff(trace.xy @ [np.cos(turn), np.sin(turn)])[trace.joined] > 0).all()


def test_rows_lie_on_the_cutter_locations_and_know_their_stock():
    trace = rows(work_over(disc()), EVERYWHERE, 20.0, 0.2)
    terrain = Terrain.over(GRID, disc())
    assert np.allclose(trace.z, tip_heights(terrain, BALL, *trace.xy.T, allowance=SKIN), atol=1e-9)
    assert (trace.top == 0).all()
    assert (trace.z < -0.01).mean() > 0.9


def test_a_row_is_broken_where_nothing_stands():
    where = EVERYWHERE.copy()
    where[:, 20:30] = False
    trace = rows(work_over(np.full(GRID.node_shape, -0.5)), where, 0.0, 1.0)
    assert len(np.unique(trace.run)) == 2 * len(np.unique(trace.xy[:, 1].round(9)))
    inside = (trace.xy[:, 0] > 3.0 + 1e-9) & (trace.xy[:, 0] < 4.0 - 1e-9)
    assert not inside.any()


def test_nowhere_gives_no_rows():
    nowhere = np.zeros(GRID.shape, bool)
    assert len(rows(work_over(disc()), nowhere, 0.0, 1.0)) == 0
    assert len(graded_rows(work_over(disc()), nowhere, 0.0, 1.0).rows) == 0


def plane(tangent):
    """Ground that falls along Y, deep enough that no border counts in the middle."""
    _, y = GRID.node_axes()
    return np.tile((-0.5 - tangent * (6.0 - y))[:, None], (1, GRID.cols + 1))


@pytest.mark.parametrize("tangent", [0.0, 0.3, 0.7])
def test_ridges_have_the_height_asked_for_on_slopes_too(tangent):
    scallop = 0.01
    trace = graded_rows(
        work_over(plane(tangent)), EVERYWHERE, 0.0, scallop_stepover(BALL, scallop)
    ).rows
    middle = trace.xy[np.abs(trace.xy[:, 0] - 4) < 0.02]
    inside = np.sort(middle[np.abs(middle[:, 1] - 4) < 1.0, 1])
    gaps = np.diff(np.unique(inside.round(9))) * np.hypot(1, tangent)
    ridge = BALL.radius - np.sqrt(BALL.radius**2 - gaps**2 / 4)
    assert np.abs(ridge / scallop - 1).max() < 0.1


def test_walls_along_the_rows_are_steep_and_walls_across_are_not():
    x, y = np.meshgrid(*GRID.node_axes())
    heights = np.where((np.abs(x - 4) < 2) & (np.abs(y - 4) < 1.2), -1.5, 0.0)
    steep = graded_rows(work_over(heights), EVERYWHERE, 0.0, 0.15).steep
    centre = steep[:, 25:35]
    assert centre.any(axis=0).all()
    assert not steep[17:23, 25:35].any()
    sides = steep[15:25, :15]
    assert sides.mean() < 0.05
