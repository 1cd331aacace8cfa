"""Surfaces whose reliefs can be told beforehand."""

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.layers.shading import default_lights, lambert
from relieffab.relief.classic.linear import linear


def layers_from(depth, slope, mask, pitch=0.25):
    """Layers of a height field with known slopes, (2, rows, cols)."""
    normals = np.stack([-slope[0], -slope[1], np.ones(mask.shape)], axis=2)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    normals[~mask] = (0.0, 0.0, 1.0)
    lights = default_lights()
    return Layers(
        grid=Grid(*mask.shape, pitch, (0.0, mask.shape[0] * pitch)),
        depth=np.where(mask, depth, 0.0),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=np.zeros(mask.shape),
    )


def centres(rows, cols, pitch=0.25):
    """X and Y of pixels, mm from the grid's centre."""
    x = (np.arange(cols) + 0.5 - cols / 2) * pitch
    y = -(np.arange(rows) + 0.5 - rows / 2) * pitch
    return np.meshgrid(x, y)


@pytest.fixture
def slanted():
    """A plane that rises to the right and a little away."""
    x, y = centres(60, 80)
    mask = (abs(x) < 8) & (abs(y) < 5)
    return layers_from(0.4 * x + 0.1 * y, [0.4 + 0 * x, 0.1 + 0 * x], mask)


@pytest.fixture
def stepped():
    """Two domed halves, the right one far in front of the left."""
    x, y = centres(80, 100)
    mask = (abs(x) < 10) & (abs(y) < 8)
    u = np.abs(x) - 5.0
    depth = -0.02 * u**2 - 0.02 * y**2 + np.where(x > 0, 6.0, 0.0)
    return layers_from(depth, [-0.04 * u * np.sign(x), -0.04 * y], mask)


@pytest.fixture
def flat():
    """A level plate."""
    x, y = centres(40, 50)
    return layers_from(3.0 + 0 * x, [0 * x, 0 * x], (abs(x) < 4) & (abs(y) < 3))


@pytest.fixture
def bordering():
    """A dome over the whole grid, cut off by its border."""
    x, y = centres(40, 50)
    slope = [-0.1 * x, -0.1 * y]
    return layers_from(-0.05 * (x**2 + y**2), slope, np.ones(x.shape, bool))


@pytest.fixture(params=[(1, 1), (1, 2), (2, 2), (3, 1)])
def tiny(request):
    """A slanted figure of a few pixels."""
    x, y = centres(9, 9)
    mask = np.zeros(x.shape, bool)
    mask[4 : 4 + request.param[0], 4 : 4 + request.param[1]] = True
    return layers_from(x + y, [1 + 0 * x, 1 + 0 * x], mask)


@pytest.fixture
def rippled():
    """A wide dome with ripples of 1.5 mm on it."""
    x, y = centres(90, 110)
    mask = x**2 + y**2 < 100
    wave = 2 * np.pi / 1.5
    depth = -0.06 * (x**2 + y**2) + 0.02 * np.sin(wave * x)
    slope = [-0.12 * x + 0.02 * wave * np.cos(wave * x), -0.12 * y]
    return layers_from(depth, slope, mask)


@pytest.fixture
def band():
    """Measure how much more of the ripples a method leaves than linear compression."""

    def ripples(h):
        return np.abs(np.fft.fft(np.diff(h[30:61, 31:79], axis=1), axis=1)[:, 8]).mean()

    return lambda layers, method: ripples(method(layers, 1.0)) / ripples(linear(layers, 1.0))
