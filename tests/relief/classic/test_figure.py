import numpy as np
import pytest

from relieffab.relief.classic.figure import extent, model_slopes, smooth, stretch


def test_the_extent_is_the_larger_side(slanted):
    assert extent(slanted) == pytest.approx(16.0)


def test_smoothing_keeps_a_constant_up_to_the_edge():
    sound = np.zeros((30, 40), bool)
    sound[5:25, 10:30] = True
    field = np.where(sound, 3.0, np.array([1e3, -1e3])[:, None, None])
    np.testing.assert_allclose(smooth(field, sound, 2.0)[:, sound], 3.0)


def test_smoothing_is_a_weighted_mean():
    rng = np.random.default_rng(0)
    field, sound = rng.normal(size=(25, 25)), rng.random((25, 25)) < 0.7
    i, j = np.indices(field.shape)
    bell = np.exp(-((i - 12) ** 2 + (j - 12) ** 2) / (2 * 1.5**2)) * sound
    want = (bell * field).sum() / bell.sum()
    assert smooth(field, sound, 1.5)[12, 12] == pytest.approx(want, rel=1e-3)


def test_pixels_beside_a_jump_are_not_whole(stepped):
    slope, whole = model_slopes(stepped)
    assert not whole[20:60, 49:51].any()
    assert whole[20:60, 20:48].all()
    assert np.abs(slope).max() < 1.0


def test_stretching_uses_the_whole_depth_exactly():
    rng = np.random.default_rng(0)
    figure = rng.random((20, 20)) < 0.5
    h = stretch(rng.normal(size=(20, 20)), figure, 3.0)
    assert h[figure].min() == -3.0
    assert h[figure].max() == 0.0
    assert (h[~figure] == 0).all()


def test_tails_are_cut_off_and_the_rest_gets_their_room():
    heights = np.arange(1001.0)[None]
    heights[0, -1] = 1e6
    h = stretch(heights, np.ones((1, 1001), bool), 1.0, tails=1.0)
    assert h[0, 500] == pytest.approx(-0.5, abs=0.01)
    assert h[0, -1] == 0.0
    assert h[0, 0] == -1.0


@pytest.mark.parametrize("noise", [0.0, 1e-12])
def test_what_is_even_stays_at_the_face(noise):
    heights = 5.0 + noise * np.random.default_rng(0).normal(size=(6, 6))
    assert not stretch(heights, np.ones((6, 6), bool), 2.0).any()
