from functools import partial

import numpy as np
import pytest
from scipy import ndimage

from relieffab.relief.reach import NEAR, carvable, closing
from relieffab.toolpath.reach import leaves

PITCH = 0.1


def dense(heights, times):
    """Points of the relief's triangles, so many a pixel's side."""
    rows, cols = (n - 1 for n in heights.shape)
    v, u = np.meshgrid(np.arange(rows * times + 1), np.arange(cols * times + 1), indexing="ij")
    i, j = np.minimum(v // times, rows - 1), np.minimum(u // times, cols - 1)
    s, t = v / times - i, u / times - j
    a, b = heights[i, j], heights[i, j + 1]
    c, d = heights[i + 1, j], heights[i + 1, j + 1]
    return np.where(s >= t, a + (c - a) * s + (d - c) * t, a + (b - a) * t + (d - b) * s)


@pytest.fixture(scope="module")
def hollow():
    """A floor of bumps between steep walls, with a groove, and the face around it."""
    rng = np.random.default_rng(4)
    h = ndimage.gaussian_filter(rng.normal(size=(46, 58)), 3.0) * 4 - 1.0
    x, y = np.arange(58), np.arange(46)
    h -= 0.8 * np.clip(1 - np.abs(x - 31) / 3, 0, 1)
    edge = np.minimum(np.minimum(x, 57 - x)[None, :], np.minimum(y, 45 - y)[:, None]) - 6
    return np.clip(np.maximum(h, -0.4 * edge), -2.0, 0.0)


def test_it_is_the_closing_of_the_triangles(hollow, every_cutter):
    """Of points so many that between them little is hidden, by the lattice's own closing."""
    times = 5
    fine = closing(dense(hollow, times), PITCH / times, every_cutter.profile)[::times, ::times]
    found = leaves(hollow, PITCH, every_cutter)
    assert (found >= hollow).all()
    assert found.max() <= 0
    off = found - fine
    # Where a rim or a flank leaves a wall, tips between two nodes are not on a line.
    assert np.quantile(np.abs(off), 0.8) < 0.03
    assert np.quantile(off, 0.01) > -0.04
    assert -0.12 < off.min() <= off.max() < 0.2
    assert (found > hollow + 0.1).any()


@pytest.mark.parametrize("shape", ["ball", "tapered ball"])
def test_what_is_raised_can_be_carved(hollow, cutters, shape):
    cutter = cutters[shape]
    raised = carvable(hollow, PITCH, partial(leaves, cutter=cutter))
    assert (raised >= hollow).all()
    assert raised.max() <= 0
    np.testing.assert_array_equal(raised[hollow == 0], 0.0)
    assert (leaves(hollow, PITCH, cutter) - hollow).max() > 0.3
    assert (leaves(dense(raised, 3), PITCH / 3, cutter)[::3, ::3] - raised).max() < NEAR + 0.002


def test_what_can_be_carved_stays_as_it_is(cutters):
    level = np.zeros((30, 30))
    np.testing.assert_array_equal(leaves(level, PITCH, cutters["ball"]), level)
    x = PITCH * np.arange(-30, 31)
    bowl = np.minimum(4.2 - np.sqrt(25.0 - x**2 - x[:, None] ** 2), 0.0)
    assert bowl.min() < -0.7
    assert carvable(bowl, PITCH, partial(leaves, cutter=cutters["ball"])) is bowl


def test_a_figure_at_the_grids_border_is_closed_as_elsewhere(hollow, cutters):
    inner = leaves(hollow, PITCH, cutters["ball"])[6:-6, 6:-6]
    cut = leaves(np.ascontiguousarray(hollow[5:-5, 5:-5]), PITCH, cutters["ball"])[1:-1, 1:-1]
    np.testing.assert_allclose(cut, inner, atol=1e-9)
