import numpy as np
import pytest

from relieffab.relief.edge import inward_distance, wall


def disc(radius, size=80):
    i, j = np.indices((size, size)) + 0.5
    return np.hypot(i - size / 2, j - size / 2) < radius


def test_distance_to_a_discs_edge_is_smooth_and_right():
    d = inward_distance(disc(30))
    i, j = np.indices((81, 81))
    true = 30 - np.hypot(i - 40, j - 40)
    near = np.abs(true) < 5
    assert np.abs(d - true)[near].max() < 0.6
    assert np.abs(d - true)[near].mean() < 0.25


def test_the_wall_has_its_angle():
    w = wall(disc(30), 0.2, 80.0, 3.0)
    assert (w[:9] == 0).all()
    slope = (w[40, 16] - w[40, 20]) / (4 * 0.2)
    assert np.degrees(np.arctan(slope)) == pytest.approx(80, abs=0.5)


def test_a_free_wall_is_down_within_a_pixel():
    w = wall(disc(30), 0.2, 90.0, 3.0)
    away = inward_distance(disc(30))
    assert (w[away >= 1.0] <= -3.0).all()
    assert (w[away <= 0.0] == 0).all()


def test_thin_strokes_and_dots_keep_their_depth():
    stroke = np.zeros((60, 40), bool)
    stroke[:, 10:16] = True
    assert inward_distance(stroke)[30, 13] > 1.8  # of 2.5, 1.3 by the wider smoothing alone
    dot = np.zeros((20, 20), bool)
    dot[8:12, 8:12] = True
    assert wall(dot, 0.2, 80.0, 3.0).min() < -0.05
