"""Slopes of a depth map that do not bridge its jumps."""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.shading import GRAZING

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

CALM = 0.25
"""How unlike the slopes on both sides of a pixel may be before one of them is a jump's."""


def _along(depth: Floats, mask: Bools, pitch: float) -> Floats:
    """Slope along the columns, (rows, cols): the mean of both sides, or the calmer of them.

    Of two sides that differ, the one is taken that goes on more evenly to the pixel
    beyond (Harten and Osher 1987, essentially non-oscillatory).
    """
    wide = np.pad(depth, ((0, 0), (3, 3)))
    known = np.pad(mask, ((0, 0), (3, 3)))
    step = np.diff(wide, axis=1) / pitch
    both = known[:, 1:] & known[:, :-1]
    bend = np.abs(np.diff(step, axis=1))
    sound = both[:, 1:] & both[:, :-1]
    # Between pixels j and j + 1 lies step j; bend j sits on pixel j + 1.
    bend = np.where(sound, bend, np.inf)
    n = depth.shape[1]
    left, right = step[:, 2 : 2 + n], step[:, 3 : 3 + n]
    has_left, has_right = both[:, 2 : 2 + n], both[:, 3 : 3 + n]
    before, after = bend[:, 1 : 1 + n], bend[:, 3 : 3 + n]
    spare = CALM * (1.0 + np.minimum(np.abs(left), np.abs(right)))
    one_surface = np.abs(left - right) <= spare
    mean = 0.5 * (left + right)
    calmer = np.where(before < after, left, np.where(after < before, right, mean))
    # With nothing beyond to tell by, the flatter side is the surface's.
    blind = ~np.isfinite(before) & ~np.isfinite(after)
    calmer = np.where(blind, np.where(np.abs(left) < np.abs(right), left, right), calmer)
    inner = np.where(one_surface, mean, calmer)
    alone = np.where(has_left, left, np.where(has_right, right, 0.0))
    return np.where(has_left & has_right, inner, alone)


def slopes_of(depth: Floats, mask: Bools, pitch: float) -> Floats:
    """Find the slopes of a depth map at its pixels.

    Parameters
    ----------
    depth : (rows, cols) ndarray
        mm, larger is nearer.
    mask : (rows, cols) ndarray of bool
        The figure.
    pitch : float
        mm.

    Returns
    -------
    (2, rows, cols) ndarray
        dD/dx and dD/dy; 0 outside the figure.
    """
    p = _along(depth, mask, pitch)
    q = -_along(depth.T, mask.T, pitch).T
    return np.stack([p, q]) * mask


def normals_of(slopes: Floats, mask: Bools) -> Floats:
    """Turn slopes into unit normals, (rows, cols, 3); (0, 0, 1) outside the figure.

    None is steeper than a mesh's: at least `GRAZING` of it faces the viewer.
    """
    steep = np.maximum(np.hypot(*slopes), 1e-12)
    p, q = slopes * np.minimum(1.0, np.sqrt(1.0 - GRAZING**2) / GRAZING / steep) * mask
    length = np.sqrt(1.0 + p * p + q * q)
    return np.stack([-p / length, -q / length, 1.0 / length], axis=-1)
