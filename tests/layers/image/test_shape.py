from dataclasses import replace

import numpy as np
import pytest

from relieffab.layers.image.picture import Picture
from relieffab.layers.image.shape import brightness, shape_of
from relieffab.layers.shading import lambert
from relieffab.relief.make import make_relief
from relieffab.relief.quality.order import order
from relieffab.relief.quality.pair import Pair
from relieffab.relief.targets import Carving


def test_brightness_is_linear():
    steps = np.array([[0.0, 0.5, 1.0]])[..., None]
    for bits in (8, 16):
        stored = brightness(Picture(steps, None, bits, "PNG", "a"))
        np.testing.assert_allclose(stored, [[0.0, 0.2140, 1.0]], atol=1e-3)
    np.testing.assert_allclose(brightness(Picture(steps, None, None, "EXR", "a")), steps[..., 0])


@pytest.mark.parametrize("way", [(-1.0, 1.0, 1.0), (0.6, 0.5, 1.2)])
def test_the_depth_order_comes_out_of_one_photograph(layers, way):
    unit = np.array(way) / np.linalg.norm(way)
    grey = lambert(layers.normals, unit[None])[0] * layers.mask
    facts = {}
    depth, normals = shape_of(grey, layers.mask, layers.pitch, facts)
    assert np.degrees(np.arccos(np.clip(np.array(facts["light"]) @ unit, -1, 1))) < 15
    seen = replace(layers, depth=depth, normals=normals)
    relief, _ = make_relief(seen, Carving(depth=2.0))
    assert order(Pair(relief, layers)).local >= 0.8


@pytest.mark.parametrize("way", [(-1.0, 1.0, 1.0), (0.0, 0.0, 1.0)])
@pytest.mark.parametrize("grain", [0.0, 0.06])
def test_a_ball_comes_out_round(way, grain):
    row, col = np.indices((150, 150)) - 74.5
    mask = row**2 + col**2 < 60**2
    z = np.sqrt(np.maximum(60.0**2 - row**2 - col**2, 0.0))
    normals = np.stack([col, -row, z], axis=2) / np.sqrt(row**2 + col**2 + z**2)[..., None]
    noise = np.random.default_rng(0).normal(1.0, grain, mask.shape)
    unit = np.array(way) / np.linalg.norm(way)
    grey = (0.05 + 0.9 * lambert(normals, unit[None])[0]) * mask * noise
    _, found = shape_of(grey, mask, 0.5, {})
    inner = row**2 + col**2 < 54**2
    off = np.degrees(np.arccos(np.clip((found * normals).sum(axis=2), -1.0, 1.0)))[inner]
    assert np.median(off) < 12.0
    assert np.percentile(off, 90) < 25.0


def test_what_shows_no_shading_stays_within_its_outline():
    mask = np.ones((9, 13), bool)
    depth, normals = shape_of(0.4 * mask, mask, 0.5, {})
    assert np.isfinite(depth).all()
    assert np.ptp(depth) < 0.5 * 9
    np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1.0)
