"""Lines along strips, and distances over a surface."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.envelope import Terrain, nodes, tip_surface
from relieffab.toolpath.passes import Ground, Work
from relieffab.toolpath.remains import after
from relieffab.toolpath.strips import from_border, strips
from relieffab.toolpath.trace import SKIN, sample

GRID = Grid(80, 80, 0.1, (0.0, 8.0))
COMMON = (9.0, 1.0, 800.0, 200.0, 9000.0)
BALL, FINE = (Cutter("c", "ball", size, *COMMON) for size in (3.0, 0.8))


def pit_work():
    """A square pit, its corners and foot left standing by the larger ball."""
    x, y = np.meshgrid(*GRID.node_axes())
    relief = Terrain.over(GRID, np.where(np.maximum(abs(x - 4), abs(y - 4)) < 2.5, -1.5, 0.0))
    tips = tip_surface(relief, BALL, nodes(GRID))
    at = np.column_stack([x.ravel(), y.ravel(), tips.ravel()])
    left = after(np.zeros(GRID.node_shape), GRID, BALL, at)
    return Work(Ground(relief, FINE, SKIN), Terrain.over(GRID, left), 2.0, 0.004, 0.04, 0.05)


def test_strips_clear_what_stands_and_stay_near_it():
    work = pit_work()
    lines = strips(work, 0.15)
    low, _ = work.follow(sample(lines, work.step))
    left = after(work.stock.heights, GRID, FINE, np.column_stack([low.xy, low.z]))
    best = tip_surface(Terrain.over(GRID, left), FINE, nodes(GRID)) - work.ground.low(nodes(GRID))
    assert np.quantile(best, 0.999) < 0.06
    # Over the middle of the floor the larger ball left nothing.
    assert not (np.abs(low.xy - 4).max(axis=1) < 1.0).any()


def test_nothing_standing_has_no_strips():
    work = pit_work()
    done = Work(Ground(work.relief, FINE, SKIN), work.relief, 2.0, 0.004, 0.5, 0.05)
    assert strips(done, 0.15) == []


@pytest.mark.parametrize("tangent", [0.0, 2.0])
def test_distances_are_taken_over_the_surface(tangent):
    there = np.zeros((40, 40), bool)
    there[:, 10:31] = True
    low = np.tile(-tangent * 0.1 * np.arange(40.0), (40, 1))
    away = from_border(there, low, 0.1)
    assert away[20, 20] == pytest.approx(1.05 * np.hypot(1, tangent), rel=0.01)
    assert (away[:, :10] == 0).all()
