"""Models whose depth is a formula, and reliefs made from them."""

from types import SimpleNamespace

import numpy as np
import pytest

from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.layers.model import Layers, Stroke
from relieffab.layers.shading import default_lights, lambert
from relieffab.relief.model import Relief, pixel_slopes
from relieffab.relief.quality.pair import Pair, normals_of

ROWS, COLS, PITCH = 120, 160, 0.25
GRID = Grid(ROWS, COLS, PITCH, (0.0, ROWS * PITCH))


def node_axes():
    x, y = GRID.node_axes()
    return np.meshgrid(x - x.mean(), y - y.mean())


def layers_of(depth, *, mask=None, lines=None, strokes=()):
    """Layers whose depth at nodes is known; pixels see its mean and its slopes."""
    mask = np.ones(GRID.shape, bool) if mask is None else mask
    normals = normals_of(pixel_slopes(depth, PITCH))
    normals[~mask] = (0.0, 0.0, 1.0)
    pixels = (depth[:-1, :-1] + depth[:-1, 1:] + depth[1:, :-1] + depth[1:, 1:]) / 4
    lights = default_lights()
    return Layers(
        grid=GRID,
        depth=np.where(mask, pixels, 0.0),
        normals=normals,
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=np.zeros(GRID.shape) if lines is None else lines,
        strokes=strokes,
    )


def relief_of(heights, *, mask=None):
    """A relief of some heights, pushed down until nothing stands above the face."""
    mask = np.ones(GRID.shape, bool) if mask is None else mask
    sunken = heights - heights.max()
    return Relief(GRID, sunken, mask, max(1.0, float(-sunken.min())))


def pair_of(depth, heights, **more):
    """A relief of some heights beside a model of known depth."""
    return Pair(relief_of(heights, mask=more.get("mask")), layers_of(depth, **more))


def line(strength=1.0):
    """A drawn line straight down the middle, 20 mm long: its stroke."""
    x = COLS * PITCH / 2
    return Stroke(np.array([[x, 5.0], [x, 25.0]]), "suggestive", np.full(2, strength))


@pytest.fixture(scope="session")
def bench():
    """The tools above and the grid's axes at nodes, mm from its centre."""
    x, y = node_axes()
    return SimpleNamespace(
        grid=GRID,
        pitch=PITCH,
        x=x,
        y=y,
        layers_of=layers_of,
        relief_of=relief_of,
        pair_of=pair_of,
        line=line,
    )


@pytest.fixture
def waves():
    """Depth at nodes with form and detail, without a steep place, mm."""
    x, y = node_axes()
    form = 3 * np.cos(x / 9) * np.cos(y / 8)
    return form + 0.3 * np.sin(x * 1.7) * np.sin(y * 1.3) + 0.05 * np.cos(5 * x) * np.cos(4 * y)


@pytest.fixture
def square():
    """A figure that leaves a border of ten pixels free."""
    mask = np.zeros(GRID.shape, bool)
    mask[10:-10, 10:-10] = True
    return mask


@pytest.fixture
def finest():
    """A ball of 0.5 mm."""
    return Cutter("fine", "ball", 0.5, 5.0, 0.5, 500.0, 200.0, 10000.0)
