import numpy as np
import pytest

from relieffab.relief.classic.gradient import attenuate, boosted, gradient


def test_attenuation_is_that_of_the_publication():
    v = np.array([[[3.0, 0.3]], [[4.0, 0.4]]])
    sound = np.ones((1, 2), bool)
    usual = 2.75
    out = attenuate(v, sound, knee=0.1, exponent=0.7)
    size = np.hypot(*out)[0]
    np.testing.assert_allclose(size, [5 * (5 / 0.275) ** -0.3, 0.5 * (0.5 / 0.275) ** -0.3])
    np.testing.assert_allclose(out[1] / out[0], 4 / 3)
    assert usual == pytest.approx(np.hypot(*v).mean())


def test_an_exponent_of_one_changes_nothing_but_what_does_not_count():
    v = np.random.default_rng(0).normal(size=(2, 8, 8))
    sound = np.arange(64).reshape(8, 8) % 5 > 0
    out = attenuate(v, sound, knee=0.1, exponent=1.0)
    np.testing.assert_allclose(out[:, sound], v[:, sound])
    assert not out[:, ~sound].any()


def test_no_slope_and_no_sound_pixel_are_no_trouble():
    zero = np.zeros((2, 4, 4))
    assert not attenuate(zero, np.ones((4, 4), bool), knee=0.1, exponent=0.7).any()
    assert not attenuate(zero + 1, np.zeros((4, 4), bool), knee=0.1, exponent=0.7).any()


def test_the_boost_leaves_what_is_even_and_lifts_what_is_fine():
    x = np.arange(60.0)[None].repeat(60, axis=0)
    v = np.stack([np.ones((60, 60)), np.sin(2.0 * x)])
    out = boosted(v, np.ones((60, 60), bool), 4.0, 3.0)
    np.testing.assert_allclose(out[0], 1.0)
    np.testing.assert_allclose(out[1, 20:40, 20:40], 3 * v[1, 20:40, 20:40], atol=0.01)


def test_a_plane_stays_a_plane(slanted):
    h = gradient(slanted, 2.0)[12:-12, 14:-14]
    assert np.abs(np.diff(h, 2, axis=0)).max() < 1e-3
    assert np.abs(np.diff(h, 2, axis=1)).max() < 1e-3
    assert (np.diff(h, axis=1) > 0).all()


def test_a_jump_is_closed(stepped):
    h = gradient(stepped, 2.0)
    assert np.abs(h[40, 51] - h[40, 49]) < 0.25


def test_detail_rises_above_the_form(rippled, band):
    assert band(rippled, gradient) > 2.0
