"""Slopes to heights: the weighted Poisson equation on a figure."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from relieffab.relief.energy.couplings import levels
from relieffab.relief.energy.linearise import linearise
from relieffab.relief.energy.tangent import Tangent
from relieffab.relief.energy.terms import Terms, Weights
from relieffab.relief.model import nodes_of
from relieffab.relief.multigrid.conjugate import solve

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

LEAST = 1 / 64  # weight of slopes nobody vouches for: they bridge what would fall apart
TWIST = 1 / 128  # of a pixel's twist: its four corners do not see a checkerboard of heights
SCREEN = 1e-6  # pull towards 0, a pixel, that makes the preconditioner definite
TOLERANCE = 1e-5  # on the residual, relative to what the slopes ask for


def integrate(
    slopes: Floats, weight: Floats, mask: Bools, pitch: float, *, tolerance: float = TOLERANCE
) -> Floats:
    """Find the heights whose slopes come nearest to those asked for.

    Minimises sum w |grad h - g|^2 over the figure's pixels, a natural boundary
    along its edge.

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
    figure = nodes_of(mask)
    free = Weights(depth=0.0, line=1.0, twist=TWIST, light=0.0, form=0.0)
    terms = Terms(
        pitch=pitch,
        lights=np.zeros((0, 3)),
        weights=free,
        mask=mask,
        stencil=np.where(mask, np.maximum(weight, LEAST), 0.0).astype(np.float32),
        slope=slopes.astype(np.float32),
        whole=np.zeros_like(figure),
        radiance=None,
        figure=figure,
        form=np.zeros(figure.shape, np.float32),
        bounds=(np.full(figure.shape, -np.inf, np.float32), np.inf),
    )
    here = linearise(terms, np.zeros(figure.shape))
    screened = replace(terms, weights=replace(free, form=SCREEN / pitch**2))
    rough = levels(Tangent(screened, here.tangent.p, here.tangent.q), figure)
    heights, _ = solve(
        lambda x, out: here.tangent.apply(x, figure, out),
        rough, -0.5 * here.gradient, tolerance=tolerance, most=200,
    )  # fmt: skip
    return np.where(figure, heights - heights[figure].mean(), 0.0)
