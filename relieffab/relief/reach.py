"""What a cutter of revolution leaves of a surface: the morphological closing by its tip."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relieffab.compiled import parallel_kernel, prange

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Profile = Callable[[ArrayLike], Floats]
Leaves = Callable[[Floats, float], Floats]
"""Heights at nodes and their pitch, mm, to what a cutter leaves of them: see `carvable`."""

NEAR = 0.02  # mm above a relief that its finest cutter need not come any nearer

TALL, WIDE = 8, 64  # nodes of a tile: its rows are long enough for vector instructions
TURN = 32  # offsets after which a tile's lowest node is found anew


def ball(radius: float) -> Profile:
    """Profile of a ball: height above its lowest point over the distance from its axis.

    Parameters
    ----------
    radius : float
        mm.
    """

    def height(r: ArrayLike) -> Floats:
        under = radius**2 - np.asarray(r, float) ** 2
        return np.where(under >= 0, radius - np.sqrt(np.maximum(under, 0.0)), np.inf)

    return height


def tip(profile: Profile, pitch: float, depth: float, widest: int) -> tuple[Ints, Floats]:
    """Sample the part of a cutter that can matter on a lattice.

    What stands more than the relief's depth above the lowest point touches nothing
    before that point does.

    Parameters
    ----------
    profile : callable
        Distance from the axis to height above the lowest point, mm; infinite beyond
        the cutter.
    pitch : float
        mm.
    depth : float
        Of the relief, mm.
    widest : int
        Nodes from the axis beyond which there is no surface.

    Returns
    -------
    offsets : (n, 2) ndarray of int
        Rows and columns from the axis, the lowest first, without the axis itself.
    drop : (n,) ndarray
        Height of the cutter there, mm.
    """
    reach = int(np.flatnonzero(profile(np.arange(widest + 1) * pitch) <= depth)[-1])
    side = np.arange(-reach, reach + 1)
    away = np.hypot(side[:, None], side)
    height = np.asarray(profile(away * pitch))
    counts = (height <= depth) & (away > 0)
    order = np.lexsort((away[counts], height[counts]))
    return np.argwhere(counts)[order] - reach, height[counts][order]


@parallel_kernel
def _highest(field, reach, offsets, drop, out):  # type: ignore[no-untyped-def]
    """out[i, j] = max over offsets of field[i + reach + di, j + reach + dj] - drop.

    `field` is `out` with `reach` nodes more on each side, and `out` holds its own
    values to begin with.  Offsets come the lowest drop first, so a tile is done when
    the highest node in its reach could no longer raise its lowest.
    """
    rows, cols = out.shape
    bands = (rows + TALL - 1) // TALL
    for band in prange(bands):
        top, bottom = band * TALL, min(rows, band * TALL + TALL)
        for left in range(0, cols, WIDE):
            right = min(cols, left + WIDE)
            most = -np.inf
            for i in range(top, bottom + 2 * reach):
                for j in range(left, right + 2 * reach):
                    most = max(most, field[i, j])
            least = -np.inf
            for k in range(len(drop)):
                if k % TURN == 0:
                    least = np.inf
                    for i in range(top, bottom):
                        for j in range(left, right):
                            least = min(least, out[i, j])
                if most - drop[k] <= least:
                    break
                down, across, low = reach + offsets[k, 0], reach + offsets[k, 1], drop[k]
                for i in range(top, bottom):
                    source = field[i + down, left + across : right + across]
                    target = out[i, left:right]
                    for j in range(len(target)):
                        target[j] = max(target[j], source[j] - low)


def sunken_box(heights: Floats) -> tuple[slice, slice]:
    """Rows and columns that hold all below 0, of which there is some."""
    rows, cols = (np.nonzero((heights < 0).any(axis=axis))[0] for axis in (1, 0))
    return slice(rows[0], rows[-1] + 1), slice(cols[0], cols[-1] + 1)


def _lowered(
    heights: Floats, pitch: float, profile: Profile
) -> tuple[tuple[slice, slice], Ints, Floats, Floats] | None:
    """Lower a cutter onto all that lies below 0; None if nothing does, or it is too narrow.

    Returns
    -------
    box : tuple of slice
        What lies below 0.
    offsets, drop : ndarray
        From `tip`.
    lowest : ndarray
        Heights of the tip in the box, mm.
    """
    if not (heights < 0).any():
        return None
    box = sunken_box(heights)
    lowest = np.array(heights[box], dtype=np.float64, order="C")
    offsets, drop = tip(profile, pitch, -float(lowest.min()), max(lowest.shape))
    if not len(drop):
        return None
    reach = int(offsets.max())
    _highest(np.pad(lowest, reach), reach, offsets, drop, lowest)
    return box, offsets, drop, lowest


def lowest_tips(heights: Floats, pitch: float, profile: Profile) -> Floats:
    """Find the lowest places of a cutter over a surface: max over s of h(s) - c(|s - x|).

    Parameters are those of `closing`.

    Returns
    -------
    (rows, cols) ndarray
        Heights of the tip at the nodes, mm; nowhere below the heights.
    """
    found = _lowered(heights, pitch, profile)
    if found is None:
        return heights
    box, _, _, lowest = found
    out = heights.copy()
    out[box] = lowest
    return out


def closing(heights: Floats, pitch: float, profile: Profile) -> Floats:
    """Fill what a cutter lowered onto a surface at every node does not reach.

    The lowest places its tip may stand are max over s of h(s) - c(|s - x|), and
    what it leaves is the least of tip(x) + c(|s - x|), at the nodes.

    Parameters
    ----------
    heights : (rows, cols) ndarray
        At nodes, mm, none above 0; the panel's face at 0 goes on beyond them.
    pitch : float
        Distance of the nodes, mm.
    profile : callable
        Distance from the axis to height above the lowest point, mm, as
        `Cutter.profile` and `ball` give it: growing, infinite beyond the cutter.

    Returns
    -------
    (rows, cols) ndarray
        mm; nowhere below the heights nor above 0, and `heights` itself where the
        cutter is narrower than the lattice.
    """
    found = _lowered(heights, pitch, profile)
    if found is None:
        return heights
    box, offsets, drop, lowest = found
    reach, left = int(offsets.max()), -lowest
    _highest(np.pad(left, reach), reach, offsets, drop, left)
    out = heights.copy()
    out[box] = np.maximum(-left, heights[box])
    return out


def carvable(heights: Floats, pitch: float, leaves: Leaves) -> Floats:
    """Raise a surface until a cutter comes near enough to all of it.

    What a cutter leaves is round in every valley.  Of that the nodes are kept, and
    between the triangles through them the cutter stays a little higher again: each
    round widens the narrowest valleys by a part of a pixel, until none is too narrow.

    Parameters
    ----------
    heights : (rows, cols) ndarray
        At nodes, mm, none above 0.
    pitch : float
        mm.
    leaves : callable
        What the cutter leaves of heights at nodes, given those and the pitch: nowhere
        below them nor above 0.

    Returns
    -------
    (rows, cols) ndarray
        mm; nowhere below the heights nor above 0, and what the cutter leaves of it is
        at most `NEAR` above it.
    """
    # Every round but the last raises some node by more than `NEAR`, and none above 0.
    while (left := leaves(heights, pitch) - heights).max() > NEAR:
        heights = heights + left
    return heights
