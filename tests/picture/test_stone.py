"""Light on stone: Lambert's law, shadows and open sky against plain geometry."""

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.picture import hillshade, relit
from relieffab.picture.stone import horizon, lit, sky, unit_light
from relieffab.relief.model import Relief


def relief_of(function, *, rows=48, cols=64, pitch=0.1, depth=4.0):
    grid = Grid(rows, cols, pitch, (0.0, rows * pitch))
    x, y = grid.node_axes()
    heights = np.broadcast_to(function(x[None, :], y[:, None]), grid.node_shape).astype(float)
    return Relief(grid, heights.copy(), np.ones(grid.shape, bool), depth)


def test_flat_stone_is_of_one_colour():
    image = hillshade(relief_of(lambda x, y: 0 * x * y))
    assert image.dtype == np.uint8
    assert (image == image[0, 0]).all()
    assert 100 < image[0, 0, 0] < 250
    # Warm: more red than blue.
    assert image[0, 0, 0] > image[0, 0, 1] > image[0, 0, 2]


@pytest.mark.parametrize(("p", "q"), [(0.3, 0.0), (0.0, 0.2), (-0.25, 0.15), (0.1, -0.4)])
def test_slope_follows_lambert(p, q):
    relief = relief_of(lambda x, y: -2.0 + p * (x - 3.2) + q * (y - 2.4))
    light = np.array([-1.0, 1.0, 0.8])
    true = (-p * light[0] - q * light[1] + light[2]) / np.sqrt(1 + p * p + q * q)
    true = max(0.0, true / np.linalg.norm(light))
    np.testing.assert_allclose(relit(relief, light), true, atol=1e-12)


def test_face_turned_away_is_black():
    steep = relief_of(lambda x, y: -3.9 + 0.6 * x + 0 * y, depth=4.0)
    assert (relit(steep, (1.0, 0.0, 0.2)) == 0).all()


def test_horizon_behind_a_wall():
    heights = np.full((9, 40), -2.0, np.float32)
    heights[:, :10] = 0.0
    tangent = horizon(heights, 0.1, (-1.0, 0.0))
    distance = 0.1 * np.arange(1, 31)
    np.testing.assert_allclose(tangent[4, 10:39], 2.0 / distance[:29], rtol=1e-5)
    assert (tangent[:, :10] == 0).all()


def test_shadow_is_as_long_as_the_wall_is_deep():
    heights = np.full((9, 80), -1.0, np.float32)
    heights[:, :10] = 0.0
    light = unit_light((-1.0, 0.0, 0.5))
    share = lit(heights, 0.1, light)[4]
    # 1 mm deep under a light of 1 : 2 is 2 mm, 20 pixels, of shadow.
    edge = 10 + np.flatnonzero(share[10:60] > 0.5)[0]
    assert abs(edge - 30) <= 1
    assert (share[11:24] == 0).all()
    assert (share[36:60] == 1).all()
    assert (share[:10] == 1).all()


def test_light_from_the_other_side_moves_the_shadow():
    pit = relief_of(lambda x, y: np.where((abs(x - 3.2) < 1.5) & (abs(y - 2.4) < 1.5), -1.5, 0))
    left = hillshade(pit, (-1.0, 0.0, 0.7)).astype(int)
    right = hillshade(pit, (1.0, 0.0, 0.7)).astype(int)
    assert left[24, 22, 0] + 30 < left[24, 42, 0]
    assert right[24, 42, 0] + 30 < right[24, 22, 0]


def test_sky_is_whole_on_the_face_and_less_in_a_pit():
    heights = np.zeros((41, 41), np.float32)
    heights[10:31, 10:31] = -3.0
    share = sky(heights, 0.1)
    assert share[2, 2] == 1
    # Walls 1 mm away and 3 mm high: cos² of the horizon is 1/10 the short way.
    assert 0.08 < share[20, 20] < 0.2


def test_light_overhead_casts_no_shadow():
    heights = np.array([[0.0, -3.0, 0.0]], np.float32)
    assert (lit(heights, 0.1, unit_light((0, 0, 1))) == 1).all()


@pytest.mark.parametrize("light", [(0, 0, 0), (1, 0, 0), (0, 0, -1), (1, 1), (np.nan, 0, 1)])
def test_light_below_the_panel_is_refused(light):
    with pytest.raises(InputError, match="above the panel"):
        unit_light(light)


def test_relief_is_left_as_it_was():
    relief = relief_of(lambda x, y: -0.1 * x + 0 * y)
    before = relief.heights.copy()
    hillshade(relief)
    np.testing.assert_array_equal(relief.heights, before)
