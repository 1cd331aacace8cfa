"""From samples along a line to clean polylines: gaps, hysteresis, smoothing, simplification.

Lines are tables (n, 3) of X, Y (mm) and strength, sampled at even steps; lengths
are counted in samples.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]
Flags = NDArray[np.bool_]


def length(points: Floats) -> float:
    """Length of a line (n, 2 or more) as seen, mm."""
    return float(np.hypot(*np.diff(points[:, :2], axis=0).T).sum())


def runs(flags: Flags) -> tuple[Ints, Ints]:
    """First index of each stretch of True, and the index after its last."""
    padded = np.zeros(len(flags) + 2, bool)
    padded[1:-1] = flags
    change = np.flatnonzero(padded[1:] != padded[:-1])
    return change[::2], change[1::2]


def close_gaps(flags: Flags, longest: float, *, closed: bool = False) -> Flags:
    """Set stretches of False within that are no longer than `longest`.

    Parameters
    ----------
    flags : (n,) ndarray of bool
    longest : float
        Samples.
    closed : bool
        Whether the last sample is followed by the first.
    """
    if closed:
        return close_gaps(np.tile(flags, 3), longest)[len(flags) : 2 * len(flags)]
    out = flags.copy()
    for start, stop in zip(*runs(~flags), strict=True):
        if stop - start <= longest and start > 0 and stop < len(flags):
            out[start:stop] = True
    return out


def seam(flags: Flags) -> int:
    """Return the middle of the longest stretch of False of a closed line; 0 if there is none.

    Opened there, a line is cut the same wherever its numbering starts.
    """
    start, stop = runs(~np.tile(flags, 2))
    if len(start) == 0:
        return 0
    longest = int((stop - start).argmax())
    return int(start[longest] + stop[longest]) // 2 % len(flags)


def hysteresis(flags: Flags, strength: Floats, high: float) -> Flags:
    """Keep the stretches of flags whose strength reaches `high` somewhere."""
    out = np.zeros_like(flags)
    for start, stop in zip(*runs(flags), strict=True):
        out[start:stop] = strength[start:stop].max() >= high
    return out


def drop_short(flags: Flags, shortest: float) -> Flags:
    """Clear stretches of fewer than `shortest` samples."""
    out = flags.copy()
    for start, stop in zip(*runs(flags), strict=True):
        if stop - start < shortest:
            out[start:stop] = False
    return out


def narrowed(flags: Flags, by: int) -> Flags:
    """Clear `by` samples at both ends of each stretch of True within, and short stretches whole.

    Parameters
    ----------
    flags : (n,) ndarray of bool
    by : int
        Samples.
    """
    out = np.zeros_like(flags)
    for start, stop in zip(*runs(flags), strict=True):
        if stop - start > 2 * by:
            out[start + by * (start > 0) : stop - by * (stop < len(flags))] = True
    return out


def soften(table: Floats, sigma: float, *, closed: bool) -> Floats:
    """Smooth along a line with a Gaussian of `sigma` samples; ends stay where they are.

    Parameters
    ----------
    table : (n, k) ndarray
    sigma : float
        Samples.
    closed : bool
        Whether the last sample is followed by the first.
    """
    if sigma <= 0 or len(table) < 3:
        return table
    if closed:
        return ndimage.gaussian_filter1d(table, sigma, axis=0, mode="wrap")
    # Mirrored through its end points, so that the line neither shrinks nor bends there.
    pad = min(len(table) - 1, int(4 * sigma) + 1)
    before = 2 * table[0] - table[pad:0:-1]
    after = 2 * table[-1] - table[-2 : -pad - 2 : -1]
    longer = np.concatenate([before, table, after])
    return ndimage.gaussian_filter1d(longer, sigma, axis=0)[pad : pad + len(table)]


@kernel
def _mark(points, first, last, tolerance, keep):  # type: ignore[no-untyped-def]
    """Douglas-Peucker between two kept points, without recursion."""
    stack = [(first, last)]
    while stack:
        a, b = stack.pop()
        dx, dy = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1]
        length2 = dx * dx + dy * dy
        worst, at = tolerance, -1
        for i in range(a + 1, b):
            px, py = points[i, 0] - points[a, 0], points[i, 1] - points[a, 1]
            t = 0.0
            if length2 > 0.0:
                t = min(1.0, max(0.0, (px * dx + py * dy) / length2))
            off = np.hypot(px - t * dx, py - t * dy)
            if off > worst:
                worst, at = off, i
        if at >= 0:
            keep[at] = True
            stack.append((a, at))
            stack.append((at, b))


def simplify(table: Floats, tolerance: float, *, closed: bool) -> Floats:
    """Leave out samples as long as the line moves by no more than `tolerance` mm.

    Douglas and Peucker, "Algorithms for the reduction of the number of points",
    Cartographica 1973.

    Parameters
    ----------
    table : (n, k) ndarray
        X and Y first.
    tolerance : float
        mm.
    closed : bool
        Whether the last sample is followed by the first.
    """
    if closed:
        table = np.concatenate([table, table[:1]])
    points = np.ascontiguousarray(table[:, :2])
    keep = np.zeros(len(points), bool)
    keep[0] = keep[-1] = True
    _mark(points, 0, len(points) - 1, tolerance, keep)
    return table[:-1][keep[:-1]] if closed else table[keep]
