"""Whether the field is sound: still outside the figure, within bounds, without a ripple."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.relief.quality.pair import Pair
from relieffab.relief.quality.use import inner_nodes

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Border:
    """Faults of the height field.

    Parameters
    ----------
    outside : float
        Largest |h| at nodes none of whose pixels is in M, mm; 0 is right.
    beyond : float
        How far heights pass either bound, mm; 0 is right.
    checkerboard : float
        |<h, c>| / (|h| |c|) with c = (-1)^(row + column), over the nodes inside the
        figure, the mean taken off h: 1 for a checkerboard, near 0 for a surface.
    twist : float
        The same found node by node, so that patches out of step do not cancel:
        root mean square of the stencil [1 -2 1] both ways, over 16, at nodes whose
        neighbours are all inside, over that of h.
    """

    outside: float
    beyond: float
    checkerboard: float
    twist: float


def touching(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Nodes any of whose pixels is in the figure, (rows + 1, cols + 1)."""
    wide = np.pad(mask, 1)
    return wide[:-1, :-1] | wide[:-1, 1:] | wide[1:, :-1] | wide[1:, 1:]


def ripple(heights: Floats) -> Floats:
    """Checkerboard about each inner node, of unit gain, (rows - 1, cols - 1)."""
    down = heights[:-2] - 2 * heights[1:-1] + heights[2:]
    return (down[:, :-2] - 2 * down[:, 1:-1] + down[:, 2:]) / 16.0


def border(pair: Pair) -> Border:
    """Look for faults of the height field."""
    h, mask = pair.relief.heights, pair.layers.mask
    outside = h[~touching(mask)]
    inside = inner_nodes(mask)
    i, j = np.nonzero(inside)
    level = h[inside] - h[inside].mean() if len(i) else np.zeros(0)
    size = float(np.sqrt((level**2).sum()))
    board = twist = 0.0
    if size > 1e-12:
        board = float(abs((level * (1 - 2 * ((i + j) % 2))).sum()) / size / np.sqrt(len(i)))
        whole = ndimage.binary_erosion(inside, np.ones((3, 3), bool))
        local = ripple(h)[whole[1:-1, 1:-1]]
        twist = float(np.sqrt((local**2).mean()) * np.sqrt(len(i)) / size) if local.size else 0.0
    return Border(
        outside=float(np.abs(outside).max(initial=0.0)),
        beyond=float(max(h.max(), -pair.relief.depth - h.min(), 0.0)),
        checkerboard=board,
        twist=twist,
    )
