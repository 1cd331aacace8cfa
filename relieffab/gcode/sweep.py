"""One cutter swept along straight moves over a lattice of heights: the kernel.

Seen from a node of the lattice, at distance p from the move's line, a cutter at
u along the line leaves z(u) = z_p - k u + f(sqrt(p² + u²)), where k is how
steeply the move descends and f is the cutter's profile.  f is convex and never
falls, so z is convex in u: its least value on the move is where its slope is 0,
brought back to the nearer end of the move.  For balls and cones that place has
a closed form; on the torus of a bull nose, and for profiles given by points, it
is bisected to within 1e-7 mm.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.compiled import kernel, parallel_kernel, prange
from relieffab.cutter import Cutter

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

Shape = tuple[float, float, float, float, float, float]
Move = tuple[float, float, float, float, float, float, float, float]

BAND_ROWS = 32


def profile_numbers(cutter: Cutter) -> Shape:
    """Put a cutter's profile into numbers for the kernels.

    Returns
    -------
    tuple of float
        Flat radius, tip radius, radius and height where the arc ends, slope of
        the flank, radius; mm.
    """
    if cutter.shape == "form":
        return 0.0, 0.0, cutter.radius, cutter.points[-1][1], 0.0, cutter.radius
    whole = np.isinf(cutter.flank)
    end = cutter.radius if whole else min(cutter.arc_end, cutter.radius)
    top = float(cutter.profile(min(end, cutter.arc_end)))
    return cutter.flat_radius, cutter.tip_radius, end, top, float(cutter.flank), cutter.radius


def profile_points(cutter: Cutter) -> Floats:
    """Give the (m, 2) points of a profile, distance and height, mm; none but of a form."""
    return np.array(cutter.points, dtype=float).reshape(-1, 2)


@kernel
def profile_height(r2: float, shape: Shape, form: Floats) -> float:
    """Height of the cutter above its tip at the square of a distance, mm."""
    flat, tip, end, top, slope, radius = shape
    if len(form):
        return np.interp(np.sqrt(r2), form[:, 0], form[:, 1])
    if r2 <= flat * flat:
        return 0.0
    if flat == 0.0 and r2 <= end * end:
        return tip - np.sqrt(max(tip * tip - r2, 0.0))
    r = min(np.sqrt(r2), radius)
    if r <= end:
        across = min(r - flat, tip)
        return tip - np.sqrt(tip * tip - across * across)
    return top + (r - end) * slope


@kernel
def profile_reach(height: float, shape: Shape, form: Floats) -> float:
    """Distance from the axis at which the cutter is so high above its tip, mm."""
    flat, tip, end, top, slope, radius = shape
    if len(form):
        k = len(form) - 1
        while k > 1 and form[k - 1, 1] > height:
            k -= 1
        rise = form[k, 1] - form[k - 1, 1]
        if rise <= 0.0 or height >= form[k, 1]:
            return form[k, 0]
        share = max(height - form[k - 1, 1], 0.0) / rise
        return form[k - 1, 0] + share * (form[k, 0] - form[k - 1, 0])
    if height <= top:
        return flat + np.sqrt(max(tip * tip - (tip - height) ** 2, 0.0))
    return min(end + (height - top) / slope, radius)


@kernel
def lowest_at(p2: float, descent: float, shape: Shape, form: Floats) -> float:
    """Find how far ahead of a node the cutter cuts it deepest, mm.

    Parameters
    ----------
    p2 : float
        Square of the node's distance from the move's line, at most radius², mm².
    descent : float
        How steeply the move goes down, dz per mm of XY, 0 or more.
    shape : tuple of float
        From `profile_numbers`.
    form : (m, 2) ndarray
        From `profile_points`.
    """
    flat, tip, end, _, slope, radius = shape
    if descent == 0.0:
        return 0.0
    limit = np.sqrt(max(radius * radius - p2, 0.0))
    if len(form):
        return _lowest_on_form(p2, descent, limit, form)
    rim = np.sqrt(max(flat * flat - p2, 0.0))
    if tip > 0.0 and p2 < end * end:
        low, high = rim, np.sqrt(end * end - p2)
        if flat == 0.0:
            u = descent * np.sqrt(max(tip * tip - p2, 0.0) / (1 + descent * descent))
            if u <= high:
                return u
        else:
            for _ in range(26):
                u = 0.5 * (low + high)
                r = np.sqrt(p2 + u * u)
                across = min(r - flat, tip)
                if across * u < descent * r * np.sqrt(tip * tip - across * across):
                    low = u
                else:
                    high = u
            if low < np.sqrt(end * end - p2) * (1 - 1e-6):
                return low
    if np.isinf(slope) or descent >= slope:
        return limit
    u = descent * np.sqrt(p2 / (slope * slope - descent * descent))
    return min(max(u, rim), limit)


@kernel
def _lowest_on_form(p2: float, descent: float, limit: float, form: Floats) -> float:
    low, high = 0.0, limit
    for _ in range(30):
        u = 0.5 * (low + high)
        r = np.sqrt(p2 + u * u)
        k = 1
        while k < len(form) - 1 and form[k, 0] < r:
            k += 1
        slope = (form[k, 1] - form[k - 1, 1]) / (form[k, 0] - form[k - 1, 0])
        if slope * u < descent * r:
            low = u
        else:
            high = u
    return low


@kernel
def columns(
    y: float, x0: float, y0: float, x1: float, y1: float, radius: float
) -> tuple[float, float]:
    """Least and greatest X of a capsule, a segment grown by a radius, on a row at y.

    Returns
    -------
    tuple of float
        Least above greatest where the row misses it.
    """
    low, high = np.inf, -np.inf
    for x, d in ((x0, y - y0), (x1, y - y1)):
        if abs(d) <= radius:
            half = np.sqrt(radius * radius - d * d)
            low, high = min(low, x - half), max(high, x + half)
    length = np.hypot(x1 - x0, y1 - y0)
    if y0 != y1 and length > 0.0:
        nx, ny = (y0 - y1) / length * radius, (x1 - x0) / length * radius
        for sign in (-1.0, 1.0):
            t = (y - y0 - sign * ny) / (y1 - y0)
            if 0.0 <= t <= 1.0:
                x = x0 + t * (x1 - x0) + sign * nx
                low, high = min(low, x), max(high, x)
    return low, high


@kernel
def lower_row(
    row: NDArray[np.float32], start: float, pitch: float, move: Move, shape: Shape, form: Floats
) -> float:
    """Lower one row's part under a move; give the deepest bite, mm.

    Parameters
    ----------
    row : (m,) ndarray
        Heights at consecutive nodes, mm; lowered in place.
    start : float
        X of the first of them, from the move's upper end, mm.
    pitch : float
    move : tuple of float
        Y of the row from the move's upper end, the move's unit vector in X and
        Y, its length there, the Z of its upper and lower end, its descent, and
        how far from the axis the cutter meets any material.
    shape : tuple of float
        From `profile_numbers`.
    form : (m, 2) ndarray
        From `profile_points`.
    """
    dy, tx, ty, length, top, bottom, descent, reach = move
    reach2 = (reach * (1 + 1e-9)) ** 2
    # Ball and cone lie above a parabola, which needs no square root: f(r)/r² grows
    # along the arc and falls along the cone, so it is least at one of their ends.
    bulge = 0.0
    if shape[0] == 0.0 and reach > 0.0 and not len(form):
        bulge = profile_height(reach * reach, shape, form) / (reach * reach) * (1 - 1e-9)
        if shape[1] > 0.0:
            bulge = min(bulge, 0.5 / shape[1])
    deepest = 0.0
    for j in range(len(row)):
        dx = start + j * pitch
        along, across = dx * tx + dy * ty, dx * ty - dy * tx
        p2 = across * across
        beyond = max(0.0, -along, along - length)
        near2 = p2 + beyond * beyond
        if near2 > reach2 or row[j] <= bottom + near2 * bulge:
            continue
        u = min(max(lowest_at(p2, descent, shape, form), -along), length - along)
        z = top - descent * (along + u) + profile_height(p2 + u * u, shape, form)
        if z < row[j]:
            deepest = max(deepest, row[j] - z)
            row[j] = z
    return deepest


@parallel_kernel
def sweep(
    heights: NDArray[np.float32],
    points: Floats,
    shape: Shape,
    form: Floats,
    pitch: float,
    order: Ints,
) -> NDArray[np.float32]:
    """Lower the lattice by a cutter that goes from point to point.

    Each band of rows belongs to one thread and sees the moves in their order,
    so the answer does not depend on how many threads there are.

    Parameters
    ----------
    heights : (rows, cols) ndarray
        At nodes, mm; lowered in place.
    points : (n, 3) ndarray
        X to the right of node [0, 0], Y down the rows from it, and Z, mm.
        Point 0 is where the first move starts.
    shape : tuple of float
        From `profile_numbers`.
    form : (m, 2) ndarray
        From `profile_points`.
    pitch : float
        Of the lattice, mm.
    order : (bands,) ndarray of int
        In which order bands are handed out.

    Returns
    -------
    (bands, n) ndarray
        The deepest bite each move takes out of each band, mm.
    """
    rows, cols = heights.shape
    radius = shape[5]
    bites = np.zeros((len(order), len(points)), np.float32)
    for turn in prange(len(order)):
        band = order[turn]
        first, last = band * BAND_ROWS, min((band + 1) * BAND_ROWS, rows) - 1
        for k in range(1, len(points)):
            up = k if points[k, 2] > points[k - 1, 2] else k - 1
            x0, y0, z0 = points[up]
            x1, y1, z1 = points[2 * k - 1 - up]
            i0 = max(first, int(np.ceil((min(y0, y1) - radius) / pitch - 1e-6)))
            i1 = min(last, int(np.floor((max(y0, y1) + radius) / pitch + 1e-6)))
            if i0 > i1 or z1 >= 0.0:
                continue
            reach = profile_reach(-z1, shape, form)
            tx, ty, descent, length = 1.0, 0.0, 0.0, np.hypot(x1 - x0, y1 - y0)
            if length > 1e-9:
                tx, ty, descent = (x1 - x0) / length, (y1 - y0) / length, (z0 - z1) / length
            else:
                z0, length = z1, 0.0
            for i in range(i0, i1 + 1):
                low, high = columns(i * pitch, x0, y0, x1, y1, reach + 1e-6)
                j0 = max(0, int(np.ceil(max(low, 0.0) / pitch)))
                j1 = min(cols - 1, int(np.floor(min(high, cols * pitch) / pitch)))
                if j0 > j1:
                    continue
                move = (i * pitch - y0, tx, ty, length, z0, z1, descent, reach)
                row = heights[i, j0 : j1 + 1]
                bite = lower_row(row, j0 * pitch - x0, pitch, move, shape, form)
                bites[turn, k] = max(bites[turn, k], bite)
    return bites
