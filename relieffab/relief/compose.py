"""Several reliefs on one panel, each at its place."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.model import Floats, Relief, nodes_of

MOST = 16384  # pixels each way
ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class Placed:
    """A relief at a place.

    Parameters
    ----------
    relief : Relief
    at : tuple of float
        Where the X0 Y0 of its own panel comes to lie on the new one, mm.
    name : str
        As a message would name it.
    """

    relief: Relief
    at: tuple[float, float]
    name: str

    @property
    def grid(self) -> Grid:
        """Its grid on the new panel."""
        grid = self.relief.grid
        x, y = grid.origin
        return Grid(grid.rows, grid.cols, grid.pitch, (x + self.at[0], y + self.at[1]))


def fitted_round(parts: Sequence[Placed], around: float) -> tuple[list[Placed], float]:
    """Shrink reliefs so that a whole number of the finest one's pixels goes round.

    By less than a pixel in the way round; each is moved to the nearest pixel, so that the
    nodes of the finest, and of all of its pitch, are taken over as they are.

    Parameters
    ----------
    parts : sequence of Placed
    around : float
        mm.

    Returns
    -------
    list of Placed
    float
        The scale, 1 or a little less.
    """
    finest = min((part.grid.pitch for part in parts), default=around)
    pitch = around / ceil(around / finest - ROUNDING)
    scale = pitch / finest
    fitted = []
    for part in parts:
        grid, (x, y) = part.relief.grid, part.relief.grid.origin
        small = Grid(grid.rows, grid.cols, grid.pitch * scale, (x * scale, y * scale))
        relief = replace(part.relief, grid=small)
        low_x, low_y = Placed(relief, part.at, part.name).grid.to_xy(grid.rows, 0)
        left, near = round(low_x / pitch) * pitch, ceil(low_y / pitch - 0.5) * pitch
        near = near if low_y < 0 else max(near, 0.0)
        at = (part.at[0] + left - low_x, part.at[1] + near - low_y)
        fitted.append(Placed(relief, at, part.name))
    return fitted, scale


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


def _sampled(part: Placed, grid: Grid) -> tuple[Floats, NDArray[np.bool_]]:
    """Take a relief's surface at another grid's nodes, and its figure at the pixels."""
    x, y = grid.node_axes()
    dx, dy = part.at
    heights = part.relief.height_at(x[None, :] - dx, y[:, None] - dy)
    row, col = part.grid.to_index(x[:-1] + grid.pitch / 2, y[:-1] - grid.pitch / 2)
    i, j = np.floor(row + ROUNDING).astype(int), np.floor(col + ROUNDING).astype(int)
    rows, cols = part.grid.shape
    known = ((i >= 0) & (i < rows))[:, None] & ((j >= 0) & (j < cols))[None, :]
    mask = known & part.relief.mask[np.clip(i, 0, rows - 1)][:, np.clip(j, 0, cols - 1)]
    # A node on a wall may lie just outside all pixels whose centres are in the figure.
    lone = (heights < 0) & ~nodes_of(mask)
    mask |= lone[:-1, :-1] | lone[:-1, 1:] | lone[1:, :-1] | lone[1:, 1:]
    return heights, mask


def _round_samples(part: Placed, grid: Grid) -> tuple[Floats, NDArray[np.bool_]]:
    """Take a relief's surface and figure where the panel's left and right edge meet."""
    around = grid.cols * grid.pitch
    x = part.grid.origin[0]
    turns = floor(x / around + ROUNDING)
    heights, mask = np.zeros(grid.node_shape), np.zeros(grid.shape, bool)
    for turn in (turns, turns + 1):
        moved = replace(part, at=(part.at[0] - turn * around, part.at[1]))
        found, inside = _sampled(moved, grid)
        np.minimum(heights, found, out=heights)
        mask |= inside
    heights[:, 0] = heights[:, -1] = np.minimum(heights[:, 0], heights[:, -1])
    return heights, mask


def _nodes(mask: NDArray[np.bool_], *, joined: bool) -> NDArray[np.bool_]:
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
    heights, owner = np.zeros(grid.node_shape), np.full(grid.shape, -1)
    for k, part in enumerate(parts):
        found, mask = _round_samples(part, grid) if joined else _sampled(part, grid)
        both = _nodes(mask, joined=joined) & _nodes(owner >= 0, joined=joined)
        if both.any():
            i, j = np.argwhere(both)[0]
            x, y = grid.to_xy(int(i), int(j))
            others = {parts[n].name for n in np.unique(owner[mask & (owner >= 0)])}
            raise InputError(
                f"{part.name} overlaps {' and '.join(sorted(others)) or 'its neighbour'}",
                expected="figures that do not touch",
                found=f"both at X {x:.2f} Y {y:.2f}",
                hint="places further apart",
            )
        heights += found
        owner[mask] = k
    return Relief(grid, heights, owner >= 0, max(part.relief.depth for part in parts))
