"""A stone whose depth and normals are known, and the pictures taken of it."""

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.image.picture import Picture
from relieffab.layers.make import layers_of
from relieffab.layers.mesh import make_mesh
from relieffab.layers.model import Layers
from relieffab.layers.shading import default_lights, lambert
from relieffab.layers.view import View, place
from relieffab.subject.shapes import star

SIZE, MARGIN = (40.0, 30.0), 3.0


def ripples(unit):
    return 1.0 + 0.07 * np.sin(5 * unit[:, 0]) * np.cos(6 * unit[:, 1])


@pytest.fixture(scope="session")
def stone():
    """Layers of a smooth rippled stone, lines and all, at 320 x 240."""
    vertices, faces = star(ripples, 40_000)
    mesh = make_mesh(vertices * [1.5, 1.0, 0.8], faces, usual_up="y")
    placed = place(mesh, View(up="y"), SIZE, margin=MARGIN)
    return layers_of(placed, Grid.on_panel(SIZE, (320, 240)))


def stored(values, bits):
    """Round to what so many bits hold; exact for None."""
    top = 2**bits - 1 if bits else None
    return np.rint(values * top) / top if top else values


def picture(values, *, bits=8, alpha=None, name="picture"):
    """Make a picture of an array."""
    values = np.asarray(values, float)
    return Picture(values if values.ndim == 3 else values[..., None], alpha, bits, "PNG", name)


@pytest.fixture(scope="session")
def ball():
    """Layers of a ball of radius 8 that stands 12 mm before a slope, by its formula."""
    grid = Grid.on_panel(SIZE, (160, 120))
    rows, cols = np.indices(grid.shape) + 0.5
    x, y = grid.to_xy(rows, cols)
    x, y = x - 20.0, y - 14.0
    up = np.sqrt(np.maximum(64.0 - x * x - y * y, 0.0))
    before = up > 0
    depth = np.where(before, up + 12.0, 0.3 * x + 0.2 * y)
    slope = np.array([-0.3, -0.2, 1.0]) / np.sqrt(1.13)
    normals = np.where(before[..., None], np.stack([x, y, up], axis=-1) / 8.0, slope)
    mask = np.hypot(x / 17.0, (y - 1.0) / 12.5) < 1
    lights = default_lights()
    return Layers(
        grid=grid,
        depth=np.where(mask, depth - depth[mask].max(), 0.0),
        normals=np.where(mask[..., None], normals, [0.0, 0.0, 1.0]),
        mask=mask,
        lights=lights,
        shading=lambert(normals, lights) * mask,
        lines=np.zeros(grid.shape),
    )


@pytest.fixture
def make_picture():
    return picture


@pytest.fixture
def depth_map():
    """Return a function: layers to their depth map and how deep it is, mm."""

    def made(layers, bits, *, white_far=False):
        seen = layers.depth[layers.mask]
        near = (layers.depth - seen.min()) / np.ptp(seen) * 0.95 + 0.05
        grey = stored(np.where(layers.mask, near, 0.0), bits)
        return picture(1.0 - grey if white_far else grey, bits=bits), float(np.ptp(seen))

    return made


@pytest.fixture
def normal_map():
    """Return a function: layers to their normal map."""

    def made(layers, bits, *, down=False):
        turned = layers.normals * [1.0, -1.0 if down else 1.0, 1.0]
        colours = np.where(layers.mask[..., None], (turned + 1.0) / 2.0, [0.5, 0.5, 1.0])
        return picture(stored(colours, bits), bits=bits)

    return made
