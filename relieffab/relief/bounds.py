"""Heights within bounds: which of them may move, and how far."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import parallel_kernel, prange

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@parallel_kernel
def _hold(gradient, h, low, high, figure, free, pull, rows):  # type: ignore[no-untyped-def]
    """Nodes that may move, the gradient there, and its square by row."""
    for i in prange(len(h)):
        total = 0.0
        for j in range(h.shape[1]):
            g = gradient[i, j]
            held = (h[i, j] <= low[i, j] and g > 0.0) or (h[i, j] >= high and g < 0.0)
            free[i, j] = figure[i, j] and not held
            pull[i, j] = g if free[i, j] else 0.0
            total += pull[i, j] * pull[i, j]
        rows[i] = total


@parallel_kernel
def _move(h, step, size, low, high, out):  # type: ignore[no-untyped-def]
    """Go along a step, and back to the bounds."""
    for i in prange(len(h)):
        for j in range(h.shape[1]):
            out[i, j] = min(max(h[i, j] + size * step[i, j], low[i, j]), high)


def deepest(depth: float) -> np.float32:
    """Lowest height of a relief so deep, in single precision, and not below it."""
    return np.nextafter(np.float32(-depth), np.float32(0.0))


def hold(
    gradient: Floats, h: Floats, bounds: tuple[NDArray[Any], float], figure: Bools
) -> tuple[Bools, Floats, float]:
    """Hold the heights that the gradient pushes against a bound (Bertsekas 1982).

    Parameters
    ----------
    gradient, h : (n, m) ndarray
    bounds : tuple of (n, m) ndarray and float
        Lowest and highest height.
    figure : (n, m) ndarray of bool
        Nodes that may move at all.

    Returns
    -------
    free : (n, m) ndarray of bool
    pull : (n, m) ndarray
        The gradient on them, 0 elsewhere: the projected gradient.
    norm : float
        Of `pull`.
    """
    free, pull, rows = np.empty(h.shape, bool), np.empty(h.shape), np.empty(len(h))
    _hold(gradient, h, bounds[0], bounds[1], figure, free, pull, rows)
    return free, pull, float(np.sqrt(rows.sum()))


def move(h: Floats, step: Floats, size: float, bounds: tuple[NDArray[Any], float]) -> Floats:
    """Go a multiple of a step, no further than the bounds."""
    out = np.empty_like(h)
    _move(h, step, size, bounds[0], bounds[1], out)
    return out


def within(
    guess: NDArray[np.floating], bounds: tuple[NDArray[Any], float], figure: Bools
) -> Floats:
    """Bring a guess within the bounds, in double precision; 0 where nothing may move."""
    return np.where(figure, np.clip(guess.astype(float), *bounds), 0.0)
