"""Slopes to heights: the weighted Poisson equation on a figure."""

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.model import nodes_of, pixel_slopes
from relieffab.relief.multigrid import build, solve

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

LEAST = 1 / 64  # weight of slopes nobody vouches for: they bridge what would fall apart
TWIST = 1 / 128  # share of the slopes' weight that a pixel's twist gets
SCREEN = 1e-6  # pull towards 0 that makes the operator definite: all single precision holds
TOLERANCE = 1e-5  # on the residual, relative to what the slopes ask for
ROUNDS = 12  # of correction, at most

# Couplings of a pixel's corners (far left, far right, near left, near right).
_ALONG = np.array([-1.0, 1.0, -1.0, 1.0])
_UPWARD = np.array([1.0, 1.0, -1.0, -1.0])
_TWISTED = np.array([1.0, -1.0, -1.0, 1.0])


def integrate(
    slopes: Floats, weight: Floats, mask: Bools, pitch: float, *, tolerance: float = TOLERANCE
) -> Floats:
    """Find the heights whose slopes come nearest to those asked for.

    Minimises sum w |grad h - g|^2 over the figure's pixels, a natural boundary
    along its edge.  A pixel's four corners do not see a checkerboard of heights,
    hence a small weight on its twist as well.  The operator lives in single
    precision and is screened; the residual, in double precision, is not: a few
    rounds take the screen's pull away again, all but the heights' mean.

    Parameters
    ----------
    slopes : (2, n - 1, m - 1) ndarray
        dh/dx and dh/dy asked for.
    weight : (n - 1, m - 1) ndarray
        Of each pixel's slopes, 0 to 1.
    mask : (n - 1, m - 1) ndarray of bool
        The figure, three pixels or more from the lattice's edge.
    pitch : float
        mm.
    tolerance : float
        On the residual, relative to what the slopes ask for.

    Returns
    -------
    (n, m) ndarray
        mm, of mean 0; 0 outside the figure.
    """
    free = nodes_of(mask)
    w = np.where(mask, np.maximum(np.round(weight * 1024) / 1024, LEAST), 0.0)
    levels = build(_couplings(w, free), free)
    pull = _pulled(w * slopes, np.zeros_like(w), 0.5 * pitch) * free
    goal = tolerance * float(np.linalg.norm(pull))
    heights, left = np.zeros(free.shape), pull
    for _ in range(ROUNDS):
        if np.linalg.norm(left) <= goal:
            break
        heights += solve(levels, left, tolerance=0.02)[0]
        there = pixel_slopes(heights, 1.0)
        left = (pull - _pulled(w * there, TWIST * w * _twist(heights), 0.5)) * free
    return np.where(free, heights - heights[free].mean(), 0.0)


def _corner(shape: tuple[int, ...], near: int, right: int) -> tuple[slice, slice]:
    """Nodes at one corner of each pixel."""
    return slice(near, near + shape[0]), slice(right, right + shape[1])


def _twist(h: Floats) -> Floats:
    return 0.5 * (h[:-1, :-1] - h[:-1, 1:] - h[1:, :-1] + h[1:, 1:])


def _pulled(slopes: Floats, twist: Floats, scale: float) -> Floats:
    """Transpose of `pixel_slopes` and the twist, to nodes."""
    out = np.zeros((twist.shape[0] + 1, twist.shape[1] + 1))
    for k, (near, right) in enumerate(np.ndindex(2, 2)):
        pixel = _ALONG[k] * slopes[0] + _UPWARD[k] * slopes[1] + _TWISTED[k] * twist
        out[_corner(twist.shape, near, right)] += scale * pixel
    return out


def _couplings(w: Floats, free: Bools) -> NDArray[np.float32]:
    """Weighted sum of squared slopes and twists as 25 couplings a node, lengths in pixels."""
    n, m = free.shape
    stencil = np.zeros((n, 25, m), np.float32)
    stencil[:, 12, :] = SCREEN * free
    for a, (i, j) in enumerate(np.ndindex(2, 2)):
        for b, (u, v) in enumerate(np.ndindex(2, 2)):
            product = _ALONG[a] * _ALONG[b] + _UPWARD[a] * _UPWARD[b]
            product += TWIST * _TWISTED[a] * _TWISTED[b]
            rows, cols = _corner(w.shape, i, j)
            stencil[rows, 5 * (u - i + 2) + v - j + 2, cols] += 0.25 * product * w
    return stencil
