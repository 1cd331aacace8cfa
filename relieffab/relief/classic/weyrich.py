"""Digital bas-relief from 3D scenes (Weyrich, Deng, Barnes, Rusinkiewicz, Finkelstein 2007).

Slopes across silhouettes are removed, the others compressed by a logarithm of
their size, bands of frequency given gains of their own, and the heights found by
least squares, with small steps of one size in place of the silhouettes' jumps.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.relief.classic.figure import TAILS, extent, model_slopes, smooth, stretch
from relieffab.relief.classic.integrate import TOLERANCE, integrate
from relieffab.relief.model import nodes_of
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

BEND = 5.0  # alpha: slopes well below 1 / alpha are kept, those above compressed
BANDS = (0.005, 0.01, 0.02, 0.04)  # sigma where one band ends and the next begins, of the extent
GAINS = (3.0, 2.5, 2.0, 1.2, 0.5)  # of the bands, finest first
STEP = 0.03  # left of every jump, of the relief's range
STEP_WEIGHT = 0.3  # of the slopes that ask for the steps


def compress_size(v: Floats, bend: float) -> Floats:
    """Compress slopes by the logarithm of their size: log(1 + alpha |v|) / alpha.

    Parameters
    ----------
    v : (2, rows, cols) ndarray
    bend : float
        alpha.

    Returns
    -------
    (2, rows, cols) ndarray
        Of the same directions.
    """
    size = np.maximum(np.hypot(v[0], v[1]), 1e-12)
    return v * np.log1p(bend * size) / (bend * size)


def banded(v: Floats, sound: Bools, sigmas: list[float], gains: tuple[float, ...]) -> Floats:
    """Weigh the bands of frequency of a field.

    Parameters
    ----------
    v : (2, rows, cols) ndarray
    sound : (rows, cols) ndarray of bool
        Pixels that count.
    sigmas : list of float
        Ascending, pixels.
    gains : tuple of float
        One more: of what is finer than the first sigma, ..., coarser than the last.

    Returns
    -------
    (2, rows, cols) ndarray
        0 on other pixels.
    """
    out, finer = np.zeros_like(v), v
    for sigma, gain in zip(sigmas, gains[:-1], strict=True):
        coarser = smooth(v, sound, sigma)
        out += gain * (finer - coarser)
        finer = coarser
    return np.where(sound, out + gains[-1] * finer, 0.0)


def toward(layers: Layers) -> Floats:
    """Find which way the depth jumps at pixels next to occlusions.

    Returns
    -------
    (2, rows, cols) ndarray
        Unit vectors from far to near, X right and Y away; 0 where depth is even.
    """
    d = np.where(layers.mask, layers.depth, np.nan)
    upward, along = (np.gradient(np.pad(d, 1, mode="edge"), axis=k)[1:-1, 1:-1] for k in (0, 1))
    jump = np.nan_to_num(np.stack([along, -upward]))
    return jump / np.maximum(np.hypot(jump[0], jump[1]), 1e-12)


def weyrich(layers: Layers, depth: float) -> Floats:
    """Compress the model's slopes by their logarithm, band by band.

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
    nodes, pitch = nodes_of(figure.mask), figure.pitch
    slope, whole = model_slopes(figure)
    torn = figure.mask & ~whole
    first = 1e-3 if torn.any() else TOLERANCE
    sigmas = [share * extent(figure) / pitch for share in BANDS]
    asked = banded(compress_size(slope, BEND), whole, sigmas, GAINS)
    heights = integrate(asked, whole.astype(float), figure.mask, pitch, tolerance=first)
    if torn.any():
        # The jump is spread over the two pixels that it touches.
        low, high = np.percentile(heights[nodes], (TAILS, 100.0 - TAILS))
        asked += torn * toward(figure) * STEP * (high - low) / (2 * pitch)
        heights = integrate(asked, whole + STEP_WEIGHT * torn, figure.mask, pitch)
    return place.put(stretch(heights, nodes, depth, tails=TAILS), layers.grid.node_shape)
