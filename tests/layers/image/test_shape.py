from dataclasses import replace

import numpy as np
import pytest

from relieffab.layers.image.picture import Picture
from relieffab.layers.image.shape import brightness, on_cone, shape_of
from relieffab.layers.shading import lambert
from relieffab.relief.make import make_relief
from relieffab.relief.quality.order import order
from relieffab.relief.quality.pair import Pair
from relieffab.relief.targets import Carving


def test_normals_go_the_shortest_way_onto_their_cone():
    rng = np.random.default_rng(0)
    normals = rng.normal(size=(20, 20, 3))
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    way = np.array([0.6, 0.0, 0.8])
    cosine = rng.uniform(0.1, 1.0, (20, 20))
    turned = on_cone(normals, cosine, way)
    np.testing.assert_allclose(np.linalg.norm(turned, axis=2), 1.0)
    np.testing.assert_allclose(turned @ way, cosine)
    # In one plane with the light: the shortest way there is.
    volume = np.einsum(
        "ijn,ijn->ij", np.cross(normals, turned), np.broadcast_to(way, normals.shape)
    )
    np.testing.assert_allclose(volume, 0.0, atol=1e-12)
    shadowed = on_cone(normals, np.zeros((20, 20)), way)
    away = normals @ way <= 0
    np.testing.assert_array_equal(shadowed[away], normals[away])


def test_brightness_is_linear():
    steps = np.array([[0.0, 0.5, 1.0]])[..., None]
    eight = brightness(Picture(steps, None, 8, "PNG", "a"))
    np.testing.assert_allclose(eight, [[0.0, 0.2140, 1.0]], atol=1e-3)
    np.testing.assert_allclose(brightness(Picture(steps, None, 16, "PNG", "a")), steps[..., 0])


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
