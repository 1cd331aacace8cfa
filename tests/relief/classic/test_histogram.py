import numpy as np
import pytest

from relieffab.relief.classic.histogram import BINS, FINENESS, histogram, ranks


def slow_rank(level, weight, at, sigma, limit):
    """Weighted share of the neighbours that are lower, contrast limited."""
    i, j = np.indices(level.shape)
    bell = np.exp(-((i - at[0]) ** 2 + (j - at[1]) ** 2) / (2 * sigma**2)) * weight
    bins = np.minimum((BINS * level).astype(int), BINS - 1)
    share = np.bincount(bins.ravel(), bell.ravel(), BINS) / bell.sum()
    kept = np.minimum(share, limit / BINS)
    kept += (1 - kept.sum()) / BINS
    rank = np.concatenate([[0.0], np.cumsum(kept)])
    return np.interp(BINS * level[at], np.arange(BINS + 1), rank)


@pytest.mark.parametrize("limit", [3.0, 1e9])
def test_a_rank_is_its_definition(limit):
    i, j = np.indices((48, 56))
    level = 0.5 + 0.3 * np.sin(i / 9) * np.cos(j / 7) + 0.003 * j
    weight = np.where((i - 24) ** 2 + (j - 28) ** 2 < 21**2, 1.0 + (j % 4), 0.0)
    # The lattice and its splines widen the bell a little.
    sigma = 6.0
    wider = sigma * np.sqrt(1 + (1 / 6 + 1 / 3) / FINENESS**2)
    found = ranks(level, weight, sigma, limit)
    for at in [(24, 28), (14, 20), (30, 40), (24, 12)]:
        want = slow_rank(level, weight, at, wider, limit)
        assert found[at] == pytest.approx(want, abs=0.015)
    assert (found[weight == 0] == 0).all()


def test_a_limit_of_none_changes_nothing():
    level = np.random.default_rng(0).random((30, 30))
    found = ranks(level, np.ones((30, 30)), 4.0, 0.0)
    np.testing.assert_allclose(found, level, atol=1 / BINS)


def test_no_contrast_beyond_the_limit():
    level = 0.5 + 0.05 * np.random.default_rng(0).random((60, 60))
    found = ranks(level, np.ones((60, 60)), 8.0, 4.0)[25:35, 25:35].ravel()
    gain = np.polyfit(level[25:35, 25:35].ravel(), found, 1)[0]
    assert 3.5 < gain < 5.0


def test_order_is_kept_within_one_neighbourhood():
    level = np.random.default_rng(0).random((40, 40))
    found = ranks(level, np.ones((40, 40)), 1e4, 4.0)
    assert (np.diff(found.ravel()[np.argsort(level.ravel())]) > -1e-9).all()


def test_a_jump_shrinks(stepped):
    h = histogram(stepped, 2.0)
    jump = h[40, 52] - h[40, 48]
    before = 6.0 / np.ptp(stepped.depth[stepped.mask]) * 2.0
    assert 0 < jump < 0.8 * before


def test_detail_rises_above_the_form(rippled, band):
    assert band(rippled, histogram) > 1.3
