import numpy as np
import pytest

from relieffab.relief.classic.bilateral import bilateral, filtered


def slowly_filtered(v, sound, sigma, tolerance):
    """The definition, pixel by pixel."""
    out, reach = np.zeros_like(v), max(1, round(2 * sigma))
    for i, j in np.argwhere(sound):
        total, mass = np.zeros(2), 0.0
        for a, b in np.argwhere(sound):
            if max(abs(a - i), abs(b - j)) > reach:
                continue
            apart = ((v[:, a, b] - v[:, i, j]) ** 2).sum() / (2 * tolerance) ** 2
            w = np.exp(-((a - i) ** 2 + (b - j) ** 2) / (2 * sigma**2)) * max(1 - apart, 0) ** 2
            total += w * v[:, a, b]
            mass += w
        out[:, i, j] = total / mass
    return out


@pytest.mark.parametrize("sigma", [0.6, 1.5])
def test_the_filter_is_its_definition(sigma):
    rng = np.random.default_rng(0)
    v, sound = rng.normal(size=(2, 14, 17)), rng.random((14, 17)) < 0.8
    found = filtered(v, sound, sigma, 0.7)
    np.testing.assert_allclose(found, slowly_filtered(v, sound, sigma, 0.7), atol=1e-5)


def test_edges_of_the_slopes_stay_and_ripples_go():
    x = np.arange(60.0)[None].repeat(40, axis=0)
    edge = np.where(x > 30, 2.0, -2.0)
    v = np.stack([edge + 0.05 * np.sin(2.0 * x), 0 * x])
    out = filtered(v, np.ones(x.shape, bool), 4.0, 0.5)
    assert np.abs(out[0] - edge)[:, 10:50].max() < 0.02


def test_no_tolerance_filters_nothing():
    v = np.random.default_rng(0).normal(size=(2, 9, 9))
    np.testing.assert_allclose(filtered(v, np.ones((9, 9), bool), 2.0, 0.0), v, rtol=1e-6)


def test_a_plane_stays_a_plane(slanted):
    h = bilateral(slanted, 2.0)[12:-12, 14:-14]
    assert np.abs(np.diff(h, 2, axis=1)).max() < 1e-3
    assert (np.diff(h, axis=1) > 0).all()


def test_a_jump_is_closed(stepped):
    h = bilateral(stepped, 2.0)
    assert np.abs(h[40, 51] - h[40, 49]) < 0.25


def test_detail_rises_above_the_form(rippled, band):
    assert band(rippled, bilateral) > 1.7
