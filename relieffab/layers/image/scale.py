"""How a depth map is meant: which end of its values is near, and how deep it is in mm."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.layers.image.figure import BACKGROUND, border
from relieffab.layers.image.picture import Picture

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

USUAL = 0.5
"""Depth of a figure against the shorter side of its picture, where nobody says: as of a body
as thick as it is wide, of which half is seen."""
TELLING = 0.1
"""Correlation of greys with the way in from the edge from which it tells what is near."""


def white_is_far(picture: Picture, mask: Bools, source: str) -> tuple[bool, str]:
    """Tell which end of a depth map is near.

    What is beyond the figure is far: an even background says so outright.  Without
    one, figures are nearer in their middle than at their edge.

    Parameters
    ----------
    picture : Picture
    mask : (rows, cols) ndarray of bool
        Its figure.
    source : str
        What the mask came from.

    Returns
    -------
    far : bool
    by : str
        'background', 'form', or 'custom' where neither tells.
    """
    grey = picture.grey
    if source == BACKGROUND:
        beyond = float(np.median(border(grey)))
        return beyond > float(np.median(grey[mask])), "background"
    inward = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1][mask]
    near = np.corrcoef(np.sqrt(inward), grey[mask])[0, 1] if np.ptp(grey[mask]) > 0 else 0.0
    if abs(near) < TELLING:
        return False, "custom"
    return bool(near < 0), "form"


def to_length(grey: Floats, mask: Bools, scale: float, deep: float | None, name: str) -> Floats:
    """Turn greys, larger nearer, into depth.

    Parameters
    ----------
    grey : (rows, cols) ndarray
    mask : (rows, cols) ndarray of bool
    scale : float
        mm a pixel.
    deep : float or None
        From the farthest to the nearest point, mm; `USUAL` if not given.
    name : str
        Of the picture, for messages.

    Returns
    -------
    (rows, cols) ndarray
        mm, the nearest point at 0; 0 outside the figure.

    Raises
    ------
    InputError
        If the figure is level.
    """
    low, high = float(grey[mask].min()), float(grey[mask].max())
    if high <= low:
        raise InputError(
            "the depth map is level: every pixel of the figure is as near as any other",
            found=f"{int(mask.sum())} pixels of {low:g}",
            where=name,
        )
    if deep is None:
        sides = [np.ptp(np.flatnonzero(mask.any(axis=axis))) + 1 for axis in (0, 1)]
        deep = USUAL * scale * float(min(sides))
    return np.where(mask, (grey - high) / (high - low) * deep, 0.0)
