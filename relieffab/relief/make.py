"""Layers to Relief, by our own method or one of the classic ones."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.layers.model import Layers
from relieffab.progress import Progress, silent
from relieffab.relief.classic.methods import METHODS
from relieffab.relief.edge import wall
from relieffab.relief.foot import carved
from relieffab.relief.level import sunk
from relieffab.relief.model import Relief, nodes_of
from relieffab.relief.names import LINES, SUNKEN
from relieffab.relief.reach import carvable
from relieffab.relief.solve import Solution, solve_heights
from relieffab.relief.targets import Carving

Floats = NDArray[np.float64]

BEYOND = 2.0  # mm from the outline that its groove may take when lines alone are carved


def finish(heights: Floats, layers: Layers, carving: Carving, edge: Floats) -> Relief:
    """Bring the highest point to the face, put the wall at the edge, fill what no tip reaches.

    Parameters
    ----------
    heights : (rows + 1, cols + 1) ndarray
        mm, 0 outside the figure.
    layers : Layers
    carving : Carving
    edge : (rows + 1, cols + 1) ndarray
        Lowest heights that leave a wall, from `edge.wall`, mm.

    Returns
    -------
    Relief
    """
    figure = nodes_of(layers.mask)
    raised = heights - heights[figure].max()
    left = carved(raised, figure, edge, layers.pitch, carving)
    if carving.reachable is not None:
        left = np.minimum(carvable(left, layers.pitch, carving.reachable), 0.0)
    return Relief(layers.grid, left, layers.mask, carving.depth)


def drawing(layers: Layers) -> Layers:
    """Widen the figure beyond its outline, so that the outline's groove is cut whole."""
    away = ndimage.distance_transform_edt(~layers.mask) * layers.pitch
    return replace(layers, mask=away <= BEYOND)


def make_relief(
    layers: Layers,
    carving: Carving | None = None,
    *,
    start: Solution | None = None,
    tolerance: float = 1e-2,
    progress: Progress = silent,
) -> tuple[Relief, Solution | None]:
    """Turn three aligned images into one height field within its bounds.

    Parameters
    ----------
    layers : Layers
    carving : Carving, optional
    start : Solution, optional
        Of the same layers and about the same carving, to go on from.
    tolerance : float
        On the projected gradient, relative to the flat panel's.
    progress : Progress

    Returns
    -------
    relief : Relief
        -depth <= h <= 0 exactly, 0 outside the figure, its highest point at 0.
    solution : Solution or None
        None where a classic method made it, or the figure is level.
    """
    carving = carving or Carving()
    if layers.level:
        return sunk(layers, carving), None
    if carving.carve == LINES:
        layers = drawing(layers)
    edge = wall(layers.mask, layers.pitch, carving.wall_angle, carving.depth)
    if carving.method != SUNKEN:
        return finish(METHODS[carving.method](layers, carving.depth), layers, carving, edge), None
    solution = solve_heights(
        layers, carving, edge, start=start, tolerance=tolerance, progress=progress
    )
    return finish(solution.heights, layers, carving, edge), solution
