import numpy as np
import pytest

from relieffab.relief.quality.order import NEAR, one_surface, order


def test_a_scaled_model_keeps_the_order(bench, waves):
    found = order(bench.pair_of(waves, 0.1 * waves))
    assert found.local == 1
    assert found.overall == 1


def test_an_inverted_one_reverses_it(bench, waves):
    found = order(bench.pair_of(waves, -waves))
    assert found.local == -1
    assert found.overall == -1


def test_a_flat_one_has_none(bench, waves):
    found = order(bench.pair_of(waves, 0 * waves))
    assert found.local == found.overall == 0


def test_a_flat_model_has_no_pairs(bench, waves):
    found = order(bench.pair_of(0 * waves, waves))
    assert np.isnan(found.local)
    assert np.isnan(found.overall)


def test_the_same_pairs_every_time(bench, waves):
    h = waves + 0.5 * np.sin(3 * bench.x)
    assert order(bench.pair_of(waves, h)) == order(bench.pair_of(waves, h))


def test_parts_in_the_wrong_order_show_overall_and_not_locally(bench):
    """Two slanted planes; in the relief the nearer one lies deeper."""
    model = 20.0 * (bench.x > 0.1) + 0.8 * bench.y
    relief = -20.0 * (bench.x > 0.1) + 0.4 * bench.y
    found = order(bench.pair_of(model, relief))
    assert found.local == 1
    assert -0.2 < found.overall < 0.2


def test_the_way_between_pixels_stays_on_one_surface():
    sound = np.ones((20, 20), bool)
    sound[10, :15] = False
    a = np.array([8, 8, 8, 2]), np.array([5, 18, 10, 3])
    b = np.array([12, 12, 10, 9]), np.array([5, 18, 10, 9])
    assert one_surface(sound, a, b).tolist() == [False, True, False, True]
    assert NEAR >= 12


def test_half_of_it_reversed_gives_the_mean(bench):
    model = bench.x * 1.0
    relief = np.abs(bench.x)
    assert order(bench.pair_of(model, relief)).overall == pytest.approx(0, abs=0.02)
