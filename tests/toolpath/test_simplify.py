"""Fewer points, above the samples and within the tolerance."""

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.toolpath.path import Toolpath
from relieffab.toolpath.simplify import simplify, thin
from relieffab.toolpath.trace import Trace


def trace_of(z, runs=1):
    n = len(z)
    xy = np.column_stack([0.05 * np.arange(n), np.zeros(n)])
    run = np.arange(n) * runs // n
    return Trace(xy, np.asarray(z, float), run, np.zeros(n, bool))


@pytest.mark.parametrize("tolerance", [0.001, 0.01, 0.1])
def test_chords_lie_between_the_samples_and_the_tolerance(tolerance):
    rng = np.random.default_rng(6)
    full = trace_of(np.sin(np.arange(600) / 20) + 0.01 * rng.random(600), runs=5)
    thin = simplify(full, tolerance)
    for run in range(5):
        mine, kept = full.run == run, thin.run == run
        chord = np.interp(full.xy[mine, 0], thin.xy[kept, 0], thin.z[kept])
        above = chord - full.z[mine]
        slope = np.abs(np.diff(full.z[mine])).max() / 0.05
        assert above.min() > -1e-12
        assert above.max() <= tolerance * np.hypot(1, slope) + 1e-12
        assert thin.xy[kept][0, 0] == full.xy[mine][0, 0]
        assert thin.xy[kept][-1, 0] == full.xy[mine][-1, 0]


def test_a_straight_slope_needs_two_points_a_run():
    assert len(simplify(trace_of(0.1 * np.arange(100), runs=4), 1e-6)) == 8


def test_a_coarser_tolerance_keeps_fewer_points():
    full = trace_of(np.sin(np.arange(600) / 20))
    counts = [len(simplify(full, tolerance)) for tolerance in (0.0005, 0.005, 0.05)]
    assert counts[0] > 2 * counts[1] > 4 * counts[2]


def test_corners_stay():
    full = trace_of(np.zeros(50))
    full.corner[20] = True
    assert simplify(full, 0.1).xy[:, 0].tolist() == pytest.approx([0.0, 1.0, 2.45])


def test_single_samples_pass_through():
    full = Trace(np.zeros((3, 2)), np.arange(3.0), np.arange(3), np.zeros(3, bool))
    assert simplify(full, 0.1).z.tolist() == [0, 1, 2]
    assert len(simplify(trace_of([1.0]), 0.1)) == 1


def wavy(step=0.05, feeds=(600.0,)):
    x = np.arange(0, 30, step)
    y = np.where(x < 15, 2.0, 2.0 + (x - 15))
    z = -1 - 0.6 * np.sin(x) - 0.2 * np.sin(5 * x)
    points = np.column_stack([x, y, z])
    points = np.concatenate([[[0, 2, 5]], points, [[x[-1], y[-1], 5]]])
    feed = np.concatenate([[np.inf], np.resize(feeds, len(x)), [np.inf]])
    ball = Cutter("b", "ball", 2.0, 6.0, 5.0, 800.0, 300.0, 8000.0)
    return Toolpath("finish", points, feed, ball, 8000.0)


def test_thinned_paths_rise_within_the_tolerance_and_never_sink():
    path = wavy()
    low = path.points[1:-1]
    for tolerance in (0.002, 0.01, 0.05):
        thinner = thin(path, tolerance)
        x, z = thinner.points[1:-1, 0], thinner.points[1:-1, 2]
        above = np.interp(low[:, 0], x, z) - low[:, 2]
        assert above.min() >= -1e-9
        along = np.hypot(*np.diff(low[:, :2], axis=0).T)
        steep = np.abs(np.diff(low[:, 2])) / along
        slope = np.maximum(np.append(steep, 0), np.insert(steep, 0, 0))
        assert (above <= tolerance * np.hypot(1, slope) + 1e-9).all()
        y = np.where(x < 15, 2.0, 2.0 + (x - 15))
        assert np.allclose(thinner.points[1:-1, 1], y, atol=1e-9)
        assert np.array_equal(thinner.points[[0, -1]], path.points[[0, -1]])
        assert np.isinf(thinner.feed[[0, -1]]).all()
    assert len(thin(path, 0.01).points) < len(path.points) / 2
    assert thin(path, 0.0) is path


def test_a_thinned_move_goes_at_the_least_feed_of_those_it_stands_for():
    path = wavy(feeds=(600.0, 500.0, 700.0, 400.0))
    thinner = thin(path, 0.01)
    kept = np.searchsorted(path.points[1:-1, 0], thinner.points[1:-1, 0] - 1e-9)
    for k in range(1, len(kept)):
        between = path.feed[1:-1][kept[k - 1] + 1 : kept[k] + 1]
        assert thinner.feed[k + 1] == between.min()
    assert set(thinner.feed[2:-1]) <= {400.0, 500.0, 600.0, 700.0}


def test_slow_turns_do_not_add_up():
    angle = np.linspace(0, 1, 4000)
    arc = np.column_stack([20 * np.cos(angle), 20 * np.sin(angle), np.full(4000, -1.0)])
    path = Toolpath("finish", arc, np.full(4000, 600.0), wavy().cutter, 8000.0)
    left = thin(path, 0.01).points
    middle = 0.5 * (left[1:] + left[:-1])
    assert np.abs(np.hypot(middle[:, 0], middle[:, 1]) - 20).max() < 1e-3
