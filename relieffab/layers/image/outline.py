"""How plainly a figure stands out from what is around it."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

REACH = 3
"""Pixels each way in which colours on either side of the outline are compared."""
ENOUGH = 800
"""Pixels each way that tell it: of larger pictures some are left out."""
FAINT = 0.25
"""Share of the picture's plain steps, its upper tenth, up to which one is faint."""


def faint_share(values: Floats, mask: Bools) -> float:
    """Say along how much of its outline a figure hardly differs from its background.

    Parameters
    ----------
    values : (rows, cols, channels) ndarray
    mask : (rows, cols) ndarray of bool
        The figure.

    Returns
    -------
    float
        0 to 1; what lies at the picture's own edge does not count.
    """
    every = max(1, max(mask.shape) // ENOUGH)
    values, mask = values[::every, ::every], mask[::every, ::every]
    ring = ndimage.binary_dilation(mask) & ~mask
    ring[[0, -1]] = ring[:, [0, -1]] = False
    if not ring.any():
        return 0.0
    known = np.nan_to_num(values)
    inside, outside = (_around(known, side, ring) for side in (mask, ~mask))
    step = np.linalg.norm(inside - outside, axis=1)
    return float((step < FAINT * np.percentile(step, 90)).mean())


def _around(values: Floats, side: Bools, places: Bools) -> Floats:
    """Mean colours of one side about places, (n, channels)."""
    width = 2 * REACH + 1
    mass = ndimage.uniform_filter(side.astype(float), width)[places]
    total = [
        ndimage.uniform_filter(np.where(side, channel, 0.0), width)[places]
        for channel in np.moveaxis(values, 2, 0)
    ]
    return np.asarray(np.stack(total, axis=1) / np.maximum(mass, 1e-9)[:, None])
