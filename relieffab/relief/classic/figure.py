"""What the classic methods share: the figure's size, smoothing inside it, the full depth."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.model import Layers
from relieffab.layers.occlusion import beside, occlusions, slopes
from relieffab.relief.window import figure_size

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

EVEN = 1e-9  # range, mm or relative, below which heights count as all the same
TAILS = 0.5  # percent of the heights at either end that may be cut off


def extent(layers: Layers) -> float:
    """Return the figure's width or height, whichever is larger, mm.

    The methods measure their lengths by it, so that they do the same at any
    resolution.
    """
    return max(figure_size(layers))


def smooth(field: Floats, sound: Bools, sigma: float) -> Floats:
    """Gaussian mean of the sound pixels alone: what lies beyond takes no part.

    Parameters
    ----------
    field : (..., rows, cols) ndarray
    sound : (rows, cols) ndarray of bool
    sigma : float
        Pixels.

    Returns
    -------
    (..., rows, cols) ndarray
        0 far from any sound pixel.
    """
    mass = ndimage.gaussian_filter(sound.astype(float), sigma, mode="constant")
    total = ndimage.gaussian_filter(field * sound, sigma, mode="constant", axes=(-2, -1))
    return np.divide(total, mass, out=np.zeros_like(total), where=mass > 1e-9)


def model_slopes(layers: Layers) -> tuple[Floats, Bools]:
    """Slopes of the model, and the pixels that no occlusion touches.

    Returns
    -------
    slopes : (2, rows, cols) ndarray
    whole : (rows, cols) ndarray of bool
        Pixels of the figure whose neighbours all belong to the same surface.
    """
    slope = slopes(layers)
    return slope, layers.mask & ~beside(*occlusions(layers, slope))


def stretch(heights: Floats, figure: Bools, depth: float, *, tails: float = 0.0) -> Floats:
    """Rescale heights linearly to the whole depth.

    Parameters
    ----------
    heights : (n, m) ndarray
        Any unit.
    figure : (n, m) ndarray of bool
        Nodes that count.
    depth : float
        mm.
    tails : float
        Percent of the heights at either end that do not count and are cut off.

    Returns
    -------
    (n, m) ndarray
        From -depth to 0, both reached; 0 outside the figure, and all over where
        the heights are all the same.
    """
    low, high = np.percentile(heights[figure], (tails, 100.0 - tails))
    if high - low <= EVEN * max(abs(low), abs(high), 1.0):
        return np.zeros_like(heights)
    level = np.clip((heights - high) / (high - low), -1.0, 0.0)
    return np.where(figure, depth * level, 0.0)
