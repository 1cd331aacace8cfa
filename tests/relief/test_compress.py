import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.layers.occlusion import beside, occlusions, slopes
from relieffab.relief.compress import compress, form, without_specks


def test_compression_keeps_direction_and_order():
    rng = np.random.default_rng(0)
    v = rng.normal(size=(2, 9, 11)) * 3
    g = compress(v)
    size, small = np.hypot(*v), np.hypot(*g)
    np.testing.assert_allclose(v[0] * g[1], v[1] * g[0], atol=1e-12)
    assert (np.diff(small.ravel()[size.ravel().argsort()]) > 0).all()
    np.testing.assert_allclose(small, np.sin(np.arctan(size)))


def test_gentle_slopes_are_kept():
    np.testing.assert_allclose(compress(np.full((2, 1, 1), 1e-3)), 1e-3, rtol=1e-5)
    assert (compress(np.zeros((2, 4, 4))) == 0).all()


def test_a_tear_counts_if_it_is_long_or_drawn(plane_layers):
    layers = plane_layers(0.0, 0.0)
    depth, lines = np.zeros(layers.grid.shape), np.zeros(layers.grid.shape)
    depth[2:12, 4:8] = 3.0
    depth[15, 15] = 3.0
    depth[15, 22] = 3.0
    lines[15, 23] = 0.5
    fine = Grid(20, 30, 0.25, (0.0, 5.0))
    torn = Layers(**{**vars(layers), "grid": fine, "depth": depth, "lines": lines})
    every = beside(*occlusions(torn, slopes(torn)))
    kept = without_specks(torn, every)
    assert every[15, 15]
    assert not kept[13:18, 13:18].any()
    np.testing.assert_array_equal(kept[:, 20:], every[:, 20:])
    np.testing.assert_array_equal(kept[:13], every[:13])
    assert kept[15, 22]
    assert not without_specks(layers, np.zeros(layers.grid.shape, bool)).any()


def test_form_keeps_the_depth_order_and_its_room(plane_layers):
    rng = np.random.default_rng(2)
    layers = plane_layers(0.1, 0.2)
    depth = rng.gamma(1.0, 5.0, layers.grid.shape)
    uneven = Layers(**{**vars(layers), "depth": depth})
    f = form(uneven, (-4.0, -1.0))
    order = depth.ravel().argsort()
    assert (np.diff(f.ravel()[order]) >= 0).all()
    assert f.min() == pytest.approx(-4)
    assert f.max() == pytest.approx(-1)
