"""Several reliefs on one panel, each at its place."""

from collections.abc import Sequence
from dataclasses import replace
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.edge import wall
from relieffab.relief.model import Floats, Relief, nodes_of, sunk_pixels
from relieffab.relief.placed import ROUNDING, Placed

Bools = NDArray[np.bool_]

MOST = 16384  # pixels each way


def _common(parts: Sequence[Placed], size: tuple[float, float], *, joined: bool) -> Grid:
    """Cover the panel by pixels of the finest relief's pitch, in step with its nodes.

    Where its edges join, a whole number of pixels goes round.
    """
    finest = min((part.grid for part in parts), key=lambda grid: grid.pitch)
    pitch = finest.pitch
    if joined:
        cols = ceil(size[0] / pitch - ROUNDING)
        pitch = size[0] / cols
        rows = floor(size[1] / pitch + ROUNDING)
        return _checked(Grid(rows, cols, pitch, (0.0, rows * pitch)))
    left, near = (int(np.floor(v / pitch + ROUNDING)) for v in finest.to_xy(finest.rows, 0))
    x1, y1 = finest.to_xy(0, finest.cols)
    right, far = (int(np.floor(v / pitch + ROUNDING)) for v in (size[0] - x1, size[1] - y1))
    rows, cols = finest.rows + near + far, finest.cols + left + right
    return _checked(Grid(rows, cols, pitch, finest.to_xy(-far, -left)))


def _checked(grid: Grid) -> Grid:
    if max(grid.shape) > MOST:
        raise InputError(
            "the panel would have too many pixels",
            expected=f"at most {MOST} each way",
            found=f"{grid.cols} x {grid.rows} of the finest relief's {grid.pitch:g} mm",
            hint="reliefs of a coarser --resolution",
        )
    return grid


def _check_inside(part: Placed, size: tuple[float, float], *, joined: bool) -> None:
    grid = part.grid
    (x0, y0), (x1, y1) = grid.to_xy(grid.rows, 0), grid.to_xy(0, grid.cols)
    if joined:
        x0, x1 = 0.0, x1 - x0
    if min(x0, y0) < -ROUNDING or x1 > size[0] + ROUNDING or y1 > size[1] + ROUNDING:
        raise InputError(
            f"{part.name} reaches beyond the panel",
            expected=f"X 0 to {size[0]:g}, Y 0 to {size[1]:g} mm",
            found=f"X {x0:g} to {x1:g}, Y {y0:g} to {y1:g} mm",
            hint="another place, or a larger --size",
        )


def _seen(part: Placed, grid: Grid, *, joined: bool) -> list[Placed]:
    """Give a part at each place where the panel shows some of it: two, where its edges join."""
    if not joined:
        return [part]
    around = grid.cols * grid.pitch
    turns = floor(part.grid.origin[0] / around + ROUNDING)
    return [
        replace(part, at=(part.at[0] - turn * around, part.at[1])) for turn in (turns, turns + 1)
    ]


def _samples(part: Placed, grid: Grid, *, joined: bool) -> tuple[Floats, Bools]:
    """Take a relief's surface at another grid's nodes, and its figure at the pixels."""
    heights, mask = np.zeros(grid.node_shape), np.zeros(grid.shape, bool)
    for seen in _seen(part, grid, joined=joined):
        found, inside = _sampled(seen, grid)
        np.minimum(heights, found, out=heights)
        mask |= inside
    if joined:
        heights[:, 0] = heights[:, -1] = np.minimum(heights[:, 0], heights[:, -1])
    return heights, mask


def _sampled(part: Placed, grid: Grid) -> tuple[Floats, Bools]:
    x, y = grid.node_axes()
    dx, dy = part.at
    heights = part.relief.height_at(x[None, :] - dx, y[:, None] - dy)
    row, col = part.grid.to_index(x[:-1] + grid.pitch / 2, y[:-1] - grid.pitch / 2)
    i, j = np.floor(row + ROUNDING).astype(int), np.floor(col + ROUNDING).astype(int)
    rows, cols = part.grid.shape
    known = ((i >= 0) & (i < rows))[:, None] & ((j >= 0) & (j < cols))[None, :]
    mask = known & part.relief.mask[np.clip(i, 0, rows - 1)][:, np.clip(j, 0, cols - 1)]
    # A node on a wall may lie just outside all pixels whose centres are in the figure.
    return heights, sunk_pixels(heights, mask)


