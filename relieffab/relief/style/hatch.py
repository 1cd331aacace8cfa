"""Hatching from the tone: lines as deep as the figure is dark."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.model import Layers
from relieffab.relief.model import to_nodes

Floats = NDArray[np.float64]

DARK, LIGHT = 5.0, 90.0  # percentiles of the tone, from full depth to none


def darkness(layers: Layers, smooth: float) -> Floats:
    """How dark the light layer is at nodes, from 0 in its lights to 1 in its shadows.

    Parameters
    ----------
    layers : Layers
    smooth : float
        mm over which the tone is evened out within the figure.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
    """
    tone, mask = layers.shading.mean(axis=0), layers.mask.astype(float)
    sigma = smooth / layers.pitch
    even = ndimage.gaussian_filter(tone * mask, sigma)
    even /= np.maximum(ndimage.gaussian_filter(mask, sigma), 1e-6)
    low, high = np.percentile(even[layers.mask], (DARK, LIGHT))
    if high - low < 1e-6:
        return np.ones(layers.grid.node_shape)
    return np.clip((high - to_nodes(even, mask)) / (high - low), 0.0, 1.0)
