import numpy as np
import pytest

from relieffab.relief.classic.weyrich import STEP, banded, compress_size, toward, weyrich


def test_the_size_of_slopes_is_compressed_by_its_logarithm():
    v = np.array([[[3.0, 0.0, 1e-6]], [[4.0, 0.0, 0.0]]])
    out = compress_size(v, 5.0)
    assert np.hypot(*out)[0, 0] == pytest.approx(np.log(26.0) / 5)
    assert out[1, 0, 0] / out[0, 0, 0] == pytest.approx(4 / 3)
    assert out[0, 0, 1] == 0
    assert out[0, 0, 2] == pytest.approx(1e-6, rel=1e-5)


def test_bands_of_equal_gain_add_up():
    v = np.random.default_rng(0).normal(size=(2, 20, 20))
    sound = np.random.default_rng(1).random((20, 20)) < 0.8
    out = banded(v, sound, [1.0, 2.0], (3.0, 3.0, 3.0))
    np.testing.assert_allclose(out[:, sound], 3 * v[:, sound])
    assert not out[:, ~sound].any()


def test_each_band_has_its_gain():
    x = np.arange(120.0)[None].repeat(120, axis=0)
    v = np.stack([np.sin(2.5 * x), np.ones(x.shape)])
    out = banded(v, np.ones(x.shape, bool), [3.0, 8.0], (5.0, 1.0, 0.5))
    np.testing.assert_allclose(out[0, 50:70, 50:70], 5 * v[0, 50:70, 50:70], atol=0.01)
    np.testing.assert_allclose(out[1], 0.5)


def test_jumps_point_from_far_to_near(stepped):
    way = toward(stepped)
    np.testing.assert_allclose(way[0, 20:60, 49:51], 1.0, atol=0.01)
    assert not way[:, ~stepped.mask].any()


def test_a_jump_becomes_a_small_step_up(stepped):
    h = weyrich(stepped, 2.0)
    across = h[20:60, 51] - h[20:60, 49]
    assert (across > 0).all()
    assert across.mean() < 3 * STEP * 2.0


def test_a_plane_stays_a_plane(slanted):
    h = weyrich(slanted, 2.0)[12:-12, 14:-14]
    assert np.abs(np.diff(h, 2, axis=1)).max() < 1e-3
    assert (np.diff(h, axis=1) > 0).all()


def test_detail_rises_above_the_form(rippled, band):
    assert band(rippled, weyrich) > 2.0
