"""One cutter swept along moves over a round stock that turns under it: the kernel.

A lattice's node is a ray from the axis: at X x and the angle b, it is cut down to the
radius c at which it meets the cutter first.  On a move the cutter's X, its angle a and
its height change together, evenly.  A point of the ray at c is inside the cutter where

    G = R + z + f(sqrt((x - X)² + (c sin p)²)) - c cos p < 0,    p = b - a,

f being the cutter's profile.  Along a move G falls and then rises: its least value is
bisected.  That is nearly straight in c, so that Newton's steps from below come to the
first c at which it is 0.
"""

from math import cos, hypot, inf, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.gcode.sweep import BAND_ROWS, Shape, columns, profile_height, profile_reach

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

HALVINGS, STEPS = 14, 40  # a cutter's width in steps of its 16,000th
CLOSE = 1e-7  # mm


@kernel
def profile_slope(r: float, shape: Shape, form: Floats) -> float:
    """How steeply the cutter's surface rises at a distance from its axis."""
    flat, tip, end, _, slope, radius = shape
    if len(form):
        k = 1
        while k < len(form) - 1 and form[k, 0] < r:
            k += 1
        return (form[k, 1] - form[k - 1, 1]) / (form[k, 0] - form[k - 1, 0])
    if r <= flat:
        return 0.0
    if r <= end and tip > 0.0:
        across = min(r - flat, tip * (1 - 1e-9))
        return across / sqrt(tip * tip - across * across)
    return slope if r <= radius and slope < inf else 1e9


@kernel
def _growing(t, c, move, shape, form):  # type: ignore[no-untyped-def]
    """Whether G grows at a share t of a move, for a point at radius c."""
    dx, gone_x, p, gone_p, _, gone_z = move
    x, a = dx - t * gone_x, p - t * gone_p
    s = sin(a)
    away = hypot(x, c * s)
    beside = -(x * gone_x + c * c * s * cos(a) * gone_p)
    steep = 0.0 if away == 0.0 else profile_slope(away, shape, form) * beside / away
    return gone_z + steep - c * s * gone_p > 0.0


@kernel
def _deepest_share(c, move, shape, form):  # type: ignore[no-untyped-def]
    """Share of a move at which a point at radius c is deepest inside; -1 where it never is."""
    dx, gone_x, p, gone_p, _, _ = move
    # Where the point is within the cutter's radius, r: sin p is p (1 - r² / 6c²) where it
    # leaves it sideways; in between that is too little by at most r³ / 24c².
    aside = c * (1.0 - shape[5] * shape[5] / (6.0 * c * c))
    square = gone_x * gone_x + aside * aside * gone_p * gone_p
    half = dx * gone_x + aside * aside * p * gone_p
    beyond = dx * dx + aside * aside * p * p - shape[5] * shape[5]
    low, high = 0.0, 1.0
    if square > 0.0:
        root = half * half - square * beyond
        if root < 0.0:
            return -1.0
        low = max(low, (half - sqrt(root)) / square)
        high = min(high, (half + sqrt(root)) / square)
    elif beyond > 0.0:
        return -1.0
    if low > high:
        return -1.0
    if _growing(low, c, move, shape, form):
        return low
    if not _growing(high, c, move, shape, form):
        return high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _growing(middle, c, move, shape, form):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


@kernel
def lowered(c: float, least: float, move, shape: Shape, form: Floats):  # type: ignore[no-untyped-def]
    """Radius down to which a move cuts a ray that stands to radius c, and where that begins.

    A cutter beside a ray may meet it deep down and not at its top: what would overhang
    counts as gone, but the cutter does not cut it.

    Parameters
    ----------
    c : float
        mm.
    least : float
        A radius up to which the cutter meets the ray nowhere, mm.
    move : tuple of float
        X from the move's start to the ray, how far the move goes in X, mm; the angle
        from its start to the ray, how far it turns, radians; the radius of the tip at its
        start, how far it rises, mm.
    shape : tuple of float
        From `profile_numbers`.
    form : (m, 2) ndarray
        From `profile_points`.
    """
    dx, gone_x, p, gone_p, base, gone_z = move
    at, topped = least, False
    for _ in range(STEPS):
        t = _deepest_share(at, move, shape, form)
        if t < 0.0:
            return c, c
        x, a = dx - t * gone_x, p - t * gone_p
        s, cosine = sin(a), cos(a)
        away = min(hypot(x, at * s), shape[5])
        over = base + t * gone_z + profile_height(away * away, shape, form) - at * cosine
        if abs(over) <= CLOSE:
            beside = sqrt(max(shape[5] * shape[5] - x * x, 0.0))
            return at, (min(c, max(beside / abs(s), at)) if s != 0.0 else c)
        rise = 0.0 if away == 0.0 else profile_slope(away, shape, form) * at * s * s / away
        if rise >= cosine:
            return c, c
        at += over / (cosine - rise)
        if at > c:
            if topped:
                return c, c
            at, topped = c, True
    return at, c


