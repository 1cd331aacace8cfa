"""Layers to Relief: projected Gauss-Newton steps, from coarse to fine."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.progress import Progress, silent
from relieffab.relief.edge import fill, wall
from relieffab.relief.energy import Terms, linearise, operator
from relieffab.relief.model import Relief
from relieffab.relief.multigrid import build, solve
from relieffab.relief.pyramid import halve, refine
from relieffab.relief.targets import Carving, terms_of, to_nodes
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]

COARSEST = 64  # rows or columns of pixels below which no coarser grid helps


@dataclass(frozen=True)
class Solution:
    """How the solver came to its relief.

    Parameters
    ----------
    energy : dict of float
        'depth', 'light', 'line', 'form' and 'total', without unit.
    residual : float
        Norm of the projected gradient, relative to the first guess's.
    iterations : int
        Gauss-Newton steps on the finest lattice.
    inner : int
        Conjugate gradient iterations on the finest lattice.
    """

    energy: dict[str, float]
    residual: float
    iterations: int
    inner: int


def projected_gradient(gradient: Floats, h: Floats, depth: float) -> Floats:
    """Drop the components that only push against a bound."""
    at_low = (h <= -depth) & (gradient > 0)
    at_high = (h >= 0) & (gradient < 0)
    return np.where(at_low | at_high, 0.0, gradient)


def descend(
    terms: Terms, h: Floats, *, tolerance: float, most: int, report: Progress = silent
) -> tuple[Floats, Solution]:
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
        On the projected gradient, relative to the first guess's.
    most : int
        Steps at most.

    Returns
    -------
    h : (n, m) ndarray
    solution : Solution
    """
    figure = terms.form_weight > 0
    here = linearise(terms, h)
    first = norm = float(np.linalg.norm(projected_gradient(here.gradient, h, terms.depth)))
    inner = iteration = 0
    while iteration < most and norm > tolerance * first and first > 0:
        report("relief", iteration, most)
        pull = projected_gradient(here.gradient, h, terms.depth)
        at_bound = (h <= -terms.depth) | (h >= 0)
        free = figure & ~(at_bound & (pull == 0))
        levels = build(operator(terms, here), free)
        forcing = min(0.1, max(0.3 * tolerance, 0.3 * norm / first))
        step, used = solve(levels, -0.5 * pull, tolerance=forcing)
        inner += used
        size, there, new = 1.0, here, h
        while size > 1e-3:
            new = np.clip(h + size * step, -terms.depth, 0.0)
            there = linearise(terms, new)
            if there.value < here.value:
                break
            size /= 2
        else:
            break
        h, here = new, there
        norm = float(np.linalg.norm(projected_gradient(here.gradient, h, terms.depth)))
        iteration += 1
    energy = {**here.parts, "total": here.value}
    return h, Solution(energy, norm / first if first > 0 else 0.0, iteration, inner)


def _solve_on(
    layers: Layers, carving: Carving, tolerance: float, report: Progress
) -> tuple[Floats, Solution]:
    """Heights on all nodes of the layers' grid, coarser grids first."""
    figure, place = cropped(layers)
    terms = terms_of(figure, carving)
    guess = terms.form
    if min(figure.grid.shape) > COARSEST:
        coarse, _ = _solve_on(halve(layers), carving, max(tolerance, 1e-2), silent)
        guess = place.take(refine(coarse, layers.grid.node_shape))
    guess = np.clip(guess, -terms.depth, 0.0) * (terms.form_weight > 0)
    heights, solution = descend(terms, guess, tolerance=tolerance, most=12, report=report)
    return place.put(heights, layers.grid.node_shape), solution


def make_relief(
    layers: Layers,
    carving: Carving | None = None,
    *,
    tolerance: float = 1e-3,
    progress: Progress = silent,
) -> tuple[Relief, Solution]:
    """Turn three aligned images into one height field within its bounds.

    Parameters
    ----------
    layers : Layers
    carving : Carving, optional
    tolerance : float
        On the projected gradient, relative to the first guess's.
    progress : Progress

    Returns
    -------
    relief : Relief
        -depth <= h <= 0 exactly, 0 outside the figure, its highest point at 0.
    solution : Solution
    """
    carving = carving or Carving()
    heights, solution = _solve_on(layers, carving, tolerance, progress)
    figure = to_nodes(layers.mask.astype(float), np.ones(layers.grid.shape)) > 0
    heights[figure] -= heights[figure].max()
    heights = np.maximum(heights, wall(layers.mask, layers.pitch, carving.wall_angle))
    heights = np.minimum(fill(heights, layers.pitch, carving.fillet), 0.0)
    return Relief(layers.grid, heights, layers.mask, carving.depth), solution
