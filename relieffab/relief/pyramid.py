"""Layers at half the resolution, and heights carried back to twice as many nodes."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.grid import Grid
from relieffab.layers.model import Layers

Floats = NDArray[np.float64]


def halve(layers: Layers) -> Layers:
    """Layers at twice the pitch: of each four pixels the nearest stays."""
    rows, cols = -(-layers.grid.rows // 2), -(-layers.grid.cols // 2)

    def blocks(array: NDArray[Any]) -> NDArray[Any]:
        pad = [(0, 2 * rows - array.shape[0]), (0, 2 * cols - array.shape[1])]
        padded = np.pad(array, pad + [(0, 0)] * (array.ndim - 2))
        split = padded.reshape(rows, 2, cols, 2, *array.shape[2:])
        return split.swapaxes(1, 2).reshape(rows, cols, 4, *array.shape[2:])

    near = np.where(layers.mask, layers.depth, -np.inf)
    nearest = blocks(near).argmax(axis=2)

    def pick(array: NDArray[Any]) -> NDArray[Any]:
        index = nearest.reshape(rows, cols, 1, *[1] * (array.ndim - 2))
        return np.take_along_axis(blocks(array), index, axis=2)[:, :, 0]

    normals = pick(layers.normals)
    normals[~pick(layers.mask)] = (0.0, 0.0, 1.0)
    return Layers(
        grid=Grid(rows, cols, 2 * layers.pitch, layers.grid.origin),
        depth=pick(layers.depth),
        normals=normals,
        mask=pick(layers.mask),
        lights=layers.lights.copy(),
        shading=np.stack([pick(image) for image in layers.shading]),
        lines=blocks(layers.lines).mean(axis=2),
    )


def refine(coarse: Floats, figure: NDArray[np.bool_], shape: tuple[int, int]) -> Floats:
    """Carry heights to a lattice of half the pitch; nodes of one lie on the other's.

    Cubic, since the energy takes a kink for a cliff; what lies outside the figure
    takes no part.

    Parameters
    ----------
    coarse : (n, m) ndarray
    figure : (n, m) ndarray of bool
        Nodes whose heights count.
    shape : tuple of int
        Of the fine lattice, at most (2 n - 1, 2 m - 1).

    Returns
    -------
    ndarray
        Continued smoothly beyond the figure.
    """
    nearest = ndimage.distance_transform_edt(~figure, return_distances=False, return_indices=True)
    heights = coarse[tuple(nearest)]
    for axis in (0, 1):
        heights = np.swapaxes(_halfway(np.swapaxes(heights, 0, axis)), 0, axis)
    return heights[: shape[0], : shape[1]]


def _halfway(rows: Floats) -> Floats:
    """Put a row between each two: the cubic through the nearest four."""
    padded = np.pad(rows, ((1, 1), (0, 0)), mode="edge")
    between = (9 * (padded[1:-2] + padded[2:-1]) - padded[:-3] - padded[3:]) / 16
    out = np.empty((2 * len(rows) - 1, rows.shape[1]))
    out[::2], out[1::2] = rows, between
    return out
