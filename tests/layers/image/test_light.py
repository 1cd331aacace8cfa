import numpy as np
import pytest

from relieffab.layers.image.light import find_light
from relieffab.layers.shading import lambert

ROW, COL = np.indices((120, 120)) - 59.5
MASK = ROW**2 + COL**2 < 50**2
Z = np.sqrt(np.maximum(50.0**2 - ROW**2 - COL**2, 1.0))
BALL = (
    np.stack([COL, -ROW, Z], axis=2)
    / np.linalg.norm(np.stack([COL, -ROW, Z], axis=2), axis=2)[..., None]
)


@pytest.mark.parametrize("way", [(-1, 1, 1), (1, -0.3, 0.6), (0, 0, 1), (0.2, 0.9, 1.5)])
@pytest.mark.parametrize("ambient", [0.0, 0.15])
def test_a_ball_tells_its_light(way, ambient):
    unit = np.array(way) / np.linalg.norm(way)
    grey = (ambient + 0.7 * lambert(BALL, unit[None])[0]) * MASK
    light = find_light(grey, BALL, MASK)
    assert np.degrees(np.arccos(np.clip(light.way @ unit, -1, 1))) < 4
    assert light.fit > 0.95
    assert light.cosine(grey)[MASK].max() <= 1.0


def test_a_flat_figure_is_asked_at_its_rim():
    flat = np.zeros((120, 120, 3))
    flat[..., 2] = 1.0
    rim = MASK & (ROW**2 + COL**2 > 46**2)
    out = np.stack([COL, -ROW, np.full(ROW.shape, 30.0)], axis=2)
    flat[rim] = (out / np.linalg.norm(out, axis=2, keepdims=True))[rim]
    unit = np.array([-1.0, 1.0, 1.0]) / np.sqrt(3)
    grey = lambert(flat, unit[None])[0] * MASK
    light = find_light(grey, BALL, MASK)
    assert light.fit < 0.3
    assert np.degrees(np.arccos(light.way @ unit)) < 20


def test_a_dark_picture_tells_its_light_as_well():
    unit = np.array([-1.0, 1.0, 1.0]) / np.sqrt(3)
    grey = lambert(BALL, unit[None])[0] * MASK
    bright, dark = find_light(grey, BALL, MASK), find_light(0.01 * grey, BALL, MASK)
    np.testing.assert_allclose(dark.way, bright.way, atol=1e-9)
    assert dark.fit == pytest.approx(bright.fit)


def test_even_brightness_is_light_from_the_front():
    light = find_light(0.6 * MASK, BALL, MASK)
    np.testing.assert_allclose(light.way, [0, 0, 1])


def test_shadows_tell_the_even_light():
    unit = np.array([-1.0, 1.0, 0.6]) / np.sqrt(2.36)
    grey = (0.2 + 0.7 * lambert(BALL, unit[None])[0]) * MASK
    assert abs(find_light(grey, BALL, MASK).ambient - 0.2) < 1e-6
