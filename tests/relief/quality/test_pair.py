import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.model import Relief
from relieffab.relief.quality.pair import Pair, correlation, normals_of


def test_slopes_and_heights_are_the_models_own(bench, waves):
    pair = bench.pair_of(waves, waves)
    np.testing.assert_allclose(pair.slopes, pair.model_slopes, atol=1e-9)
    np.testing.assert_allclose(pair.heights, pair.layers.depth - waves.max(), atol=1e-12)
    np.testing.assert_allclose(normals_of(pair.slopes), pair.layers.normals, atol=1e-12)


def test_two_pixels_along_the_edge_are_left_out(bench, waves, square):
    pair = bench.pair_of(waves, waves * 0, mask=square)
    assert pair.inner.sum() == (100 - 4) * (140 - 4)
    assert not pair.inner[11].any()
    assert pair.from_edge[10, 80] == 1
    assert pair.from_edge[60, 80] == 50


def test_a_figure_that_fills_the_grid_still_has_an_edge(bench, waves):
    pair = bench.pair_of(waves, waves)
    assert pair.inner.sum() == (120 - 4) * (160 - 4)
    assert pair.from_edge[0, 80] == 1


def test_occlusions_tear_the_pixels_on_both_sides(bench):
    pair = bench.pair_of(9.0 * (bench.x > 0.1), bench.x * 0)
    torn = np.nonzero(pair.torn.any(axis=0))[0]
    assert set(torn) & {79, 80}
    assert torn.min() >= 78
    assert torn.max() <= 82
    assert not (pair.sound & pair.torn).any()


def test_correlation_has_its_neutral_values():
    a = np.array([1.0, 2.0, 4.0])
    assert correlation(a, 3 * a + 7) == pytest.approx(1)
    assert correlation(a, -a) == pytest.approx(-1)
    assert correlation(a, np.ones(3)) == 0
    assert np.isnan(correlation(np.ones(3), a))
    assert np.isnan(correlation(a[:1], a[:1]))


def test_other_pixels_are_refused(bench, waves):
    other = Relief(Grid(2, 2, 1.0, (0.0, 0.0)), np.zeros((3, 3)), np.ones((2, 2), bool), 1.0)
    with pytest.raises(InputError, match="not on the same pixels"):
        Pair(other, bench.layers_of(waves))
