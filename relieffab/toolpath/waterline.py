"""Lines at one height along steep walls, and lines at even distances inside a border."""

from itertools import groupby
from math import ceil
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, distance_transform_edt, label
from skimage.measure import approximate_polygon, find_contours

from relieffab.toolpath.envelope import Places, nodes
from relieffab.toolpath.passes import Work

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_SHORTEST = 1.0
_SMOOTH = 0.1
_INSIDE = 1.2  # steps from the last place outside: the border lies somewhere before


def waterlines(work: Work, steep: Bools, apart: float) -> list[Floats]:
    """Cut the cutter-location surface at even heights, where the ground is steep.

    Parameters
    ----------
    work : Work
    steep : (rows, cols) ndarray of bool
        Pixels.
    apart : float
        Distance of the heights, mm.

    Returns
    -------
    list of (k, 2) ndarray
        X and Y, mm; the highest lines first.
    """
    if not steep.any():
        return []
    places = nodes(work.relief.grid)
    low = work.ground.low_at_nodes
    near = binary_dilation(steep, iterations=2)
    count = ceil(-float(low.min()) / apart)
    lines = []
    for height in -apart * np.arange(1, count + 1):
        for line in find_contours(low, max(height, float(low.min()) + 1e-6)):
            lines += _within(line, near, places)
    return lines


def _within(line: Floats, near: Bools, places: Places) -> list[Floats]:
    """Keep the stretches of a contour that lie over some pixels."""
    i = np.floor(line).astype(int).clip(0, np.array(near.shape) - 1)
    inside = near[i[:, 0], i[:, 1]]
    cuts = np.flatnonzero(np.diff(inside)) + 1
    pieces = zip(np.split(line, cuts), np.split(inside, cuts), strict=True)
    parts = [part for part, there in pieces if there[0]]
    found = [to_panel(approximate_polygon(part, _SMOOTH), places) for part in parts]
    return [part for part in found if length(part) >= _SHORTEST]


def offsets(inside: Bools, places: Places, stepover: float) -> list[Floats]:
    """Lay closed lines at even distances inside a border, one patch after another.

    Parameters
    ----------
    inside : (rows, count) ndarray of bool
        Places to go over; `places` are as far apart along rows as across.
    places : Places
    stepover : float
        mm.

    Returns
    -------
    list of (k, 2) ndarray
        X and Y, mm; each patch near where the one before ends, of each the innermost
        line first.  What is still to be cut lies to their right: climb milling, with a
        spindle that turns clockwise.
    """
    room = np.pad(inside, 1)
    away = distance_transform_edt(room) * places.step
    patches, _ = label(room, structure=np.ones((3, 3)))
    found: list[tuple[int, int, Floats]] = []
    for k in range(ceil(float(away.max()) / stepover)):
        for line in find_contours(away, _INSIDE * places.step + k * stepover):
            at = to_panel(approximate_polygon(line - 1.0, _SMOOTH)[::-1], places)
            if length(at) > 0 and np.array_equal(line[0], line[-1]):
                low, high = np.floor(line[0]).astype(int), np.ceil(line[0]).astype(int)
                patch = int(patches[[low[0], high[0]]][:, [low[1], high[1]]].max())
                found.append((patch, -k, at))
    found.sort(key=lambda line: line[:2])
    return _nested([[line for _, _, line in lines] for _, lines in groupby(found, itemgetter(0))])


def _nested(patches: list[list[Floats]]) -> list[Floats]:
    """Begin each closed line, and each patch, where it is nearest to the end of the one before."""
    out: list[Floats] = []
    here, left = np.zeros(2), list(patches)
    while left:
        patch = min(left, key=lambda lines: _away(lines[0], here).min())
        left = [lines for lines in left if lines is not patch]
        for line in patch:
            ring = np.roll(line[:-1], -int(_away(line[:-1], here).argmin()), axis=0)
            out.append(np.concatenate([ring, ring[:1]]))
            here = ring[0]
    return out


def _away(line: Floats, here: Floats) -> Floats:
    return np.hypot(*(line - here).T)


def to_panel(line: Floats, places: Places) -> Floats:
    """Turn row and number of places into X and Y, for rows along X."""
    x = places.start[0] + line[:, 1] * places.step
    y = places.start[1] - line[:, 0] * places.stepover
    return np.column_stack([x, y])


def length(line: Floats) -> float:
    """Length of a line, mm."""
    return float(np.hypot(*np.diff(line, axis=0).T).sum())
