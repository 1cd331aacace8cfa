"""Too deep a cut is taken twice, and cuts nothing else."""

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from relieffab.cutter import Cutter
from relieffab.gcode.ease import eased
from relieffab.gcode.moves import stepped
from relieffab.gcode.setup import Setup
from relieffab.gcode.slab import Slab
from relieffab.gcode.write import write_program
from relieffab.grid import Grid
from relieffab.machine import Machine, Material
from relieffab.stock import Stock
from relieffab.toolpath.path import Toolpath

GRID = Grid(20, 30, 0.5, (0.0, 10.0))
BALL = Cutter("b", "ball", 2.0, 6.0, 1.0, 800.0, 300.0, 8000.0)
MACHINE = Machine("m", "", (200.0,) * 3, (2000.0,) * 3, (30.0,) * 3, (0.0, 1e4), 1e4)
SETUP = Setup(MACHINE, Material("w", "W", 1.0, 1.0), Stock(15.0, 10.0, 8.0), 5.0)


def path_of(places):
    points = np.array([[*places[0][:2], 5.0], *places, [*places[-1][:2], 5.0]])
    feed = np.array([np.inf, *[300.0] * len(places), np.inf])
    return Toolpath("rough", points, feed, BALL, 8000.0)


def test_what_is_shallow_enough_is_left_alone():
    path = path_of([[3, 5, -1.0], [9, 5, -1.0]])
    assert eased(path, SETUP, Slab.whole(GRID, SETUP.stock)) is path


def test_a_corner_that_stands_too_high():
    slab = Slab.whole(GRID, SETUP.stock)
    write_program(path_of([[3, 5, -1.0], [7, 5, -1.0]]), SETUP, slab)
    path = path_of([[3, 5, -1.0], [3, 5, -1.6], [7, 5, -1.6], [8, 5, -1.6], [9, 5, -1.6]])
    easier = eased(path, SETUP, slab)
    # Up by 0.6, along the bad moves, back the same way, down, and on as planned.
    assert len(path.points) < len(easier.points) <= len(path.points) + 7
    assert easier.points[:, 2].max() == 5 and (easier.points[:, 2] >= -1.6).all()
    assert slab.copy().cut(easier.points, BALL).max() <= 1.1 + 0.01
    assert np.isin(easier.feed, [300.0, np.inf]).all()
    write_program(easier, SETUP, slab)


def test_a_plunge_by_many_times_the_stepdown():
    path = path_of([[3, 5, -4.5], [9, 5, -4.5]])
    easier = eased(path, SETUP, Slab.whole(GRID, SETUP.stock))
    write_program(easier, SETUP, Slab.whole(GRID, SETUP.stock))


coordinates = st.tuples(st.floats(1, 14), st.floats(1, 9), st.floats(-4.5, 0.5))


@settings(max_examples=60, deadline=None)
@given(st.lists(coordinates, min_size=1, max_size=6))
@example([(1.0, 1.5703125, -1.1124925552437435)])
def test_it_leaves_what_the_path_itself_would_leave(places):
    path, slab = path_of(places), Slab.whole(GRID, SETUP.stock)
    easier = eased(path, SETUP, slab)
    planned, cut = slab.copy(), slab.copy()
    planned.cut(path.points, BALL)
    cut.cut(easier.points, BALL)
    # The limit is the written text's: rounding to its steps moves a bite by some micrometres.
    written = stepped(easier.points, SETUP.stock, SETUP.post) / SETUP.post.per_mm
    bites = slab.copy().cut(written, BALL)
    assert not slab.heights.any()
    assert np.abs(planned.heights - cut.heights).max() < 1e-5
    assert bites[np.isfinite(easier.feed)].max() <= SETUP.limits(BALL).deepest_pass
