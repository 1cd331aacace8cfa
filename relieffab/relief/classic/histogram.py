"""Adaptive histogram equalisation of heights (Sun, Rosin, Martin, Langbein 2009).

"Bas-relief generation using adaptive histogram equalisation": each pixel gets
its rank among the heights of its neighbourhood, where steep pixels count for
more; how far heights are drawn apart is limited, and the ranks in neighbourhoods
of several sizes are averaged.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.model import Layers
from relieffab.relief.classic.figure import EVEN, extent, model_slopes, stretch
from relieffab.relief.model import nodes_of, to_nodes
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]

SIDES = (0.05, 0.1, 0.2, 0.4)  # of the neighbourhoods, of the figure's extent
LEAST = 0.05  # weight of a level pixel, against 1 of a steep one
BINS = 256  # of the whole range of heights; ranks are linear within a bin
LIMIT = 6.0  # heights are drawn apart no more than this, against one even scale
FINENESS = 3.0  # points of the lattice of histograms to a sigma of the neighbourhood


def ranks(level: Floats, weight: Floats, sigma: float, limit: float) -> Floats:
    """Rank pixels in their neighbourhoods, contrast limited.

    The histogram's bins are cut off at a limit and what is cut off is spread
    evenly, so that nowhere are heights drawn apart more than that, and nowhere is
    their order lost.  Histograms are taken on a lattice coarser than the pixels
    (Zuiderveld 1994); between its points B-splines, which blur a little but never
    overshoot, leave no kinks.

    Parameters
    ----------
    level : (rows, cols) ndarray
        Heights, 0 to 1.
    weight : (rows, cols) ndarray
        0 where pixels do not count.
    sigma : float
        Of the bell that is the neighbourhood, pixels.
    limit : float
        Of a bin, against the mean bin.

    Returns
    -------
    (rows, cols) ndarray
        0 to 1; 0 where pixels do not count.
    """
    step = max(sigma / FINENESS, 1.0)
    spread = (sigma / step, sigma / step)
    shares = ndimage.gaussian_filter(
        _splat(level, weight, step), spread, mode="constant", axes=(0, 1)
    )
    total = shares.sum(axis=2, keepdims=True)
    shares = np.divide(shares, total, out=np.full_like(shares, 1 / BINS), where=total > 0)
    kept = np.minimum(shares, limit / BINS)
    kept += (1.0 - kept.sum(axis=2, keepdims=True)) / BINS
    rank = np.zeros((*shares.shape[:2], BINS + 1), np.float32)
    np.cumsum(kept, axis=2, out=rank[:, :, 1:])
    counted = np.nonzero(weight)
    row, col = (index / step + 1 for index in counted)
    place = np.stack([row, col, BINS * level[counted]])
    out = np.zeros(level.shape)
    out[counted] = ndimage.map_coordinates(rank, place, order=3, prefilter=False, mode="nearest")
    return out


def _splat(level: Floats, weight: Floats, step: float) -> NDArray[np.float32]:
    """Histograms on a lattice: each pixel shared out among the four points around it."""
    rows, cols = np.nonzero(weight)
    shape = tuple(int(size / step) + 4 for size in level.shape)
    row, col = rows / step + 1, cols / step + 1
    i, j = row.astype(int), col.astype(int)
    u, v = row - i, col - j
    height = np.minimum((BINS * level[rows, cols]).astype(int), BINS - 1)
    out = np.zeros(shape[0] * shape[1] * BINS)
    for a, b in np.ndindex(2, 2):
        share = weight[rows, cols] * (u if a else 1.0 - u) * (v if b else 1.0 - v)
        index = ((i + a) * shape[1] + j + b) * BINS + height
        out += np.bincount(index, share, len(out))
    return out.reshape(*shape, BINS).astype(np.float32)


def histogram(layers: Layers, depth: float) -> Floats:
    """Equalise the model's heights, neighbourhood by neighbourhood.

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
    mask, pitch = figure.mask, figure.pitch
    seen = figure.depth[mask]
    span = float(np.ptp(seen))
    level = np.where(mask, (figure.depth - seen.min()) / (span if span > EVEN else 1.0), 0.0)
    slope, _ = model_slopes(figure)
    size = np.hypot(slope[0], slope[1])
    weight = mask * (LEAST + size / (size + max(float(size[mask].mean()), 1e-12)))
    # A bell of the square's standard deviation stands for it: it leaves no streaks.
    deviation = extent(figure) / pitch / np.sqrt(12.0)
    total = np.sum([ranks(level, weight, side * deviation, LIMIT) for side in SIDES], axis=0)
    relief = stretch(to_nodes(total, mask.astype(float)), nodes_of(mask), depth)
    return place.put(relief, layers.grid.node_shape)
