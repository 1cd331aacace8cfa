"""Slopes of what a view shows, and where one part of it stands in front of another."""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

STEEPEST = 8.0  # slopes of pixels seen edge on carry no more than this


def slopes(layers: Layers) -> Floats:
    """Slopes of the model at the pixels, from its normals.

    Normals know the slope on either side of an occlusion; differences of depth
    would take the jump between them for a cliff (Wang 2011, Eqs. 9-12).

    Returns
    -------
    (2, rows, cols) ndarray
        dD/dx and dD/dy, no steeper than `STEEPEST`; 0 outside the figure.
    """
    n = layers.normals
    flat = np.maximum(n[..., 2], 1e-6)
    p = np.stack([-n[..., 0] / flat, -n[..., 1] / flat])
    steep = np.hypot(p[0], p[1])
    p *= np.minimum(1.0, STEEPEST / np.maximum(steep, 1e-12))
    return p * layers.mask


def occlusions(layers: Layers, v: Floats) -> tuple[Bools, Bools]:
    """Find where one part of the figure stands in front of another.

    Two neighbouring pixels belong to one surface if the depth between them
    changes no more than their slopes explain, with as much again to spare.

    Parameters
    ----------
    layers : Layers
    v : (2, rows, cols) ndarray
        Slopes of the model.

    Returns
    -------
    across : (rows, cols - 1) ndarray of bool
        Jump between a pixel and its right neighbour, both in the figure.
    down : (rows - 1, cols) ndarray of bool
        Jump between a pixel and its near (lower) neighbour.
    """
    pitch = layers.pitch

    def jumps(a: tuple[slice, ...], b: tuple[slice, ...], slope: Floats) -> Bools:
        change = layers.depth[b] - layers.depth[a]
        expected = 0.5 * pitch * (slope[a] + slope[b])
        spare = pitch * (1.0 + np.maximum(np.abs(slope[a]), np.abs(slope[b])))
        inside: Bools = layers.mask[a] & layers.mask[b]
        return inside & (np.abs(change - expected) > spare)

    every = slice(None)
    across = jumps((every, slice(None, -1)), (every, slice(1, None)), v[0])
    down = jumps((slice(None, -1), every), (slice(1, None), every), -v[1])
    return across, down


def beside(across: Bools, down: Bools) -> Bools:
    """Pixels on either side of the jumps that `occlusions` finds, (rows, cols)."""
    torn = np.zeros((len(across), down.shape[1]), bool)
    torn[:, :-1] |= across
    torn[:, 1:] |= across
    torn[:-1] |= down
    torn[1:] |= down
    return torn
