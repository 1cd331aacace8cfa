"""From a surface to the one near it that looks most like a photograph.

Limited-memory BFGS (Liu and Nocedal 1989) on depths filtered by the root of a typical
Hessian's inverse, which a cosine transform applies: brightness asks for slopes, bending
for their differences, so that wide forms would else move slower than fine ones by far.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dctn, idctn
from scipy.optimize import minimize

from relieffab.layers.image.likeness import Photograph, energy_of

Floats = NDArray[np.float64]

STIFF = 0.1
"""Fourth differences of that Hessian, against its second ones."""
WIDEST = 1e-4
"""The least of its eigenvalues."""
MEMORY = 8
"""Pairs of steps that BFGS keeps."""
ENOUGH = 1e-7
"""Relative gain of a step that ends it."""


def _root(shape: tuple[int, ...]) -> Floats:
    rows, cols = (2.0 - 2.0 * np.cos(np.pi * np.arange(n) / n) for n in shape)
    square = rows[:, None] + cols
    return np.asarray(1.0 / np.sqrt(square + STIFF * square**2 + WIDEST))


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
    root, mask = _root(start.shape), photograph.mask
    held = np.zeros(start.shape)
    for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
        held[i : i + mask.shape[0], j : j + mask.shape[1]][mask] = hold

    def depth(y: Floats) -> Floats:
        return start + np.asarray(idctn(y.reshape(start.shape) * root, norm="ortho"))

    def value(y: Floats) -> tuple[float, Floats]:
        z = depth(y)
        energy, slope = energy_of(z, photograph)
        away = held * (z - reference)
        energy += 0.5 * float((away * (z - reference)).sum())
        return energy, (dctn(slope + away, norm="ortho") * root).ravel()

    found = minimize(
        value, np.zeros(start.size), jac=True, method="L-BFGS-B",
        options={"maxiter": rounds, "maxcor": MEMORY, "ftol": ENOUGH},
    )  # fmt: skip
    return depth(found.x)
