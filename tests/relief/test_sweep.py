import numpy as np
import pytest

from relieffab.relief.reach import ball
from relieffab.relief.sweep import reach_of, sweep


def plainly(row, col, deep, profile, pitch, shape):
    """Stand the tip at many places of the way."""
    out = np.zeros(shape)
    i, j = np.indices(shape)
    for k in range(len(row) - 1):
        for s in np.linspace(0, 1, 400):
            y, x = (a[k] + s * (a[k + 1] - a[k]) for a in (row, col))
            depth = deep[k] + s * (deep[k + 1] - deep[k])
            out = np.minimum(out, profile(np.hypot(i - y, j - x) * pitch) - depth)
    return out


def test_a_swept_tip_is_the_tip_at_every_place_of_its_way():
    row, col = np.array([8.3, 20.1, 25.0]), np.array([7.2, 14.9, 33.0])
    deep, profile, pitch = np.array([0.3, 0.3, 0.3]), ball(0.8), 0.1
    reach = 0.79
    table = profile(np.linspace(0, reach, 800))
    out = np.zeros((34, 42))
    sweep(row, col, deep, table, reach, pitch, out)
    np.testing.assert_allclose(out, plainly(row, col, deep, profile, pitch, out.shape), atol=2e-3)


def test_reach_is_where_a_cutter_leaves_the_surface():
    assert reach_of(ball(1.0), 0.2) == pytest.approx(0.6, rel=0.1)
    assert reach_of(ball(1.0), 0.2) >= 0.6
