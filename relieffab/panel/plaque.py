"""The raised plaque: the same figure, standing out of a level ground.

A sunken figure lies in a pit: along its outline stands a wall, which on a plaque
would be a ridge.  So what the wall covers is continued from the figure beside it,
and the plaque falls to its ground by the same wall turned upside down.
"""

from dataclasses import replace
from math import ceil

import numpy as np
from scipy import ndimage

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.panel.blank import make_blank
from relieffab.panel.carve import make_panel
from relieffab.panel.model import Floats, Panel
from relieffab.panel.sinking import check, check_clear, margins
from relieffab.panel.solid import checked, manifold_of, panel_of
from relieffab.progress import Progress, silent
from relieffab.relief.edge import wall
from relieffab.relief.model import Relief, nodes_of
from relieffab.stock import Stock

# Of the depth: what is no higher than this above the wall's own height is the wall.
SLACK = 0.01
# Pixels that the wall's foot is rounded, and from a floor to what counts as a trench.
FOOT, TRENCH = 1.5, 4.0
EVEN = 1.5  # pixels over which what was continued is evened out
BEYOND = 1.0  # mm that the stock is taller, so that it only cuts sides
ROUNDING = 1e-6


def _edge(relief: Relief, walls: float | Floats) -> Floats:
    """Give the lowest heights that leave the walls."""
    if isinstance(walls, np.ndarray):
        return walls
    return wall(relief.mask, relief.grid.pitch, walls, relief.depth)


def freed(relief: Relief, walls: float | Floats) -> Floats:
    """Give the figure's heights as if no wall stood at its edge.

    Parameters
    ----------
    relief : Relief
    walls : float or (rows + 1, cols + 1) ndarray
        That it was carved with: their angle, degrees; or, where figures have walls of
        their own, the lowest heights at the nodes that leave them, mm.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        mm.  Nodes on the wall continue the nearest ones that are not; in a trench
        too narrow for a floor, those at its bottom.
    """
    h, figure, edge = relief.heights, nodes_of(relief.mask), _edge(relief, walls)
    walled = figure & (h <= edge + SLACK * relief.depth)
    if not walled.any():
        return h
    floor = figure & (ndimage.distance_transform_edt(~walled) > FOOT)
    lowest = ndimage.minimum_filter(np.where(figure, h, np.inf), 3)
    trench = (edge < 0) & (h <= lowest) & (ndimage.distance_transform_edt(~floor) > TRENCH)
    sound = floor | trench
    nearest = ndimage.distance_transform_edt(~sound, return_distances=False, return_indices=True)
    found = np.where(figure, h[tuple(nearest)], 0.0)
    # Nearest nodes change abruptly along a wall: even that out, sound nodes staying.
    weight = np.maximum(ndimage.gaussian_filter(figure.astype(float), EVEN), 1e-9)
    for _ in range(3):
        even = ndimage.gaussian_filter(found, EVEN) / weight
        found = np.where(figure & ~sound, even, found)
    return np.clip(found, -relief.depth, 0.0)


def raised(relief: Relief, walls: float | Floats = 80.0) -> Relief:
    """Stand the figure of a sunken relief on a level ground.

    Parameters
    ----------
    relief : Relief
    walls : float or ndarray, optional
        As in `freed`.

    Returns
    -------
    Relief
        At -depth outside the figure and along its edge; inside, the same heights,
        0 the highest, but for the slope down to the ground.
    """
    heights = np.minimum(freed(relief, walls), -relief.depth - _edge(relief, walls))
    heights = np.where(nodes_of(relief.mask), heights, -relief.depth)
    return Relief(relief.grid, heights, relief.mask, relief.depth)


def _widened(relief: Relief, stock: Stock) -> tuple[Relief, tuple[float, float]]:
    """Continue the ground over the whole stock, and say where its near left corner comes."""
    grid = relief.grid
    far, near, left, right = (
        max(0, ceil(margin / grid.pitch - ROUNDING)) for margin in margins(grid, stock)
    )
    rows, cols = grid.rows + far + near, grid.cols + left + right
    pads = ((far, near), (left, right))
    wide = Relief(
        Grid(rows, cols, grid.pitch, (0.0, rows * grid.pitch)),
        np.pad(relief.heights, pads, constant_values=-relief.depth),
        np.pad(relief.mask, pads),
        relief.depth,
    )
    return wide, grid.to_xy(grid.rows + near, -left)


def make_plaque(
    relief: Relief,
    stock: Stock,
    *,
    walls: float | Floats = 80.0,
    tolerance: float = 0.02,
    progress: Progress = silent,
) -> Panel:
    """Make the raised plaque of a sunken relief.

    Parameters
    ----------
    relief : Relief
    stock : Stock
        The base: the figure rises from it by up to the relief's depth.
    walls : float or (rows + 1, cols + 1) ndarray, optional
        That the relief was carved with, as in `freed`; the plaque's are the same.
    tolerance : float, optional
        Largest vertical distance from `raised` at any node and pixel centre, mm.
    progress : Progress, optional

    Returns
    -------
    Panel
        Z0 is where a figure that uses all its depth is highest; the ground lies
        at -depth, the bottom below it by the stock's thickness.

    Raises
    ------
    InputError
        If the relief reaches beyond the stock, the stock has a frame or countersinks,
        or the tolerance is no length.
    """
    if stock.frame or any(hole.countersink for hole in stock.holes):
        raise InputError(
            "a plaque has no frame and no countersinks", hint="plain --holes, or keyholes"
        )
    whole = replace(stock, thickness=stock.thickness + relief.depth)
    check(relief, whole)
    check_clear(nodes_of(relief.mask), relief.grid, stock, 0.0)
    wide, (x, y) = _widened(raised(relief, walls), stock)
    rows, cols = wide.grid.shape
    block = Stock(cols * wide.grid.pitch, rows * wide.grid.pitch, whole.thickness)
    panel = make_panel(wide, block, tolerance=tolerance, progress=progress)
    tall = make_blank(replace(whole, thickness=whole.thickness + 2 * BEYOND))
    sides = manifold_of(tall.vertices, tall.faces, "the stock").translate((0.0, 0.0, BEYOND))
    solid = manifold_of(panel.vertices, panel.faces, "the plaque").translate((x, y, 0.0))
    return panel_of(checked(solid ^ sides, "the trimmed plaque"), panel.max_error_mm)
