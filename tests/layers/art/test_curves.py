from math import comb

import numpy as np
import pytest

from relieffab.layers.art.curves import bezier, ring


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_chords_stay_within_the_tolerance(tolerance, degree):
    rng = np.random.default_rng(degree)
    for _ in range(20):
        control = rng.normal(size=(degree + 1, 2)) * 3
        chords = bezier(control, tolerance)
        t = np.linspace(0, 1, 2000)[:, None]
        exact = sum(
            comb(degree, k) * t**k * (1 - t) ** (degree - k) * control[k] for k in range(degree + 1)
        )
        at = t[:, 0] * (len(chords) - 1)
        near = np.stack([np.interp(at, np.arange(len(chords)), c) for c in chords.T], axis=1)
        assert np.hypot(*(near - exact).T).max() <= tolerance * 1.001
        np.testing.assert_allclose(chords[[0, -1]], control[[0, -1]])
        assert len(chords) < 4 + 12 / np.sqrt(tolerance)


def test_a_ring_does_not_repeat_its_points():
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], float)
    lines = [corners[k : k + 2] for k in range(4)]
    closed = ring(lines, 0.1, closed=True)
    np.testing.assert_array_equal(closed.points, corners[:4])
    np.testing.assert_array_equal(ring(lines, 0.1, closed=False).points, corners)
    assert ring([corners[[0, 0]]], 0.1, closed=True) is None
