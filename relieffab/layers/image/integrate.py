"""From slopes to depth: least squares on a figure of any shape.

Normal equations of sum |grad z - g|² over neighbouring pixels of the figure, solved by
conjugate gradients; their preconditioner is the same equation on the whole rectangle,
which a cosine transform solves (Frankot and Chellappa 1988 for slopes, Ghiglia and
Romero 1994 for the mask and the iteration).  Heights of reliefs, on nodes and within
bounds, have a solver of their own, a room further on.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dctn, idctn

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

TOLERANCE = 1e-4
"""On the residual, relative to what the slopes ask for."""
MOST = 300
"""Iterations."""


def _divergence(fx: Floats, fy: Floats, shape: tuple[int, int]) -> Floats:
    """Return minus the adjoint of differences: what flows out of every pixel."""
    out = np.zeros(shape)
    out[:, :-1] += fx
    out[:, 1:] -= fx
    out[:-1] += fy
    out[1:] -= fy
    return out


def _solve(wx: Floats, wy: Floats, rhs: Floats) -> Floats:
    """Solve -div(w grad z) = rhs."""
    rows, cols = rhs.shape
    eigen = (
        (2 - 2 * np.cos(np.pi * np.arange(rows) / rows))[:, None]
        + (2 - 2 * np.cos(np.pi * np.arange(cols) / cols))
        + 1e-9
    )
    active = np.zeros((rows, cols), bool)
    active[:, :-1] |= wx > 0
    active[:, 1:] |= wx > 0
    active[:-1] |= wy > 0
    active[1:] |= wy > 0

    def apply(z: Floats) -> Floats:
        return -_divergence(wx * np.diff(z, axis=1), wy * np.diff(z, axis=0), z.shape)

    def eased(r: Floats) -> Floats:
        return np.asarray(idctn(dctn(r, norm="ortho") / eigen, norm="ortho")) * active

    z, r = np.zeros(rhs.shape), np.where(active, rhs, 0.0)
    goal = TOLERANCE * float(np.linalg.norm(r)) + 1e-300
    y = eased(r)
    direction, rho = y, float((r * y).sum())
    for _ in range(MOST):
        if float(np.linalg.norm(r)) <= goal or rho <= 0:
            break
        product = apply(direction)
        size = rho / float((direction * product).sum())
        z = z + size * direction
        r = r - size * product
        y = eased(r)
        before, rho = rho, float((r * y).sum())
        direction = y + rho / before * direction
    return z


def integrate(slopes: Floats, mask: Bools, pitch: float) -> Floats:
    """Find the depth whose slopes come nearest to those given.

    Where one part of the figure stands in front of another no slope tells how far:
    the step is spread over what lies around it.

    Parameters
    ----------
    slopes : (2, rows, cols) ndarray
        dD/dx and dD/dy at the pixels.
    mask : (rows, cols) ndarray of bool
        The figure; a natural boundary along its edge.
    pitch : float
        mm.

    Returns
    -------
    (rows, cols) ndarray
        mm, the nearest point of every part of the figure at 0; 0 outside.
    """
    gx, gy = steps_between(slopes, mask, pitch)
    wx, wy = (mask[:, 1:] & mask[:, :-1]).astype(float), (mask[1:] & mask[:-1]).astype(float)
    rhs = -_divergence(wx * gx, wy * gy, mask.shape)
    return _levelled(_solve(wx, wy, rhs), mask)


def steps_between(slopes: Floats, mask: Bools, pitch: float) -> tuple[Floats, Floats]:
    """Return the steps of depth that slopes ask for, from each pixel to the next.

    Returns
    -------
    across : (rows, cols - 1) ndarray
        To the right neighbour, mm.
    down : (rows - 1, cols) ndarray
        To the lower one, mm.
    """
    level = 1.0 / np.sqrt(1.0 + slopes[0] ** 2 + slopes[1] ** 2)
    across = pitch * _chords((slopes[0] * mask).T, level.T).T
    return across, -pitch * _chords(slopes[1] * mask, level)


def _chords(slope: Floats, level: Floats) -> Floats:
    """Slope of the step from each row to the next: of the chord of an arc that has their normals.

    Weighed by n_z, that is; the plain mean overshoots where a form turns away.
    """
    total = slope[1:] * level[1:] + slope[:-1] * level[:-1]
    return np.asarray(total / (level[1:] + level[:-1]))


def _levelled(z: Floats, mask: Bools) -> Floats:
    """Bring the nearest point of each part of the figure to 0: nothing says how they stand."""
    from scipy import ndimage

    parts, count = ndimage.label(mask)
    top = ndimage.maximum(z, parts, np.arange(count + 1))
    return np.where(mask, z - np.asarray(top)[parts], 0.0)
