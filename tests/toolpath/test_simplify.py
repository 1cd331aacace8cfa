"""Fewer points, above the samples and within the tolerance."""

import numpy as np
import pytest

from relieffab.toolpath.simplify import simplify
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
