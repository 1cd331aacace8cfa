import numpy as np
import pytest

from relieffab.layers.model import Layers
from relieffab.relief.classic.linear import linear
from relieffab.relief.classic.wang import wang
from relieffab.relief.model import nodes_of, pixel_slopes


def radiance(h, layers):
    p, q = pixel_slopes(h, layers.pitch)
    normals = np.stack([-p, -q, np.ones_like(p)]) / np.sqrt(1 + p * p + q * q)
    return np.einsum("kn,nij->kij", layers.lights, normals)


def unlike(h, layers, wanted):
    """Mean square of what the gradients of radiance miss, away from the figure's edge."""
    error = radiance(h, layers) - wanted
    x, y = np.diff(error, axis=2)[:, :-1], np.diff(error, axis=1)[:, :, :-1]
    inner = (slice(None), slice(35, 85), slice(55, 105))
    return float((x**2 + y**2)[inner].mean())


def test_bounds_are_kept_and_the_ground_is_level(layers):
    h = wang(layers, 1.5)
    assert -1.5 <= h.min() < -0.7
    assert h.max() <= 0
    assert not h[~nodes_of(layers.mask)].any()


def test_its_shading_is_nearer_the_models_than_linear_compressions(layers):
    assert unlike(wang(layers, 1.5), layers, layers.shading) < 0.7 * unlike(
        linear(layers, 1.5), layers, layers.shading
    )


def test_lines_leave_their_mark(layers):
    lines = np.zeros(layers.grid.shape)
    lines[:, 79:81] = 1.0
    drawn = Layers(**{**vars(layers), "lines": lines})
    change = np.abs(wang(drawn, 1.5) - wang(layers, 1.5))[40:80]
    assert change[:, 78:83].max(axis=1).min() > 3 * change[:, 50:60].max()


def test_a_level_plate_stays_level(layers):
    level = np.where(layers.mask, 1.0, 0.0)
    up = np.zeros_like(layers.normals)
    up[..., 2] = 1.0
    shading = np.broadcast_to(layers.lights[:, 2, None, None], layers.shading.shape).copy()
    flat = Layers(**{**vars(layers), "depth": level, "normals": up, "shading": shading})
    assert np.abs(wang(flat, 1.0)).max() == pytest.approx(0, abs=1e-6)
