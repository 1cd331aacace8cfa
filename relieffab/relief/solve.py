"""Layers to heights: from coarse to fine, or from a relief that is almost the one asked for."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from relieffab.layers.model import Layers
from relieffab.progress import Progress, silent
from relieffab.relief.bounds import deepest, within
from relieffab.relief.descend import Descent, descend
from relieffab.relief.edge import wall
from relieffab.relief.energy.terms import Terms
from relieffab.relief.fit import fit
from relieffab.relief.foot import carved
from relieffab.relief.pyramid import halve, refine
from relieffab.relief.targets import Carving, Fit, terms_of
from relieffab.relief.window import Window, cropped

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

COARSEST = 128  # rows or columns of pixels below which no coarser grid helps
ROUGHLY = 3e-2  # tolerance on lattices that are only a start for finer ones
SHALLOW = 1e-3  # of the depth: what a tip may leave of it and more is worth nothing
GIVEN_UP = 4  # rounds of giving up what no tip reaches, at most
STEPS = 40  # Gauss-Newton steps at most, on any lattice


@dataclass(frozen=True, eq=False)
class Solution(Descent):
    """How the solver came to its relief, on the finest lattice.

    Parameters
    ----------
    fitted : Fit
        How form and detail share the depth.
    heights : (rows + 1, cols + 1) ndarray
        mm; before anything was cut to the cutter and the wall.
    """

    fitted: Fit
    heights: Floats


def _lowest(edge: Floats, depth: float) -> Singles:
    """Lower bound of the heights: none where the wall lies above the deepest anyway."""
    return np.where(edge > -depth, np.float32(-np.inf), deepest(depth))


def problem(
    layers: Layers, carving: Carving, fitted: Fit, edge: Floats | None = None
) -> tuple[Terms, Window]:
    """Put the energy and its bounds together, on the figure's part of the grid.

    Parameters
    ----------
    layers : Layers
    carving : Carving
    fitted : Fit
    edge : (rows + 1, cols + 1) ndarray, optional
        Lowest heights that leave a wall at the figure's edge, mm; found if not given.

    Returns
    -------
    terms : Terms
    window : Window
        Where its lattice lies.
    """
    if edge is None:
        edge = wall(layers.mask, layers.pitch, carving.wall_angle, carving.depth)
    part, place = cropped(layers)
    return terms_of(part, carving, fitted, (_lowest(place.take(edge), carving.depth), 0.0)), place


def _give_up(
    terms: Terms, h: Floats, edge: Floats, carving: Carving, tolerance: float
) -> tuple[Floats, Descent]:
    """Solve again above what the finest tip leaves, until that is hardly anything.

    Where what the tip leaves lies above the heights it becomes their lower bound.
    """
    low, high = terms.bounds
    for _ in range(GIVEN_UP):
        reached = carved(h, terms.figure, edge, terms.pitch, carving)
        short = reached - np.maximum(h, edge) > SHALLOW * carving.depth
        low = np.where(short, np.maximum(low, np.minimum(reached, high)), low).astype(np.float32)
        terms = replace(terms, bounds=(low, high))
        h, descent = descend(
            terms, within(h, terms.bounds, terms.figure), tolerance=tolerance, most=STEPS
        )
        if not short.any():
            break
    return h, descent


def pyramid(layers: Layers) -> list[Layers]:
    """Halve layers until no coarser grid helps: the finest first."""
    lattices = [layers]
    while min(cropped(lattices[-1])[0].grid.shape) > COARSEST:
        lattices.append(halve(lattices[-1]))
    return lattices


def refitted(start: Solution, layers: Layers, carving: Carving) -> Solution:
    """Make a solution a start for another carving of the same figure: its fit is found afresh.

    From there the solver comes to what it comes to from nothing, within its tolerance.
    """
    return replace(start, fitted=fit(pyramid(layers)[-1], carving))


def solve_heights(
    layers: Layers,
    carving: Carving,
    edge: Floats,
    *,
    start: Solution | None = None,
    tolerance: float = 1e-2,
    progress: Progress = silent,
) -> Solution:
    """Minimise the energy, from coarse to fine.

    Parameters
    ----------
    layers : Layers
    carving : Carving
    edge : (rows + 1, cols + 1) ndarray
        Lowest heights that leave a wall at the figure's edge, mm.
    start : Solution, optional
        Of the same layers and about the same carving: its heights are the first
        guess, its fit is kept, and no coarser lattice is visited.
    tolerance : float
        On the projected gradient, relative to the flat panel's.
    progress : Progress

    Returns
    -------
    Solution
        Heights within the bounds, 0 outside the figure; without the wall at its edge.
    """
    lattices = [layers] if start else pyramid(layers)
    fitted = start.fitted if start else fit(lattices[-1], carving)
    above, figure = np.zeros(0), None
    for level in reversed(lattices):
        finest = level is layers
        terms, place = problem(level, carving, fitted, edge if finest else None)
        guess, shape = within(terms.form, terms.bounds, terms.figure), level.grid.node_shape
        if start:
            guess = within(place.take(start.heights), terms.bounds, terms.figure)
        elif figure is not None:
            finer = terms.form + place.take(refine(above, figure, shape))
            guess = within(finer, terms.bounds, terms.figure)
        solved, descent = descend(
            terms,
            guess,
            tolerance=tolerance if finest else max(tolerance, ROUGHLY),
            most=STEPS,
            report=progress if finest else silent,
        )
        above, figure = place.put(solved - terms.form, shape), place.put(terms.figure, shape)
        if finest and carving.reachable is not None:
            solved, descent = _give_up(terms, solved, place.take(edge), carving, tolerance)
    return Solution(**vars(descent), fitted=fitted, heights=place.put(solved, shape))
