"""Evenly spaced streamlines of a direction field."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Complexes = NDArray[np.complex128]

TEST = 0.8  # of the separation: a line ends where it comes so close to another
STEPS = 5  # of a line within a separation
SHARPEST = 0.5  # cosine of the sharpest turn within a step


class Spacing(NamedTuple):
    """How lines are laid; lengths in pixels.

    Parameters
    ----------
    apart : float
        Distance of a new line from the one it is laid beside.
    shortest : float
        Lines shorter than this are left out.
    room : float
        Least distance from what bounds the lines.
    """

    apart: float
    shortest: float
    room: float


@kernel
def _at(image, row, col):  # type: ignore[no-untyped-def]
    """Bilinear interpolation; the place is inside."""
    i, j = min(int(row), image.shape[0] - 2), min(int(col), image.shape[1] - 2)
    u, v = row - i, col - j
    upper = image[i, j] * (1 - v) + image[i, j + 1] * v
    lower = image[i + 1, j] * (1 - v) + image[i + 1, j + 1] * v
    return upper * (1 - u) + lower * u


@kernel
def _way(field, row, col, down, across):  # type: ignore[no-untyped-def]
    """Give the direction (rows, columns) at a place, to the side of the one given."""
    angle = 0.5 * np.angle(_at(field, row, col))
    # Rows count against Y.
    a, b = -np.sin(angle), np.cos(angle)
    if a * down + b * across < 0:
        return -a, -b
    return a, b


@kernel
def _inside(room, patch, row, col, least, own):  # type: ignore[no-untyped-def]
    n, m = room.shape
    if not (0 <= row <= n - 1 and 0 <= col <= m - 1):
        return False
    if patch[int(row + 0.5), int(col + 0.5)] != own:
        return False
    return _at(room, row, col) >= least


@kernel
def _close(places, head, following, size, row, col, limit, line, count):  # type: ignore[no-untyped-def]
    """Whether a place is nearer than a limit to a line, or to its own line further on.

    `places` holds row, column, line, and the place's number along the line.
    """
    square = limit * limit
    i, j = int(row / size) + 1, int(col / size) + 1
    for a in range(i - 1, i + 2):
        for b in range(j - 1, j + 2):
            k = head[a, b]
            while k >= 0:
                dr, dc = places[k, 0] - row, places[k, 1] - col
                other = places[k, 2] != line or abs(places[k, 3] - count) > 3 * STEPS
                if other and dr * dr + dc * dc < square:
                    return True
                k = following[k]
    return False


@kernel
def _grow(field, room, patch, start, spacing, places, head, following, used, line):  # type: ignore[no-untyped-def]
    """Follow the field both ways from a start; give how many places there are then."""
    apart, _, least = spacing
    step = apart / STEPS
    own = patch[int(start[0] + 0.5), int(start[1] + 0.5)]
    first_down, first_across = _way(field, start[0], start[1], 0.0, 1.0)
    for side in (1.0, -1.0):
        row, col = start
        down, across = side * first_down, side * first_across
        number = 0
        while used < len(places):
            if side > 0 or number > 0:
                places[used, 0], places[used, 1] = row, col
                places[used, 2], places[used, 3] = line, side * number
                i, j = int(row / apart) + 1, int(col / apart) + 1
                following[used] = head[i, j]
                head[i, j] = used
                used += 1
            a, b = _way(field, row, col, down, across)
            middle = row + 0.5 * step * a, col + 0.5 * step * b
            if not _inside(room, patch, middle[0], middle[1], least, own):
                break
            a, b = _way(field, middle[0], middle[1], a, b)
            if a * down + b * across < SHARPEST:
                break
            row, col = row + step * a, col + step * b
            down, across = a, b
            number += 1
            if not _inside(room, patch, row, col, least, own):
                break
            if _close(places, head, following, apart, row, col, TEST * apart, line, side * number):
                break
    return used


@kernel
def _forget(places, head, following, apart, used, until):  # type: ignore[no-untyped-def]
    """Take the latest places off the lattice again."""
    for k in range(used - 1, until - 1, -1):
        head[int(places[k, 0] / apart) + 1, int(places[k, 1] / apart) + 1] = following[k]


@kernel
def _lay(field, room, patch, seeds, spacing, places):  # type: ignore[no-untyped-def]
    """Lay lines beside lines, the oldest first, then from seeds where none is near."""
    apart, shortest, least = spacing
    rows, cols = room.shape
    head = np.full((int(rows / apart) + 3, int(cols / apart) + 3), -1)
    following = np.full(len(places), -1)
    used, line, looked, seed = 0, 0, 0, 0
    while used < len(places):
        if looked < 2 * used:
            k = looked // 2
            turn = 1.0 if looked % 2 else -1.0
            a, b = _way(field, places[k, 0], places[k, 1], 0.0, 1.0)
            row, col = places[k, 0] + turn * apart * b, places[k, 1] - turn * apart * a
            looked += 1
            own = patch[int(places[k, 0] + 0.5), int(places[k, 1] + 0.5)]
        elif seed < len(seeds):
            row, col = seeds[seed, 0], seeds[seed, 1]
            own = patch[int(row + 0.5), int(col + 0.5)]
            seed += 1
        else:
            break
        if not _inside(room, patch, row, col, least, own):
            continue
        if _close(places, head, following, apart, row, col, 0.99 * apart, -1, 0):
            continue
        grown = _grow(field, room, patch, (row, col), spacing, places, head, following, used, line)
        if (grown - used - 1) * apart / STEPS < shortest:
            _forget(places, head, following, apart, grown, used)
            continue
        used, line = grown, line + 1
    return used, line


def streamlines(
    field: Complexes, room: Floats, spacing: Spacing, patch: Ints | None = None
) -> list[Floats]:
    """Cover an area with lines along a field, no two nearer than a share of their separation.

    Jobard and Lefer, "Creating evenly-spaced streamlines of arbitrary density"
    (Visualization in Scientific Computing, 1997): each new line starts one separation
    beside an old one and is followed both ways until it comes too close to another.

    Parameters
    ----------
    field : (n, m) ndarray of complex
        exp(2i angle) at nodes, the angle from X towards Y.
    room : (n, m) ndarray
        Distance from what bounds the lines, pixels; 0 beyond it.
    spacing : Spacing
    patch : (n, m) ndarray of int, optional
        Lines end where it changes.

    Returns
    -------
    list of (k, 2) ndarray
        Rows and columns, in node indices, `STEPS` of them a separation.
    """
    patch = np.zeros(room.shape, np.int64) if patch is None else patch
    rows, cols = np.nonzero(room >= max(spacing.room, 1e-9))
    order = np.lexsort((cols, rows, -np.round(room[rows, cols])))
    seeds = np.column_stack([rows, cols])[order].astype(float)
    # No two lines share a pixel, and within one a line has no more places than this.
    most = int(2 * STEPS / spacing.apart * len(seeds)) + 1000
    places = np.zeros((most, 4))
    used, count = _lay(field, room, patch, seeds, tuple(map(float, spacing)), places)
    places = places[:used]
    line, number = places[:, 2], places[:, 3]
    places = places[np.lexsort((number, line))]
    ends = np.flatnonzero(np.diff(places[:, 2])) + 1
    return np.split(places[:, :2], ends) if count else []
