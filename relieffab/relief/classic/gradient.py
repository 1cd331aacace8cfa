"""Compression in the gradient domain (Kerber, Belyaev, Seidel 2007).

"Feature preserving depth compression of range images": slopes that are out of
line are dropped, large ones attenuated as in Fattal 2002, fine ones boosted by
unsharp masking; heights follow from Poisson's equation and are rescaled.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.relief.classic.figure import TAILS, extent, model_slopes, smooth, stretch
from relieffab.relief.classic.integrate import integrate
from relieffab.relief.model import nodes_of
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

OUTLIER = 6.0  # slopes steeper than this belong to silhouettes and are dropped
KNEE = 0.1  # of the mean slope: what is below is amplified, what is above attenuated
EXPONENT = 0.7  # of the attenuation: 1 keeps slopes, 0 makes them all alike
BOOST = 6.0  # of detail, against its neighbourhood's mean
REACH = 0.012  # sigma of that neighbourhood, of the figure's extent


def attenuate(v: Floats, sound: Bools, *, knee: float, exponent: float) -> Floats:
    """Make large slopes smaller, and small ones larger, in proportion.

    v (|v| / a)^(b - 1) with a the knee times the mean slope (Fattal 2002).
    On the vectors, where the publication takes x and y apart, so that
    a turned figure gives a turned relief.

    Parameters
    ----------
    v : (2, rows, cols) ndarray
    sound : (rows, cols) ndarray of bool
        Where the mean is taken; what lies beyond becomes 0.
    knee, exponent : float

    Returns
    -------
    (2, rows, cols) ndarray
    """
    size = np.hypot(v[0], v[1])
    usual = float(size[sound].mean()) if sound.any() else 0.0
    if usual == 0.0:
        return np.zeros_like(v)
    steepness = np.maximum(size / (knee * usual), 1e-6)
    return np.where(sound, v * steepness ** (exponent - 1.0), 0.0)


def boosted(v: Floats, sound: Bools, sigma: float, boost: float) -> Floats:
    """Sharpen by unsharp masking: the neighbourhood's mean, and the boosted rest."""
    mean = smooth(v, sound, sigma)
    return np.where(sound, mean + boost * (v - mean), 0.0)


def gradient(layers: Layers, depth: float) -> Floats:
    """Compress the model in the gradient domain.

    Parameters
    ----------
    layers : Layers
    depth : float
        mm.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        Heights, mm, -depth to 0; 0 outside the figure.
    """
    figure, place = cropped(layers)
    slope, whole = model_slopes(figure)
    sound = whole & (np.hypot(slope[0], slope[1]) < OUTLIER)
    calm = attenuate(slope, sound, knee=KNEE, exponent=EXPONENT)
    fine = boosted(calm, sound, REACH * extent(figure) / figure.pitch, BOOST)
    heights = integrate(fine, np.ones(sound.shape), figure.mask, figure.pitch)
    relief = stretch(heights, nodes_of(figure.mask), depth, tails=TAILS)
    return place.put(relief, layers.grid.node_shape)
