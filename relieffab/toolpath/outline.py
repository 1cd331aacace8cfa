"""A cutter's outline as convex pieces, lines and arcs, and what kernels ask of it.

A piece is a row of seven numbers, lengths in mm: it runs from distance `R0` to `R1`
from the axis; a line starts at height `Z0` and climbs by `SLOPE`; an arc, of radius
`ARC` (0 for a line), has its centre at distance `MID` and height `TOP`.
"""

from math import hypot, inf, isinf, sqrt

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel
from relieffab.cutter import Cutter

Floats = NDArray[np.float64]
Piece = tuple[float, float, float, float, float, float, float]

R0, R1, Z0, SLOPE, ARC, MID, TOP = range(7)

EVEN = 1e-9
"""Slopes nearer to each other than this are the same."""


def outline_of(cutter: Cutter, allowance: float = 0.0) -> Floats:
    """Describe a cutter, grown by an allowance on every side.

    The parallel curve of lines and arcs is again lines and arcs, with an arc more
    round every corner.

    Parameters
    ----------
    cutter : Cutter
    allowance : float
        mm.

    Returns
    -------
    (pieces, 7) ndarray
        From the axis outwards; the lowest point is at height 0.
    """
    pieces = _pieces(cutter)
    return np.array(_grown(pieces, allowance) if allowance > 0 else pieces)


def _pieces(cutter: Cutter) -> list[Piece]:
    if cutter.shape == "form":
        ends = zip(cutter.points[:-1], cutter.points[1:], strict=True)
        return [(r, s, z, (w - z) / (s - r), 0.0, 0.0, 0.0) for (r, z), (s, w) in ends]
    flat, tip, pieces = cutter.flat_radius, cutter.tip_radius, []
    if flat > 0:
        pieces.append((0.0, flat, 0.0, 0.0, 0.0, 0.0, 0.0))
    end = min(cutter.arc_end, cutter.radius)
    if tip > 0:
        pieces.append((flat, end, 0.0, 0.0, tip, flat, tip))
    if cutter.flank < inf and end < cutter.radius:
        top = float(cutter.profile(end))
        pieces.append((end, cutter.radius, top, cutter.flank, 0.0, 0.0, 0.0))
    return pieces


def _slopes(piece: Piece) -> tuple[float, float]:
    """Slope where a piece starts and ends."""
    if piece[ARC] == 0:
        return piece[SLOPE], piece[SLOPE]
    start, end = (max(piece[side] - piece[MID], 0.0) / piece[ARC] for side in (R0, R1))
    return start / sqrt(1 - start * start), end / sqrt(1 - end * end) if end < 1 else inf


def _grown(pieces: list[Piece], by: float) -> list[Piece]:
    """Move every piece outwards, and round the corners."""
    out: list[Piece] = []
    slope, r, z = 0.0, 0.0, 0.0
    for piece in pieces:
        start, end = _slopes(piece)
        r, z = piece[R0], height_at(np.array([piece]), piece[R0])
        if start > slope + EVEN:
            out.append((r + by * _sine(slope), r + by * _sine(start), 0, 0, by, r, z + by))
        if piece[ARC] > 0:
            first, last = r + by * _sine(start), piece[R1] + by * _sine(end)
            out.append((first, last, 0, 0, piece[ARC] + by, piece[MID], piece[TOP] + by))
        else:
            sine = _sine(start)
            lift = by - by / hypot(1, start)
            out.append((r + by * sine, piece[R1] + by * sine, z + lift, start, 0, 0, 0))
        slope, r = end, piece[R1]
        z = height_at(np.array([piece]), r)
    if slope < inf:
        out.append((r + by * _sine(slope), r + by, 0, 0, by, r, z + by))
    return out


def _sine(slope: float) -> float:
    return 1.0 if isinf(slope) else slope / hypot(1, slope)


@kernel
def _at(outline, k, r):  # type: ignore[no-untyped-def]
    arc = outline[k, ARC]
    if arc == 0.0:
        return outline[k, Z0] + (r - outline[k, R0]) * outline[k, SLOPE]
    across = r - outline[k, MID]
    return outline[k, TOP] - sqrt(max(arc * arc - across * across, 0.0))


@kernel
def height_at(outline, r):  # type: ignore[no-untyped-def]
    """Height of the cutter's surface above its lowest point, r from the axis, r <= radius."""
    last = len(outline) - 1
    for k in range(last):
        if r <= outline[k, R1]:
            return _at(outline, k, r)
    return _at(outline, last, min(r, outline[last, R1]))


@kernel
def radius_at(outline, height):  # type: ignore[no-untyped-def]
    """Largest distance from the axis at which the cutter is no higher than `height`."""
    if height <= 0.0:
        return outline[0, R1] if outline[0, ARC] == 0.0 and outline[0, SLOPE] == 0.0 else 0.0
    for k in range(len(outline)):
        if height < _at(outline, k, outline[k, R1]):
            arc = outline[k, ARC]
            if arc == 0.0:
                return outline[k, R0] + (height - outline[k, Z0]) / outline[k, SLOPE]
            below = outline[k, TOP] - height
            return outline[k, MID] + sqrt(max(arc * arc - below * below, 0.0))
    return outline[-1, R1]


@kernel
def slope_at(outline, k, r):  # type: ignore[no-untyped-def]
    """Slope of piece k at a distance from the axis."""
    arc = outline[k, ARC]
    if arc == 0.0:
        return outline[k, SLOPE]
    across = max(r - outline[k, MID], 0.0)
    rest = arc * arc - across * across
    return inf if rest <= 1e-14 * arc * arc else across / sqrt(rest)


@kernel
def touch(outline, slope):  # type: ignore[no-untyped-def]
    """Least distance from the axis at which a plane of some slope touches the cutter."""
    for k in range(len(outline)):
        if slope_at(outline, k, outline[k, R0]) >= slope - EVEN:
            return outline[k, R0]
        if outline[k, ARC] > 0.0 and slope_at(outline, k, outline[k, R1]) >= slope:
            return outline[k, MID] + outline[k, ARC] * slope / sqrt(1.0 + slope * slope)
    return outline[-1, R1]


@kernel
def touch_last(outline, slope):  # type: ignore[no-untyped-def]
    """Largest distance from the axis at which a plane of some slope touches the cutter."""
    for k in range(len(outline)):
        if slope_at(outline, k, outline[k, R0]) > slope + EVEN:
            return outline[k, R0]
        if outline[k, ARC] > 0.0 and slope_at(outline, k, outline[k, R1]) > slope + EVEN:
            return outline[k, MID] + outline[k, ARC] * slope / sqrt(1.0 + slope * slope)
    return outline[-1, R1]


def smooth_below(outline: Floats) -> float:
    """Slope up to which the outline bends but has no corner; infinite for a ball."""
    slope = 0.0
    for row in outline:
        start, end = _slopes(tuple(row))
        if start > slope + EVEN:
            return slope
        slope = end
    return slope


def bulge_of(outline: Floats) -> float:
    """Largest b for which a cutter is nowhere lower than b r², r from its axis.

    That takes no root to compute.  Height over r² grows along an arc about the axis
    and falls along a line: it is least where pieces meet.
    """
    first = outline[0]
    if first[ARC] == 0 and first[SLOPE] == 0:
        return 0.0
    least = min(height_at(outline, r) / r**2 for r in outline[:, R1])
    if first[ARC] > 0:
        least = min(least, 0.5 / first[ARC])
    return float(least) * (1 - 1e-9)