@kernel
def _lower_row(row, x_start, pitch, ray, move, least, shape, form):  # type: ignore[no-untyped-def]
    """Lower one row's part under a move; give the deepest bite, mm.

    `ray` is the radius of the face and the angle from the move's start to the row.
    """
    radius, p = ray
    gone_x, gone_p, base, gone_z = move
    bottom = min(base, base + gone_z)
    # Beside the cutter's plane a ray leans away from it: it is met no lower than this makes it.
    aside = 0.0 if p * (p - gone_p) <= 0.0 else min(abs(p), abs(p - gone_p))
    upright = cos(aside)
    # With the turning at its narrowest, points seem nearer to the way than they are.
    away = max(abs(p), abs(p - gone_p))
    narrow = least * (1.0 - away * away / 6.0)
    across_p, across = p * narrow, gone_p * narrow
    length2 = gone_x * gone_x + across * across
    deepest = 0.0
    for j in range(len(row)):
        dx = x_start + j * pitch
        t = 0.0
        if length2 > 0.0:
            t = min(max((dx * gone_x + across_p * across) / length2, 0.0), 1.0)
        nx, ny = dx - t * gone_x, across_p - t * across
        near2 = nx * nx + ny * ny
        if near2 > shape[5] * shape[5]:
            continue
        c, under = radius + row[j], (bottom + profile_height(near2, shape, form)) / upright
        if c <= under:
            continue
        met, top = lowered(c, under, (dx, gone_x, p, gone_p, base, gone_z), shape, form)
        if met < c:
            deepest = max(deepest, top - met)
            row[j] = met - radius
    return deepest


@parallel_kernel
def swing(
    heights: NDArray[np.float32],
    points: Floats,
    shape: Shape,
    form: Floats,
    pitch: float,
    radius: float,
    order: Ints,
) -> NDArray[np.float32]:
    """Lower the rays of a round stock by a cutter that goes from point to point.

    Parameters
    ----------
    heights : (rows, cols) ndarray
        At nodes, from the face, mm; lowered in place.  Rows go round, columns along the
        axis.
    points : (n, 3) ndarray
        X along the axis and Y round the face from node [0, 0], Z of the tip from the
        face, mm.  Point 0 is where the first move starts.
    shape : tuple of float
        From `profile_numbers`.
    form : (m, 2) ndarray
        From `profile_points`.
    pitch, radius : float
        Of the lattice, and of the face, mm.
    order : (bands,) ndarray of int
        In which order bands are handed out.

    Returns
    -------
    (bands, n) ndarray
        The deepest bite each move takes out of each band, mm.
    """
    rows, cols = heights.shape
    around = 2.0 * pi * radius
    bites = np.zeros((len(order), len(points)), np.float32)
    for turn in prange(len(order)):
        band = order[turn]
        first, last = band * BAND_ROWS, min((band + 1) * BAND_ROWS, rows) - 1
        for k in range(1, len(points)):
            x0, z0 = points[k - 1, 0], points[k - 1, 2]
            x1, z1 = points[k, 0], points[k, 2]
            if min(z0, z1) >= 0.0:
                continue
            least = radius + min(z0, z1)
            reach = profile_reach(-min(z0, z1), shape, form) + 1e-6
            wide = reach / least
            wide = min(wide * (1.0 + 0.6 * wide * wide), 0.5 * pi) * radius
            for once in range(-1, 2):
                y0, y1 = points[k - 1, 1] + once * around, points[k, 1] + once * around
                i0 = max(first, int(np.ceil((min(y0, y1) - wide) / pitch)))
                i1 = min(last, int(np.floor((max(y0, y1) + wide) / pitch)))
                for i in range(i0, i1 + 1):
                    low, high = columns(i * pitch, x0, y0, x1, y1, wide)
                    j0 = max(0, int(np.ceil(max(low, 0.0) / pitch)))
                    j1 = min(cols - 1, int(np.floor(min(high, cols * pitch) / pitch)))
                    if j0 > j1:
                        continue
                    ray = (radius, (i * pitch - y0) / radius)
                    move = (x1 - x0, (y1 - y0) / radius, radius + z0, z1 - z0)
                    bite = _lower_row(
                        heights[i, j0 : j1 + 1], j0 * pitch - x0, pitch, ray, move,
                        least, shape, form,
                    )  # fmt: skip
                    bites[turn, k] = max(bites[turn, k], bite)
    return bites
