"""Grounds whose marks can be foretold: level, round, and a cylinder lying."""

from dataclasses import dataclass

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.model import Layers
from relieffab.relief.model import Relief

SIZE = 24.0, 18.0
DEPTH = 3.0  # mm, of the reliefs with their marks
LIGHTS = np.array([[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0]]) / np.sqrt(3)


@dataclass(frozen=True)
class Ground:
    """A smooth relief and the layers it would be made from."""

    layers: Layers
    smooth: Relief


def ground_of(normals, mask, heights, grid, lines=None):
    shading = np.maximum(np.einsum("ijk,lk->lij", normals, LIGHTS), 0.0)
    lines = np.zeros(grid.shape) if lines is None else lines
    layers = Layers(grid, np.zeros(grid.shape), normals, mask, LIGHTS, shading * mask, lines)
    return Ground(layers, Relief(grid, heights, mask, DEPTH))


def pixel_centres(grid):
    x, y = grid.to_xy(*np.meshgrid(np.arange(grid.rows) + 0.5, np.arange(grid.cols) + 0.5,
                                   indexing="ij"))  # fmt: skip
    return x, y


def level_ground(lines=None, pitch=0.1):
    """All level, 1 mm below the face, but for a margin of 2 mm."""
    grid = Grid.on_panel(SIZE, (round(SIZE[0] / pitch), round(SIZE[1] / pitch)))
    mask = np.zeros(grid.shape, bool)
    edge = round(2 / pitch)
    mask[edge:-edge, edge:-edge] = True
    heights = np.zeros(grid.node_shape)
    heights[edge + 1 : -edge, edge + 1 : -edge] = -1.0
    normals = np.zeros((*grid.shape, 3))
    normals[..., 2] = 1.0
    return ground_of(normals, mask, heights, grid, lines)


def bent_ground(across, radius):
    """A ball, or a cylinder whose axis is square to `across`, seen from above; a low relief."""
    grid = Grid.on_panel(SIZE, (240, 180))
    x, y = pixel_centres(grid)
    x, y = x - SIZE[0] / 2, y - SIZE[1] / 2
    u, v = (x, y) if across is None else (x * across[0] + y * across[1], np.zeros_like(x))
    inside = np.hypot(x, y) < 8.0
    up = np.sqrt(np.maximum(radius**2 - u**2 - v**2, 1e-9))
    bend = np.stack([u, v], axis=-1) if across is None else u[..., None] * np.array(across)
    normals = np.concatenate([bend, up[..., None]], axis=-1) / radius
    xn, yn = np.meshgrid(*grid.node_axes())
    xn, yn = xn - SIZE[0] / 2, yn - SIZE[1] / 2
    w = np.hypot(xn, yn) if across is None else xn * across[0] + yn * across[1]
    dome = np.sqrt(np.maximum(radius**2 - w**2, 0.0)) - radius
    heights = np.where(np.hypot(xn, yn) < 7.9, 0.5 * dome - 0.2, 0.0)
    return ground_of(normals, inside, heights, grid)


@pytest.fixture(scope="session")
def level():
    return level_ground()


@pytest.fixture(scope="session")
def lined():
    """A level ground with a line drawn across it."""
    lines = np.zeros((180, 240))
    lines[87:93, 25:215] = 1.0
    return level_ground(lines)


@pytest.fixture(scope="session")
def ball():
    return bent_ground(None, 10.0)


@pytest.fixture(scope="session")
def cylinder():
    turn = np.radians(20.0)
    return bent_ground((np.cos(turn), np.sin(turn)), 10.0)
