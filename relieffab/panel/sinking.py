"""What of a relief is cut, and where the cut runs out of the panel's sides."""

import numpy as np

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.panel.model import Sinking
from relieffab.relief.model import Relief
from relieffab.stock import Stock

# A nanometre: shallower than this is the face itself.
FACE_GRAIN = 1e-6
# A rim narrower than this many pixels is no wall: the cut opens at that side.
THINNEST_RIM = 0.75
ROUNDING = 1e-6


def margins(grid: Grid, stock: Stock) -> tuple[float, float, float, float]:
    """Give the stock's rim around the grid: far, near, left, right, mm."""
    x0, y0 = grid.origin
    x1, y1 = grid.to_xy(grid.rows, grid.cols)
    return stock.height - y0, y1, x0, stock.width - x1


def check(relief: Relief, stock: Stock) -> None:
    """Refuse a relief that the stock cannot hold.

    Raises
    ------
    InputError
        If the relief is as deep as the stock is thick, or reaches beyond it.
    """
    if relief.depth >= stock.thickness:
        raise InputError(
            "the relief would cut through the stock",
            expected=f"a depth less than the stock's thickness, {stock.thickness:g} mm",
            found=f"{relief.depth:g} mm",
            hint="a smaller depth or thicker stock",
        )
    overhang = -min(margins(relief.grid, stock))
    if overhang > ROUNDING:
        width, height = (n * relief.grid.pitch for n in reversed(relief.grid.shape))
        raise InputError(
            "the relief reaches beyond the stock",
            expected=f"within {stock.width:g} x {stock.height:g} mm",
            found=f"{width:g} x {height:g} mm, {overhang:g} mm over the edge",
            hint="a smaller relief, larger stock, or another place on it",
        )


def sink(relief: Relief, stock: Stock) -> Sinking:
    """Find what of a relief lies below the face.

    Where the relief is below the face on the grid's border, the cut ends in a
    vertical wall there; where the stock goes on for less than three quarters of
    a pixel, it runs out through the stock's side instead, since so thin a wall
    cannot stand.

    Parameters
    ----------
    relief : Relief
    stock : Stock

    Returns
    -------
    Sinking
        On a grid widened by one pixel at the sides that open.

    Raises
    ------
    InputError
        If the stock cannot hold the relief.
    """
    check(relief, stock)
    grid = relief.grid
    rim = THINNEST_RIM * grid.pitch
    far, near, left, right = (int(margin < rim) for margin in margins(grid, stock))
    origin = grid.to_xy(-float(far), -float(left))
    wider = Grid(grid.rows + far + near, grid.cols + left + right, grid.pitch, origin)
    heights = np.pad(relief.heights, ((far, near), (left, right)), mode="edge")
    heights[heights > -FACE_GRAIN] = 0.0
    return Sinking(wider, heights)
