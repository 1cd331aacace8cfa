"""Layers to heights: projected Gauss-Newton steps, from coarse to fine."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.progress import Progress, silent
from relieffab.relief.edge import inward_distance, wall
from relieffab.relief.energy import Bounds, Terms, linearise, operator
from relieffab.relief.multigrid import build, solve
from relieffab.relief.pyramid import halve, refine
from relieffab.relief.targets import Carving, Fit, terms_of
from relieffab.relief.window import cropped

Floats = NDArray[np.float64]

COARSEST = 128  # rows or columns of pixels below which no coarser grid helps
FITTING = 3  # rounds in which the form's span is fitted
OUTSIDE = (2.0, 98.0)  # percentiles of the heights that have to lie within the bounds
TOP = 0.05  # of the depth, kept above the upper of them
LEAST_GAIN = 0.4  # slopes are not made gentler than this
RIM = 1.5  # mm from the edge that do not count


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
    converged : bool
        Whether the residual came below the tolerance.
    """

    energy: dict[str, float]
    residual: float
    iterations: int
    inner: int
    converged: bool


def projected_gradient(gradient: Floats, h: Floats, bounds: Bounds) -> Floats:
    """Drop the components that only push against a bound."""
    at_low = (h <= bounds[0]) & (gradient > 0)
    at_high = (h >= bounds[1]) & (gradient < 0)
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
    first = norm = float(np.linalg.norm(projected_gradient(here.gradient, h, terms.bounds)))
    inner = iteration = 0
    while iteration < most and norm > tolerance * first and first > 0:
        report("relief", iteration, most)
        pull = projected_gradient(here.gradient, h, terms.bounds)
        at_bound = (h <= terms.bounds[0]) | (h >= terms.bounds[1])
        free = figure & ~(at_bound & (pull == 0))
        levels = build(operator(terms, here), free)
        forcing = min(0.1, max(0.3 * tolerance, 0.3 * norm / first))
        step, used = solve(levels, -0.5 * pull, tolerance=forcing)
        inner += used
        size, there, new = 1.0, here, h
        while size > 1e-3:
            new = np.clip(h + size * step, *terms.bounds)
            there = linearise(terms, new)
            if there.value < here.value:
                break
            size /= 2
        else:
            break
        h, here = new, there
        norm = float(np.linalg.norm(projected_gradient(here.gradient, h, terms.bounds)))
        iteration += 1
    energy = {**here.parts, "total": here.value}
    residual = norm / first if first > 0 else 0.0
    return h, Solution(energy, residual, iteration, inner, residual <= tolerance)


def fit(layers: Layers, carving: Carving) -> Fit:
    """Choose the form's span and the slopes' gain so that the relief fits its depth.

    Detail rises above the form and cuts below it, by how much only solving
    tells: solved without bounds, slopes are made gentler where all is too tall,
    and the span's ends moved by what sticks out or is left unused.  The rim does
    not count: the wall covers it.

    Parameters
    ----------
    layers : Layers
        A coarse grid does.
    carving : Carving

    Returns
    -------
    Fit
        Its span within the depth, and at least half of it.
    """
    figure, _ = cropped(layers)
    depth = carving.depth
    far = inward_distance(figure.mask)
    inner = far > min(RIM / figure.pitch, 0.5 * max(float(far.max()), 0.0))
    low, high, gain = -0.9 * depth, -0.2 * depth, 1.0
    for _ in range(FITTING):
        terms = terms_of(figure, carving, Fit((low, high), gain), (-np.inf, np.inf))
        heights, _ = descend(terms, terms.form, tolerance=1e-2, most=12)
        counted = inner if inner.any() else terms.form_weight > 0
        bottom, top = np.percentile(heights[counted], OUTSIDE)
        gain = float(np.clip(gain * depth / max(top - bottom, 1e-9), LEAST_GAIN, 1.0))
        high = float(np.clip(high - top - TOP * depth, -0.4 * depth, -TOP * depth))
        low = float(np.clip(low - depth - bottom, -depth, high - 0.5 * depth))
    return Fit((low, high), gain)


def _lowest(layers: Layers, carving: Carving) -> Floats:
    """Lower bound of the heights: none where the wall lies above the deepest anyway."""
    edge = wall(layers.mask, layers.pitch, carving.wall_angle)
    return np.where(edge > -carving.depth, -np.inf, -carving.depth)


def solve_heights(
    layers: Layers,
    carving: Carving,
    *,
    tolerance: float = 1e-2,
    progress: Progress = silent,
) -> tuple[Floats, Solution]:
    """Minimise the energy from coarse to fine.

    Parameters
    ----------
    layers : Layers
    carving : Carving
    tolerance : float
        On the projected gradient, relative to the first guess's.
    progress : Progress

    Returns
    -------
    heights : (rows + 1, cols + 1) ndarray
        mm, within the bounds, 0 outside the figure; without the wall at its edge.
    solution : Solution
    """
    level = layers
    figures = [(level, *cropped(level))]
    while min(figures[-1][1].grid.shape) > COARSEST:
        level = halve(level)
        figures.append((level, *cropped(level)))
    fitted = fit(level, carving)
    heights, figure = np.zeros(0), np.zeros(0, bool)
    for level, part, place in reversed(figures):
        terms = terms_of(part, carving, fitted, (_lowest(part, carving), 0.0))
        guess = terms.form
        if heights.size:
            guess = place.take(refine(heights, figure, level.grid.node_shape))
        guess = np.clip(guess, *terms.bounds) * (terms.form_weight > 0)
        finest = level is layers
        solved, solution = descend(
            terms,
            guess,
            tolerance=tolerance if finest else max(tolerance, 3e-2),
            most=40,
            report=progress if finest else silent,
        )
        heights = place.put(solved, level.grid.node_shape)
        figure = place.put(terms.form_weight > 0, level.grid.node_shape)
    return heights, solution
