import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.entry import SLOPE, entry
from relieffab.toolpath.envelope import Terrain, tip_heights
from relieffab.toolpath.passes import Ground, Pass, Work
from relieffab.toolpath.trace import SKIN

GRID = Grid(100, 100, 0.1, (0.0, 10.0))
FLAT = Cutter("c", "flat", 2.0, 9.0, 1.0, 800.0, 200.0, 9000.0)
SHORT = np.array([[5.0, 5.0, -0.9], [5.1, 5.0, -0.9]])
RIM = np.array([[4.0, 4.0, -0.9], [6.0, 4.0, -0.9], [6.0, 6.0, -0.9], [4.0, 6.0, -0.9]])


def pocket(wide, runs):
    """A pass over a square pocket 0.9 mm deep."""
    x, y = np.meshgrid(*GRID.node_axes())
    heights = np.where(np.maximum(abs(x - 5), abs(y - 5)) <= wide / 2, -0.9 - SKIN, 0.0)
    slab = Terrain.over(GRID, np.zeros(GRID.node_shape))
    work = Work(Ground(Terrain.over(GRID, heights), FLAT, SKIN), slab, 2.0, 0.004, 0.02, 0.05)
    return Pass(work, 1, runs, np.zeros((len(runs), 2)), fixed=True)


def slopes(points):
    steps = np.hypot(*np.diff(points[:, :2], axis=0).T)
    return np.diff(points[:, 2])[steps > 0] / steps[steps > 0]


def test_a_run_too_short_to_slope_along_is_entered_by_a_helix():
    part = pocket(4.4, [SHORT, RIM])
    way = entry(part, SHORT, 0.0)
    np.testing.assert_allclose(way[0], [5.0, 5.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(way[-1], SHORT[0], atol=0.01)
    assert -SLOPE - 1e-6 <= slopes(way).min() <= slopes(way).max() <= 1e-6
    middle = (way[:, :2].min(axis=0) + way[:, :2].max(axis=0)) / 2
    radius = np.hypot(*(way[:, :2] - middle).T)
    assert radius.max() == pytest.approx(0.4, abs=0.01)
    assert radius.min() > 0.38
    level = way[way[:, 2] < -0.895]
    assert np.hypot(*np.diff(level[:, :2], axis=0).T).sum() > 2 * np.pi * 0.38


def test_a_helix_never_goes_below_the_cutter_locations():
    for wide in np.arange(2.2, 3.6, 0.2):
        part = pocket(wide, [SHORT, RIM])
        way = entry(part, SHORT, 0.0)
        for share in np.linspace(0, 1, 5) if len(way) else ():
            at = way[:-1] * (1 - share) + way[1:] * share
            low = tip_heights(part.work.relief, FLAT, at[:, 0], at[:, 1])
            assert (at[:, 2] - low).min() > -1e-6


def test_where_no_circle_has_room_there_is_no_way():
    assert len(entry(pocket(2.2, [SHORT, RIM]), SHORT, 0.0)) == 0
    narrow = entry(pocket(2.7, [SHORT, RIM]), SHORT, 0.0)
    assert np.ptp(narrow[:, :2], axis=0).max() == pytest.approx(0.2, abs=0.02)


def test_a_helix_stays_where_the_runs_are():
    beside = np.array([[5.0, 4.0, -0.9], [5.0, 6.0, -0.9], [8.0, 6.0, -0.9]])
    way = entry(pocket(4.4, [SHORT, beside]), SHORT, 0.0)
    assert way[:, 0].min() >= 5.0 - 1e-9
    assert len(entry(pocket(4.4, [SHORT]), SHORT, 0.0)) == 0


def test_a_long_run_is_sloped_along_and_one_at_the_stocks_height_is_not():
    long = RIM[:2]
    part = pocket(4.4, [long])
    way = entry(part, long, 0.0)
    np.testing.assert_allclose(way[[0, -1]], [[4, 4, 0], long[0]], atol=1e-9)
    assert slopes(way).min() >= -SLOPE - 1e-6
    assert way[:, 2].min() == pytest.approx(-0.9)
    assert len(entry(part, long, -0.85)) == 0
