import numpy as np
import pytest
from scipy import ndimage

from relieffab.relief.quality.detail import detail


def test_a_scaled_model_keeps_all_its_detail(bench, waves, square):
    found = detail(bench.pair_of(waves, 0.1 * waves, mask=square))
    for value in vars(found).values():
        assert value == pytest.approx(1, abs=1e-9)


def test_an_inverted_one_has_it_inverted_and_a_flat_one_none(bench, waves):
    assert detail(bench.pair_of(waves, -waves)).s2 == pytest.approx(-1)
    flat = detail(bench.pair_of(waves, 0 * waves))
    assert (flat.s1, flat.s8) == (0, 0)


def test_smoothing_loses_the_fine_bands(bench):
    rng = np.random.default_rng(3)
    model = ndimage.gaussian_filter(rng.normal(size=bench.x.shape), 1.0)
    model += 8 * ndimage.gaussian_filter(rng.normal(size=bench.x.shape), 8.0)
    noise = ndimage.gaussian_filter(rng.normal(size=bench.x.shape), 1.0)
    noise -= ndimage.gaussian_filter(noise, 2.0)
    found = detail(bench.pair_of(model, ndimage.gaussian_filter(model, 3.0) + 0.3 * noise))
    assert found.s1 < 0.5
    assert found.s8 > 0.95


def test_walls_at_the_edge_do_not_count(bench, waves, square):
    h = np.where(np.pad(square[1:, 1:] & square[:-1, :-1], 1), waves - 5.0, 0.0)
    found = detail(bench.pair_of(waves, h, mask=square))
    assert found.s1 > 0.99
    assert found.s2 > 0.99


def test_a_figure_too_small_for_a_band(bench, waves):
    mask = np.zeros(bench.grid.shape, bool)
    mask[40:80, 40:80] = True
    found = detail(bench.pair_of(waves, 0.01 * waves, mask=mask))
    assert found.s1 == pytest.approx(1)
    assert np.isnan(found.s8)
