"""Normal maps: from colours to unit normals, whichever way their Y goes."""

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.steps import normals_of

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

UP, DOWN = "y-up", "y-down"
"""OpenGL's way, in which green is what faces up; and DirectX's."""
DECIDED = 1.15
"""Ratio of the two ways' curls from which data decide."""
STEEPEST = 12.0
"""Slopes beyond take no part in telling the way."""


def vectors_of(picture: Picture) -> Floats:
    """Turn colours into vectors, (rows, cols, 3): 2 c - 1, or as they are stored in float.

    Raises
    ------
    InputError
        If the picture has no three channels.
    """
    if picture.values.shape[2] != 3:
        raise InputError(
            "a normal map has three channels",
            expected="X, Y and Z as red, green and blue",
            found="one channel of grey",
            where=picture.name,
        )
    values = picture.values
    stored = picture.bits is None and float(np.nanmin(values)) < -0.01
    return values if stored else 2.0 * values - 1.0


def slopes_in(vectors: Floats, mask: Bools) -> Floats:
    """Slopes of the surface whose normals these are, (2, rows, cols); as steep as they are."""
    z = np.maximum(vectors[..., 2], 0.02)
    return np.stack([-vectors[..., 0] / z, -vectors[..., 1] / z]) * mask


def curl(slopes: Floats, mask: Bools) -> float:
    """Say how far slopes are from being a surface's: the median of |dp/dy - dq/dx| a pixel."""
    p, q = slopes
    whole = mask[1:, 1:] & mask[:-1, 1:] & mask[1:, :-1] & mask[:-1, :-1]
    gentle = np.hypot(p, q) < STEEPEST
    whole &= gentle[1:, 1:] & gentle[:-1, 1:] & gentle[1:, :-1] & gentle[:-1, :-1]
    up = 0.5 * (p[:-1, 1:] + p[:-1, :-1] - p[1:, 1:] - p[1:, :-1])
    right = 0.5 * (q[:-1, 1:] + q[1:, 1:] - q[:-1, :-1] - q[1:, :-1])
    return float(np.abs(up - right)[whole].mean()) if whole.any() else 0.0


def convention(vectors: Floats, mask: Bools) -> tuple[str, str]:
    """Tell which way Y goes: of the two surfaces, the one that closes.

    A surface's slopes have no curl; with Y the wrong way round their curl is twice
    the twist.

    Returns
    -------
    way : str
        `UP` or `DOWN`.
    by : str
        'data', or 'custom' where the surface has no twist to tell it by.
    """
    slopes = slopes_in(vectors, mask)
    up, down = curl(slopes, mask), curl(slopes * np.array([1.0, -1.0])[:, None, None], mask)
    if max(up, down) < DECIDED * min(up, down) + 1e-9:
        return UP, "custom"
    return (UP if up < down else DOWN), "data"


def unit_normals(vectors: Floats, mask: Bools, way: str) -> Floats:
    """Return unit normals with Y away from the operator, none hidden from the viewer."""
    turned = vectors * np.array([1.0, -1.0 if way == DOWN else 1.0, 1.0])
    return normals_of(slopes_in(np.nan_to_num(turned), mask), mask)
