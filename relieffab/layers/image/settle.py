"""From a surface to the one near it that looks most like a photograph.

Limited-memory BFGS (Nocedal and Wright, Numerical Optimization, 2006, Alg. 7.4).  Its
first guess at the Hessian is a typical one, which a cosine transform inverts: brightness
asks for slopes, bending for their differences, so wide forms would else move far slower
than fine ones.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dctn, idctn, next_fast_len

from relieffab.layers.image.likeness import Photograph, energy_of

Floats = NDArray[np.float64]

STIFF = 0.1
"""Fourth differences of that Hessian, against its second ones."""
WIDEST = 1e-4
"""The least of its eigenvalues."""
MEMORY = 8
"""Pairs of steps that are kept."""
ENOUGH = 1e-6
"""Relative gain of a step that ends it."""
DOWNHILL = 1e-4
"""Share of the gain that the slope promises which a step has to bring (Armijo)."""
HALVINGS = 12
"""Of a step that does not, at most."""

Pair = tuple[Floats, Floats]
"""A step, and how the slope changed on it."""


class _Hessian:
    """The inverse of a typical Hessian."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.shape = shape
        self.wide = tuple(next_fast_len(n, real=True) for n in shape)
        rows, cols = (2.0 - 2.0 * np.cos(np.pi * np.arange(n) / n) for n in self.wide)
        square = rows[:, None] + cols
        self.inverse = 1.0 / (square + STIFF * square**2 + WIDEST)

    def solve(self, slope: Floats) -> Floats:
        """Step to the minimum that the slope at a place promises, the other way."""
        waves = dctn(slope, s=self.wide, norm="ortho") * self.inverse
        found = idctn(waves, norm="ortho", overwrite_x=True)
        return np.asarray(found[: self.shape[0], : self.shape[1]])


def _step(slope: Floats, pairs: list[Pair], hessian: _Hessian) -> Floats:
    """Two loops over the pairs, the latest last."""
    q, shares = slope.copy(), []
    for s, y in reversed(pairs):
        shares.append(np.vdot(s, q) / np.vdot(s, y))
        q -= shares[-1] * y
    r = hessian.solve(q)
    if pairs:
        s, y = pairs[-1]
        r *= np.vdot(s, y) / np.vdot(y, hessian.solve(y))
    for (s, y), share in zip(pairs, reversed(shares), strict=True):
        r += (share - np.vdot(y, r) / np.vdot(s, y)) * s
    return -r


def settle(
    start: Floats, photograph: Photograph, rounds: int, *, reference: Floats, hold: float
) -> Floats:
    """Let a surface settle into a photograph.

    Parameters
    ----------
    start : (rows + 1, cols + 1) ndarray
        Depth at the pixels' corners, pixels.
    photograph : Photograph
    rounds : int
        Steps at most.
    reference : (rows + 1, cols + 1) ndarray
        What settles that which no brightness tells, the mean depth above all.
    hold : float
        How firmly: sum of hold / 2 (z - reference)² over the figure's corners is added.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
    """
    held, mask = np.zeros(start.shape), photograph.mask
    for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
        held[i : i + mask.shape[0], j : j + mask.shape[1]][mask] = hold

    def value(z: Floats) -> tuple[float, Floats]:
        energy, slope = energy_of(z, photograph)
        away = held * (z - reference)
        return energy + 0.5 * float(np.vdot(away, z - reference)), slope + away

    hessian, pairs = _Hessian(start.shape), list[Pair]()
    z, (energy, slope) = start, value(start)
    for _ in range(rounds):
        step = _step(slope, pairs, hessian)
        promised = float(np.vdot(step, slope))
        size = 1.0
        for _ in range(HALVINGS):
            ahead, slope_ahead = value(z + size * step)
            if ahead <= energy + DOWNHILL * size * promised:
                break
            size *= 0.5
        else:
            break
        change = slope_ahead - slope
        z, gain = z + size * step, energy - ahead
        if np.vdot(step, change) > 0.0:
            pairs = [*pairs, (size * step, change)][-MEMORY:]
        energy, slope = ahead, slope_ahead
        if gain <= ENOUGH * energy:
            break
    return z
