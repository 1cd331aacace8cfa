"""What of a relief is cut, and where the cut runs out of the panel's sides."""

import numpy as np
from numpy.typing import NDArray

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
BESIDE = 1.0  # mm of level face beside a shaped stock's outline, frame and holes


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


def check_clear(below: NDArray[np.bool_], grid: Grid, stock: Stock, depth: float) -> None:
    """Refuse a cut that runs into what a stock with a shape has beside its face.

    Parameters
    ----------
    below : (rows + 1, cols + 1) ndarray of bool
        Nodes that are, or may be, cut.
    grid : Grid
    stock : Stock
    depth : float
        Of the relief, mm.

    Raises
    ------
    InputError
        Saying where the cut meets outline, frame or hole, or that a keyhole is under it.
    """
    if stock.plain:
        return
    x, y = grid.to_xy(*np.nonzero(below))
    bad = ~stock.on_face(x, y, BESIDE)
    if bad.any():
        bounds = "its frame and holes" if stock.frame else "its outline and holes"
        raise InputError(
            "the relief runs off the stock's face",
            expected=f"{BESIDE:g} mm or more from {bounds}",
            found=f"X {x[bad][0]:.2f} Y {y[bad][0]:.2f}, and {bad.mean():.1%} of the figure",
            hint="a larger --margin, a narrower --frame, or other --holes",
        )
    for key in stock.keyholes if len(x) else ():
        if key.depth + depth + BESIDE > stock.thickness:
            raise InputError(
                "the relief would break through to a keyhole",
                expected=f"a stock of {key.depth + depth + BESIDE:g} mm or more",
                found=f"{stock.thickness:g} mm",
                where="thickness",
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
    check_clear(relief.heights < -FACE_GRAIN, grid, stock, relief.depth)
    rim = THINNEST_RIM * grid.pitch
    far, near, left, right = (int(margin < rim) for margin in margins(grid, stock))
    origin = grid.to_xy(-float(far), -float(left))
    wider = Grid(grid.rows + far + near, grid.cols + left + right, grid.pitch, origin)
    heights = np.pad(relief.heights, ((far, near), (left, right)), mode="edge")
    heights[heights > -FACE_GRAIN] = 0.0
    return Sinking(wider, heights)
