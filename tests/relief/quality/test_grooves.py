import numpy as np
import pytest

from relieffab.relief.quality.grooves import beside, groove_depths, groove_widths, section

POINTS = np.column_stack([np.arange(30.0, 50.0), np.full(20, 40.0)])
ACROSS = np.broadcast_to([0.0, 1.0], POINTS.shape)


def surface(height):
    return np.broadcast_to(height(np.arange(81.0) - 40.0), (81, 81)).copy()


def vee(t, depth, half):
    return -depth * np.maximum(1 - np.abs(t) / half, 0)


def test_a_section_is_bilinear():
    i, j = np.indices((9, 9)).astype(float)
    found = section(2 * i + 3 * j, np.array([[4.0, 4.0]]), np.array([0.6, 0.8]), np.array([-1, 2]))
    np.testing.assert_allclose(found, [[20 - 3.6, 20 + 7.2]])


def test_a_groove_is_as_deep_as_it_was_cut():
    depth, way = groove_depths(surface(lambda t: vee(t, 0.5, 3)), POINTS, 4.0)
    np.testing.assert_allclose(depth, 0.5)
    np.testing.assert_allclose(np.abs(way), np.abs(ACROSS), atol=1e-9)


def test_so_it_is_on_a_slope_and_a_pixel_off_the_line():
    leaning = surface(lambda t: 0.4 * t + vee(t - 1, 0.5, 3))
    np.testing.assert_allclose(groove_depths(leaning, POINTS, 4.0)[0], 0.5)


@pytest.mark.parametrize(
    "height",
    [
        lambda t: 0.7 * t,
        lambda t: -2.0 * (t > 0),
        lambda t: -0.5 * np.abs(t),
        lambda t: 0 * t,
    ],
    ids=["slope", "step", "roof", "flat"],
)
def test_what_is_no_groove(height):
    depth, _ = groove_depths(surface(height), POINTS, 4.0)
    assert depth.max() < 1e-9


def test_a_groove_at_the_foot_of_a_step():
    foot = surface(lambda t: 3.0 * (t < -2.5) + vee(t, 0.5, 2))
    np.testing.assert_allclose(groove_depths(foot, POINTS, 4.0)[0], 0.5)


def test_the_width_at_half_depth():
    wide = groove_widths(surface(lambda t: vee(t, 0.5, 3)), POINTS, ACROSS, 4.0)
    np.testing.assert_allclose(wide, 3.0, atol=0.3)
    slot = groove_widths(surface(lambda t: -1.0 * (np.abs(t) < 1.5)), POINTS, ACROSS, 4.0)
    np.testing.assert_allclose(slot, 3.0, atol=0.3)


def test_the_surface_beside_a_line_is_as_far_away_at_any_pitch():
    assert beside(0.1) == pytest.approx(7.5)
    assert beside(0.05) == pytest.approx(15)
    assert beside(5.0) == 3
