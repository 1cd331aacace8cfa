"""A relief as it lies on a machine that turns it: its Y along X, its X round the axis.

Rows and columns change places, which keeps every triangle what it is; seen from outside
that is a mirror image, and `Stock.to_work` mirrors it back.
"""

from collections.abc import Sequence
from dataclasses import replace

from relieffab.grid import Grid
from relieffab.layers.model import Stroke
from relieffab.relief.model import Relief
from relieffab.stock import Stock


def laid(relief: Relief, stock: Stock) -> Relief:
    """Lay a relief on a round stock; on a flat one it stays as it is.

    Parameters
    ----------
    relief : Relief
        On the flat panel.
    stock : Stock
        As wide as the panel is high, and as high as that is wide.
    """
    if not stock.radius:
        return relief
    grid, (x, y) = relief.grid, relief.grid.origin
    place = (stock.width - y, stock.height - x)
    turned = Grid(grid.cols, grid.rows, grid.pitch, place)
    return Relief(turned, relief.heights.T.copy(), relief.mask.T.copy(), relief.depth)


def laid_strokes(strokes: Sequence[Stroke], stock: Stock) -> Sequence[Stroke]:
    """Lay strokes on a stock as `laid` lays their relief."""
    if not stock.radius:
        return strokes
    corner = (stock.width, stock.height)
    return [replace(stroke, points=corner - stroke.points[:, ::-1]) for stroke in strokes]
