"""What a cutter leaves standing: the stock's height at the relief's nodes."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.cutter import Cutter
from relieffab.grid import Grid
from relieffab.toolpath.outline import bulge_of, height_at, outline_of, radius_at
from relieffab.toolpath.trace import Trace

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_END = 40
_BITE = 0.001
_SAG = 0.002


@kernel
def _span(x, y, i, pitch, reach, cols):  # type: ignore[no-untyped-def]
    """First and last node of a row that the cutter at a place may touch."""
    dy = i * pitch - y
    half = sqrt(max(reach * reach - dy * dy, 0.0))
    left = max(int(np.ceil((x - half) / pitch)), 0)
    return left, min(int(np.floor((x + half) / pitch)), cols - 1)


@kernel
def _place(stock, x, y, z, pitch, outline, bulge):  # type: ignore[no-untyped-def]
    """Set the cutter on one place and take off the nodes what it takes; give the most."""
    rows, cols = stock.shape
    reach = radius_at(outline, -z)
    low = max(int(np.ceil((y - reach) / pitch)), 0)
    high = min(int(np.floor((y + reach) / pitch)), rows - 1)
    most = 0.0
    for i in range(low, high + 1):
        left, right = _span(x, y, i, pitch, reach, cols)
        row, aside = stock[i], (i * pitch - y) ** 2
        for j in range(left, right + 1):
            square = (j * pitch - x) ** 2 + aside
            if row[j] > z + bulge * square:
                height = z + height_at(outline, min(sqrt(square), reach))
                if height < row[j]:
                    most = max(most, row[j] - height)
                    row[j] = height
    return most


@kernel
def _bites(stock, x, y, z, pitch, outline, bulge, enough, seen):  # type: ignore[no-untyped-def]
    """Whether the cutter at a place would take more than `enough` off a node.

    `seen` is the node where the place before would have, and becomes this one's: it
    is looked at first, then the rows from the one under the axis outwards.
    """
    rows, cols = stock.shape
    reach = radius_at(outline, -z)
    i, j = seen
    if i >= 0:
        square = (j * pitch - x) ** 2 + (i * pitch - y) ** 2
        if square <= reach * reach and stock[i, j] - z - height_at(outline, sqrt(square)) > enough:
            return True
    low = max(int(np.ceil((y - reach) / pitch)), 0)
    high = min(int(np.floor((y + reach) / pitch)), rows - 1)
    middle = min(max(int(y / pitch), low), high)
    for n in range(2 * max(high - middle, middle - low) + 1):
        i = middle + (n + 1) // 2 if n % 2 else middle - n // 2
        if i < low or i > high:
            continue
        left, right = _span(x, y, i, pitch, reach, cols)
        row, aside = stock[i], (i * pitch - y) ** 2
        for j in range(left, right + 1):
            square = (j * pitch - x) ** 2 + aside
            if row[j] > z + enough + bulge * square:
                height = z + height_at(outline, min(sqrt(square), reach))
                if row[j] - height > enough:
                    seen[0], seen[1] = i, j
                    return True
    return False


@kernel
def _carve(stock, x, y, z, pitch, outline, bulge):  # type: ignore[no-untyped-def]
    for k in range(x.size):
        _place(stock, x[k], y[k], z[k], pitch, outline, bulge)


@kernel
def _trim(stock, x, y, z, pitch, outline, bulge, apart, worth, start, stop):  # type: ignore[no-untyped-def]
    """Carve a stretch from its middle outwards; its ends are worth it up to the last bite."""
    half = min(_END, (stop - start) // 2)
    low, high = start + half, stop - half
    last = low
    for k in range(low, high):
        square = (x[k] - x[last]) ** 2 + (y[k] - y[last]) ** 2 + (z[k] - z[last]) ** 2
        if k == low or square >= apart * apart:
            _place(stock, x[k], y[k], z[k], pitch, outline, bulge)
            last = k
    if low == high:
        high -= 1
    first, last = low, high - 1
    for k in range(high, stop):
        if _place(stock, x[k], y[k], z[k], pitch, outline, bulge) > _BITE:
            last = k
    for k in range(low - 1, start - 1, -1):
        if _place(stock, x[k], y[k], z[k], pitch, outline, bulge) > _BITE:
            first = k
    worth[start:first] = False
    worth[last + 1 : stop] = False


@kernel
def _carve_runs(stock, x, y, z, run, pitch, outline, bulge, least, apart, worth):  # type: ignore[no-untyped-def]
    first, seen = 0, np.full(2, -1)
    while first < x.size:
        last = first
        while last < x.size and run[last] == run[first]:
            if z[last] < 0.0:
                worth[last] = _bites(
                    stock, x[last], y[last], z[last], pitch, outline, bulge, least, seen
                )
            last += 1
        k = first
        while k < last:
            start = k
            while k < last and worth[k]:
                k += 1
            if k > start:
                _trim(stock, x, y, z, pitch, outline, bulge, apart, worth, start, k)
            k += 1
        first = last


def worthwhile(
    stock: Floats, grid: Grid, cutter: Cutter, trace: Trace, *, least: float
) -> tuple[Bools, Floats]:
    """Go along a trace run by run and tell where it takes something off what is left.

    Parameters
    ----------
    stock : (rows + 1, cols + 1) ndarray
        Heights at the grid's nodes, mm, none above 0; not modified.
    grid : Grid
    cutter : Cutter
    trace : Trace
    least : float
        Less than this off every node is not worth a move, mm.

    Returns
    -------
    (n,) ndarray of bool
        Which samples are worth a move, after all the runs before theirs.
    (rows + 1, cols + 1) ndarray
        What is left once the cutter has stood at those.
    """
    left = np.array(stock, dtype=np.float64)
    row, col = grid.to_index(*trace.xy.T)
    worth = np.zeros(len(trace), np.bool_)
    outline = outline_of(cutter)
    _carve_runs(
        left,
        col * grid.pitch,
        row * grid.pitch,
        np.ascontiguousarray(trace.z),
        trace.run,
        grid.pitch,
        outline,
        bulge_of(outline),
        least,
        sqrt(8 * _SAG * (cutter.tip_radius or cutter.flat_radius)),
        worth,
    )
    return worth, left


def after(stock: Floats, grid: Grid, cutter: Cutter, tips: Floats) -> Floats:
    """Carve the stock with the cutter standing at each of many places.

    Parameters
    ----------
    stock : (rows + 1, cols + 1) ndarray
        Heights at the grid's nodes, mm, none above 0; not modified.
    grid : Grid
    cutter : Cutter
    tips : (n, 3) ndarray
        Positions of the tip, panel mm.

    Returns
    -------
    ndarray
        What is left, an upper bound of it between the places given.
    """
    left = np.array(stock, dtype=np.float64)
    row, col = grid.to_index(tips[:, 0], tips[:, 1])
    below = np.ascontiguousarray(tips[:, 2])
    sunk = below < 0
    x, y, outline = col[sunk] * grid.pitch, row[sunk] * grid.pitch, outline_of(cutter)
    _carve(left, x, y, below[sunk], grid.pitch, outline, bulge_of(outline))
    return left
