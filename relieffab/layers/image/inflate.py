"""The body that an outline alone suggests: round, standing upright at its edge."""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

COARSE = 160
"""Pixels each way at most on which the body is found; it has nothing finer."""


def _poisson(mask: Bools) -> Floats:
    """Solve -laplace u = 4 in the mask, u = 0 beyond it, in pixels squared."""
    number = np.full(mask.shape, -1)
    number[mask] = np.arange(int(mask.sum()))
    rows, cols = [], []
    for a, b in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        both = mask[a] & mask[b]
        rows += [number[a][both], number[b][both]]
        cols += [number[b][both], number[a][both]]
    row, col = np.concatenate(rows), np.concatenate(cols)
    count = int(mask.sum())
    every = np.arange(count)
    data = np.concatenate([np.full(len(row), -1.0), np.full(count, 4.0)])
    at = np.concatenate([row, every]), np.concatenate([col, every])
    u = np.zeros(mask.shape)
    u[mask] = spsolve(coo_array((data, at), shape=(count, count)).tocsc(), np.full(count, 4.0))
    return u


def inflate(mask: Bools, pitch: float) -> Floats:
    """Blow a silhouette up: a disc becomes half a ball, a strip half a cylinder.

    The root of the solution of Poisson's equation, -laplace u = 4, u = 0 at the
    edge; a disc's own is r² - d² (after Igarashi et al. 1999 and Prasad and
    Fitzgibbon 2006, who inflate outlines as well).

    Parameters
    ----------
    mask : (rows, cols) ndarray of bool
    pitch : float
        mm.

    Returns
    -------
    (rows, cols) ndarray
        mm, 0 outside.
    """
    padded = np.pad(mask, 1)
    every = max(1, int(np.ceil(max(padded.shape) / COARSE)))
    blurred = ndimage.uniform_filter(padded.astype(float), every) if every > 1 else padded
    small = np.asarray(blurred[every // 2 :: every, every // 2 :: every] >= 0.5, bool)
    if not small.any():
        return np.zeros(mask.shape)
    at = np.meshgrid(
        *((np.arange(1, n + 1) - every // 2) / every for n in mask.shape), indexing="ij"
    )
    u = ndimage.map_coordinates(_poisson(small), at, order=1, mode="nearest")
    return np.where(mask, np.sqrt(np.maximum(u, 0.0)) * every * pitch, 0.0)
