"""Projected Gauss-Newton steps on one lattice."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.progress import Progress, silent
from relieffab.relief.bounds import hold, move
from relieffab.relief.energy.couplings import levels
from relieffab.relief.energy.linearise import Linearisation, linearise
from relieffab.relief.energy.terms import Terms
from relieffab.relief.multigrid.conjugate import solve
from relieffab.relief.multigrid.cycle import FINEST

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

ROUGH = 0.5  # tolerance of a step's solution while nodes still come to the bounds and leave
LEAST_STEP = 1e-3  # of a Gauss-Newton step, after which none is taken
INNER = 1 + 2 * FINEST[0]  # applications of the operator that a conjugate gradient iteration takes


@dataclass(frozen=True)
class Descent:
    """How the energy was brought down.

    Parameters
    ----------
    energy : dict of float
        'depth', 'light', 'line', 'form' and 'total', without unit.
    gradient : float
        Norm of the projected gradient at the end, 1/mm: 0 where the heights meet
        the optimality conditions (Karush-Kuhn-Tucker) exactly.
    residual : float
        That norm, relative to the one of a flat panel.
    iterations : int
        Gauss-Newton steps.
    inner : int
        Conjugate gradient iterations.
    applications : int
        Of the lattice's operator or of its nonlinear kin, the energy's gradient.
    converged : bool
        Whether the residual came below the tolerance.
    """

    energy: dict[str, float]
    gradient: float
    residual: float
    iterations: int
    inner: int
    applications: int
    converged: bool


def flat_norm(terms: Terms) -> float:
    """Norm of the energy's gradient on a flat panel, 1/mm: what there is to be done."""
    return float(np.linalg.norm(linearise(terms, np.zeros(terms.figure.shape)).gradient))


def newton(here: Linearisation, free: Bools, pull: Floats, tolerance: float) -> tuple[Floats, int]:
    """Solve for the Gauss-Newton step on the free nodes; `pull` becomes its right-hand side."""
    pull *= -0.5
    return solve(
        lambda x, out: here.tangent.apply(x, free, out),
        levels(here.tangent, free),
        pull,
        tolerance=tolerance,
    )


def descend(
    terms: Terms,
    h: Floats,
    *,
    tolerance: float,
    most: int,
    report: Progress = silent,
) -> tuple[Floats, Descent]:
    """Minimise the energy within the bounds by projected Newton steps.

    Bounds that the gradient pushes against are held, a Gauss-Newton step is taken
    on the rest and projected back (Bertsekas 1982); it is halved until the energy
    falls.

    Parameters
    ----------
    terms : Terms
    h : (n, m) ndarray
        First guess, mm, within the bounds.
    tolerance : float
        On the projected gradient, relative to the flat panel's.
    most : int
        Steps at most.
    report : Progress

    Returns
    -------
    h : (n, m) ndarray
    descent : Descent
    """
    first = flat_norm(terms)
    here = linearise(terms, h)
    free, pull, norm = hold(here.gradient, h, terms.bounds, terms.figure)
    inner = iteration = 0
    applications, settled = 2, False
    while iteration < most and norm > tolerance * first:
        report("relief", iteration, most)
        # Exact only once the nodes at the bounds are known.
        forcing = min(0.5 * tolerance * first / norm, ROUGH) if settled else ROUGH
        step, used = newton(here, free, pull, forcing)
        inner, applications = inner + used, applications + INNER * used
        size = 1.0
        while size > LEAST_STEP:
            new = move(h, step, size, terms.bounds)
            there = linearise(terms, new)
            applications += 1
            if there.value < here.value:
                break
            size /= 2
        else:
            break
        h, here, before = new, there, free
        free, pull, norm = hold(here.gradient, h, terms.bounds, terms.figure)
        settled = bool((free == before).all())
        iteration += 1
    energy = {**here.parts, "total": here.value}
    residual = norm / first if first > 0 else 0.0
    return h, Descent(
        energy, norm, residual, iteration, inner, applications, norm <= tolerance * first
    )
