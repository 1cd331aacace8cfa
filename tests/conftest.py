"""Small models and their layers, made by code."""

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.mesh import make_mesh
from relieffab.layers.model import Layers
from relieffab.layers.raster import rasterise
from relieffab.layers.shading import default_lights, lambert, pixel_normals
from relieffab.layers.view import View, place


def bumps():
    """A closed ellipsoid with a finer one on its front: form and detail."""
    import trimesh

    big = trimesh.creation.icosphere(subdivisions=4)
    v = big.vertices * [3.0, 2.0, 1.5]
    v = v * (1 + 0.06 * np.sin(4 * v[:, :1]) * np.sin(5 * v[:, 1:2]))
    return v, big.faces


@pytest.fixture(scope="session")
def model():
    """A bumpy ellipsoid, Z towards the viewer at the front of a y-up model."""
    return make_mesh(*bumps(), name="bumps", usual_up="y")


def layers_of_size(mesh, width):
    """Layers of a mesh on a 40 x 30 mm panel without lines."""
    grid = Grid.on_panel((40.0, 30.0), (width, 3 * width // 4))
    placed = place(mesh, View(up="y"), (40.0, 30.0), margin=3.0)
    raster = rasterise(placed.vertices, placed.faces, grid)
    normals = pixel_normals(raster, placed.vertices, placed.faces, grid)
    lights = default_lights()
    return Layers(
        grid=grid,
        depth=np.where(raster.mask, raster.depth, 0.0),
        normals=normals,
        mask=raster.mask,
        lights=lights,
        shading=lambert(normals, lights) * raster.mask,
        lines=np.zeros(grid.shape),
    )


@pytest.fixture(scope="session")
def layers(model):
    """Layers of the model at 160 x 120."""
    return layers_of_size(model, 160)


@pytest.fixture(scope="session")
def finer_layers(model):
    """Layers of the model at 320 x 240."""
    return layers_of_size(model, 320)


def plane_layers(p, q, step=0.0):
    """A tilted plane, its right half `step` mm higher."""
    grid = Grid(20, 30, 0.5, (0.0, 10.0))
    i, j = np.indices(grid.shape)
    x, y = grid.to_xy(i + 0.5, j + 0.5)
    normal = np.array([-p, -q, 1]) / np.sqrt(1 + p * p + q * q)
    return Layers(
        grid=grid,
        depth=p * x + q * y + step * (j >= 15),
        normals=np.broadcast_to(normal, (*grid.shape, 3)).copy(),
        mask=np.ones(grid.shape, bool),
        lights=default_lights(),
        shading=np.zeros((2, *grid.shape)),
        lines=np.zeros(grid.shape),
    )


@pytest.fixture(name="plane_layers")
def make_plane_layers():
    """Return the function that makes layers of a tilted plane."""
    return plane_layers
