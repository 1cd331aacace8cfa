import numpy as np
import pytest

from relieffab.relief.quality.angle import angle, gradient_angle, normal_angle


def test_a_scaled_model_leans_as_the_model_does(bench, waves):
    found = angle(bench.pair_of(waves, 0.1 * waves))
    assert found.gradient == pytest.approx(0, abs=1e-6)
    assert found.normal == pytest.approx(0, abs=0.01)
    assert found.scale == pytest.approx(10, rel=1e-3)


def test_an_inverted_relief_leans_the_other_way(bench, waves):
    found = angle(bench.pair_of(waves, -waves))
    assert found.gradient == pytest.approx(180, abs=1e-6)
    assert found.scale < 0.01


def test_a_flat_relief_leans_no_way(bench, waves):
    pair = bench.pair_of(waves, 0 * waves)
    found = angle(pair)
    assert found.gradient == 90
    tilt = np.degrees(np.arctan(np.hypot(*pair.model_slopes[:, pair.sound])))
    assert found.normal == pytest.approx(tilt.mean())


def test_angles_of_known_slopes():
    model, turned = np.array([[1.0], [0.0]]), np.array([[0.5], [0.5]])
    assert gradient_angle(model, turned) == pytest.approx(45)
    assert normal_angle(model, 0 * model, 1.0) == pytest.approx(45)
    assert normal_angle(model, turned, 0.0) == pytest.approx(45)
    assert np.isnan(gradient_angle(0 * model, turned))


def test_steep_slopes_weigh_three_at_most():
    model = np.array([[100.0, 1.0], [0.0, 0.0]])
    relief = np.array([[0.0, 1.0], [1.0, 0.0]])
    assert gradient_angle(model, relief) == pytest.approx(90 * 3 / 4)


def test_occlusions_do_not_count(bench):
    step = 9.0 * (bench.x > 0.1) + 0.5 * bench.x
    far = np.where(bench.x > 0.1, 0.5 * bench.x - 8.0, 0.5 * bench.x)
    assert angle(bench.pair_of(step, far)).gradient == pytest.approx(0, abs=1e-6)
