"""Rapids, entries, order and feeds."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.machine import Cutting, Machine
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.link import CLEARANCE, HOP, Linking, between, link
from relieffab.toolpath.passes import Ground, Pass, Work, passes
from relieffab.toolpath.trace import SKIN, sample

GRID = Grid(100, 160, 0.1, (0.0, 10.0))
FLAT = Cutter("c", "flat", 1.0, 9.0, 1.0, 800.0, 200.0, 9000.0)
MACHINE = Machine(
    "m", "M", (200.0,) * 3, (2000.0, 2000.0, 600.0), (50.0,) * 3, (0.0, 1e4), 1e4, safe_height=4.0
)
USE = Cutting(feed=800.0, plunge=200.0, rpm=9000.0, stepdown=0.6)


def slots():
    x, y = np.meshgrid(*GRID.node_axes())
    return np.where((np.abs(x - 8) < 6) & (np.abs(np.mod(y, 5) - 2.5) < 1.5), -1.5, 0.0)


def motion_of(stepdown, ramp):
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    work = Work(Ground(Terrain.over(GRID, slots()), FLAT, SKIN), slab, stepdown, 0.004, 0.02, 0.05)
    lines = [np.array([[1.5, y], [14.5, y]]) for y in np.arange(0.5, 10, 0.4)]
    low, top = work.follow(sample(lines, work.step))
    linking = Linking(MACHINE, USE, reach=0.6, ramp=ramp)
    return work, *link(list(passes(work, low, top)), linking)


@pytest.fixture(params=[False, True], ids=["plunge", "ramp"])
def motion(request):
    return motion_of(0.6, request.param)


def test_no_rapid_goes_below_the_face(motion):
    _, points, feed = motion
    rapid = np.isinf(feed)
    assert rapid[0] and points[0, 2] == 4.0
    # A rapid up out of a cut starts low; every rapid ends high.
    assert points[rapid, 2].min() >= CLEARANCE
    down = rapid[1:] & (np.diff(points[:, 2]) < 0)
    across = rapid[1:] & (np.hypot(*np.diff(points[:, :2], axis=0).T) > 0)
    assert not (down & across).any()
    assert points[:-1][across, 2].min() >= HOP


def test_no_cutting_move_passes_below_the_cutter_locations(motion):
    work, points, feed = motion
    for share in np.linspace(0, 1, 7):
        at = points[:-1] * (1 - share) + points[1:] * share
        at = at[np.isfinite(feed[1:])]
        assert (at[:, 2] - tip_heights(work.relief, FLAT, at[:, 0], at[:, 1])).min() > -1e-6


def test_descents_keep_to_the_plunge_feed(motion):
    _, points, feed = motion
    steps = np.diff(points, axis=0)
    cuts = np.isfinite(feed[1:])
    share = -steps[cuts, 2] / np.maximum(np.linalg.norm(steps[cuts], axis=1), 1e-12)
    assert (feed[1:][cuts] * share).max() <= USE.plunge + 1e-6
    assert feed[np.isfinite(feed)].max() == USE.feed


def test_long_ways_are_made_at_the_safe_height_and_short_ones_in_a_hop():
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    work = Work(Ground(slab, FLAT, SKIN), slab, 1.0, 0.004, 0.02, 0.05)
    runs = [np.array([[x, 0.0, -1.0], [x + 1.0, 0.0, -1.0]]) for x in (0.0, 9.0, 60.0)]
    part = Pass(work, 1, runs, np.zeros((3, 2)), fixed=True)
    points, feed = link([part], Linking(MACHINE, USE, reach=2.0))
    steps = np.hypot(*np.diff(points[:, :2], axis=0).T)
    crossing = np.isinf(feed[1:]) & (steps > 0)
    assert points[1:][crossing].tolist() == [[9.0, 0.0, HOP], [60.0, 0.0, 4.0]]


@pytest.mark.parametrize(("ramp", "least", "most"), [(False, 1.4, 1.5), (True, 0.0, 0.1)])
def test_entries_into_the_stock_are_ramps_where_asked(ramp, least, most):
    _, points, feed = motion_of(2.0, ramp)
    entries = np.flatnonzero(np.isinf(feed[:-1]) & np.isfinite(feed[1:]))
    assert len(entries) >= 2
    for k in entries:
        way = np.cumsum(np.hypot(*np.diff(points[k : k + 40, :2], axis=0).T))
        depth = -np.interp(0.3, way, points[k + 1 : k + 40, 2])
        assert least <= depth <= most


def test_neighbouring_rows_are_joined_without_a_retract(motion):
    _, points, feed = motion
    retracts = (np.isinf(feed) & (points[:, 2] >= HOP)).sum() // 2
    assert retracts <= 10


def test_nothing_to_join_is_no_motion():
    points, feed = link([], Linking(MACHINE, USE, reach=1.0))
    assert points.shape == (0, 3)
    assert len(feed) == 0


def test_a_way_lifted_at_its_ends_is_climbed_to_first():
    """Its ends stand above the runs' own: straight from run to run it would gouge."""
    way = np.array([[0.0, 0, -0.2], [1, 0, -0.2], [2, 0, -1.0]])
    start, end = np.array([0.0, 0, -0.6]), np.array([2.0, 0, -1.2])
    assert between(way, start, end).tolist() == way.tolist()
    assert between(way, way[0], way[-1]).tolist() == [[1, 0, -0.2]]
    assert len(between(way[[0, -1]], way[0], way[-1])) == 0