def _nodes(mask: Bools, *, joined: bool) -> Bools:
    nodes = nodes_of(mask)
    if joined:
        nodes[:, 0] = nodes[:, -1] = nodes[:, 0] | nodes[:, -1]
    return nodes


def compose(parts: Sequence[Placed], size: tuple[float, float], *, joined: bool = False) -> Relief:
    """Lay reliefs out on one panel.

    The new relief has the pitch of the finest, and its nodes are in step with
    that one's: it, and all of its pitch that are whole pixels away from it, are
    taken over exactly.  Others are sampled on their own triangles; where edges join, all are.

    Parameters
    ----------
    parts : sequence of Placed
    size : tuple of float
        The panel's X and Y, mm.
    joined : bool, optional
        Whether its left and right edge meet: then X counts on round, and a relief may lie
        across the seam.

    Returns
    -------
    Relief
        As deep as the deepest.

    Raises
    ------
    InputError
        If there is none, one reaches beyond the panel, or two overlap.
    """
    if not parts:
        raise InputError("there is no relief to lay out", expected="one or more")
    for part in parts:
        _check_inside(part, size, joined=joined)
    grid = _common(parts, size, joined=joined)
    heights, figure = np.zeros(grid.node_shape), np.zeros(grid.shape, bool)
    for k, part in enumerate(parts):
        found, mask = _samples(part, grid, joined=joined)
        both = _nodes(mask, joined=joined) & _nodes(figure, joined=joined)
        if both.any():
            raise _overlap(part, parts[:k], grid, both, joined=joined)
        heights += found
        figure |= mask
    return Relief(grid, heights, figure, max(part.relief.depth for part in parts))


def walls_of(relief: Relief, wall_angle: float) -> Relief:
    """Give the lowest heights that leave a relief's walls, as a surface of its own.

    Parameters
    ----------
    relief : Relief
    wall_angle : float
        That it was carved with, degrees.

    Returns
    -------
    Relief
        Of the same grid and figure; walls go on down to where they meet, for the panel
        it becomes a part of may be deeper.
    """
    edge = wall(relief.mask, relief.grid.pitch, wall_angle, relief.depth)
    return replace(relief, heights=edge, depth=max(relief.depth, -float(edge.min())))


def laid_out(parts: Sequence[Placed], grid: Grid, *, joined: bool = False) -> Floats:
    """Lay out what belongs to the reliefs of `compose`, in the same places.

    Parameters
    ----------
    parts : sequence of Placed
        Their walls, say, or the reliefs with their marks.
    grid : Grid
        Of what `compose` gave.
    joined : bool, optional
        As there.

    Returns
    -------
    (rows + 1, cols + 1) ndarray
        mm.

    Raises
    ------
    InputError
        If two of them are sunk at one place.
    """
    heights = np.zeros(grid.node_shape)
    for k, part in enumerate(parts):
        found, _ = _samples(part, grid, joined=joined)
        both = (found < 0) & (heights < 0)
        if both.any():
            raise _overlap(part, parts[:k], grid, both, joined=joined)
        heights += found
    return heights


def _reaches(part: Placed, x: float, y: float) -> bool:
    """Whether a relief is sunk at a place, or its figure within a pixel of it."""
    i, j = (int(np.floor(k)) for k in part.grid.to_index(x, y))
    near = part.relief.mask[max(i - 1, 0) : max(i + 2, 0), max(j - 1, 0) : max(j + 2, 0)]
    return bool(near.any() or part.relief.height_at(x - part.at[0], y - part.at[1]) < 0)


def _overlap(
    part: Placed, others: Sequence[Placed], grid: Grid, both: Bools, *, joined: bool
) -> InputError:
    """Say where a relief meets others at nodes."""
    i, j = np.argwhere(both)[0]
    x, y = (float(v) for v in grid.to_xy(int(i), int(j)))
    met = [
        one.name
        for one in others
        if any(_reaches(seen, x, y) for seen in _seen(one, grid, joined=joined))
    ]
    return InputError(
        f"{part.name} overlaps {' and '.join(met) or 'its neighbour'}",
        expected="figures that do not touch, nor the pecked ground of another",
        found=f"both at X {x:.2f} Y {y:.2f}",
        hint="places further apart",
    )
