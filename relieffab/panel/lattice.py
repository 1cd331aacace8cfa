"""Delaunay triangulations of a lattice's nodes, grown one node at a time.

Distance is that of the triangular lattice, dx² + dy² - dx dy: an axis and a pixel's
diagonal from [i, j] to [i + 1, j + 1] are 1 long, the other diagonal is √3.  All
nodes together have one triangulation then, the relief's own two triangles a pixel,
and an edge of it whose ends are both there is always drawn: no other node lies in
the circle that it is a diameter of.  Coordinates are whole numbers and every test
is exact.

Corner k of triangle t is number 3 t + k: `corners` gives its node, and `mates` the
corner across the edge from it to the next one, -1 on the border.  Triangles turn
from X to Y, nodes are numbered row by row.
"""

from relieffab.compiled import kernel


@kernel
def turn(a, b, c, width):  # type: ignore[no-untyped-def]
    """Twice the signed area of three nodes."""
    ax, ay = a % width, a // width
    return (b % width - ax) * (c // width - ay) - (b // width - ay) * (c % width - ax)


@kernel
def _within(a, b, c, d, width):  # type: ignore[no-untyped-def]
    """Say whether d lies inside the circle through a, b and c (Guibas and Stolfi 1985)."""
    x, y = d % width, d // width
    ax, ay, bx, by, cx, cy = a % width, a // width, b % width, b // width, c % width, c // width
    ax, ay, bx, by, cx, cy = ax - x, ay - y, bx - x, by - y, cx - x, cy - y
    aa = ax * ax + ay * ay - ax * ay
    bb = bx * bx + by * by - bx * by
    cc = cx * cx + cy * cy - cx * cy
    return ax * (by * cc - bb * cy) - ay * (bx * cc - bb * cx) + aa * (bx * cy - by * cx) > 0


@kernel
def following(e):  # type: ignore[no-untyped-def]
    """Corner after e in its triangle."""
    return e - 2 if e % 3 == 2 else e + 1


@kernel
def preceding(e):  # type: ignore[no-untyped-def]
    """Corner before e in its triangle."""
    return e + 2 if e % 3 == 0 else e - 1


@kernel
def _locate(corners, t, node, width):  # type: ignore[no-untyped-def]
    """Say where a node lies beside triangle t: 0 to 2 beyond that edge, 3 to 5 on it, 6 within."""
    on = 6
    for k in range(3):
        side = turn(corners[3 * t + k], corners[3 * t + (k + 1) % 3], node, width)
        if side < 0:
            return k
        if side == 0:
            on = 3 + k
    return on


@kernel
def _put(corners, mates, t, nodes, neighbours):  # type: ignore[no-untyped-def]
    """Write triangle t, and tell its neighbours."""
    for k in range(3):
        corners[3 * t + k], mates[3 * t + k] = nodes[k], neighbours[k]
        if neighbours[k] >= 0:
            mates[neighbours[k]] = 3 * t + k


@kernel
def _flip(corners, mates, e):  # type: ignore[no-untyped-def]
    """Turn the edge that starts at corner e; it then starts at corner e's follower."""
    f = mates[e]
    t, s = e // 3, f // 3
    a, b = corners[e], corners[f]
    p, q = corners[preceding(e)], corners[preceding(f)]
    bp, pa = mates[following(e)], mates[preceding(e)]
    aq, qb = mates[following(f)], mates[preceding(f)]
    _put(corners, mates, t, (p, a, q), (pa, aq, -1))
    _put(corners, mates, s, (p, q, b), (3 * t + 2, qb, bp))


@kernel
def _settle(corners, mates, edges, count, fresh, width):  # type: ignore[no-untyped-def]
    """Flip edges across from a new node until all are Delaunay; lists what was changed.

    Each of the first `count` of `edges` is opposite the new node, which is the corner
    before it.
    """
    changed = 0
    while count:
        count -= 1
        e = edges[count]
        f = mates[e]
        p = corners[preceding(e)]
        other = corners[preceding(f)] if f >= 0 else p
        if f >= 0 and _within(corners[e], corners[following(e)], p, other, width):
            _flip(corners, mates, e)
            # Triangles are now (p, a, q) and (p, q, b): the new node comes first in both.
            edges[count], edges[count + 1] = 3 * (e // 3) + 1, 3 * (f // 3) + 1
            count += 2
        else:
            fresh[changed] = e // 3
            changed += 1
    return changed


@kernel
def insert(corners, mates, total, start, node, edges, fresh, width):  # type: ignore[no-untyped-def]
    """Add a node that is not there yet, found by walking from a triangle.

    Parameters
    ----------
    corners, mates : (3 t,) ndarray of int
        With room for two more triangles.
    total : int
        Triangles so far.
    start : int
        Triangle to walk from.
    node : int
    edges, fresh : (m,) ndarray of int
        Room for work; at the end `fresh` lists triangles that are new or changed.
    width : int
        Nodes in a row.

    Returns
    -------
    total : int
    changed : int
        How many `fresh` lists.
    """
    t = start
    where = _locate(corners, t, node, width)
    while where < 3:
        t = mates[3 * t + where] // 3
        where = _locate(corners, t, node, width)
    if where == 6:
        a, b, c = corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]
        ab, bc, ca = mates[3 * t], mates[3 * t + 1], mates[3 * t + 2]
        _put(corners, mates, t, (node, a, b), (-1, ab, -1))
        _put(corners, mates, total, (node, b, c), (3 * t + 2, bc, -1))
        _put(corners, mates, total + 1, (node, c, a), (3 * total + 2, ca, 3 * t))
        edges[0], edges[1], edges[2] = 3 * t + 1, 3 * total + 1, 3 * total + 4
        return total + 2, _settle(corners, mates, edges, 3, fresh, width)
    e = 3 * t + where - 3
    f = mates[e]
    a, b, c = corners[e], corners[following(e)], corners[preceding(e)]
    bc, ca = mates[following(e)], mates[preceding(e)]
    _put(corners, mates, t, (node, b, c), (-1, bc, -1))
    _put(corners, mates, total, (node, c, a), (3 * t + 2, ca, -1))
    edges[0], edges[1] = 3 * t + 1, 3 * total + 1
    if f < 0:
        return total + 1, _settle(corners, mates, edges, 2, fresh, width)
    s = f // 3
    d = corners[preceding(f)]
    ad, db = mates[following(f)], mates[preceding(f)]
    _put(corners, mates, s, (node, a, d), (3 * total + 2, ad, -1))
    _put(corners, mates, total + 1, (node, d, b), (3 * s + 2, db, 3 * t))
    edges[2], edges[3] = 3 * s + 1, 3 * total + 4
    return total + 2, _settle(corners, mates, edges, 4, fresh, width)


@kernel
def two_triangles(corners, mates, rows, width):  # type: ignore[no-untyped-def]
    """Begin with the lattice's four corners."""
    last = rows * width - 1
    _put(corners, mates, 0, (0, width - 1, last), (-1, -1, -1))
    _put(corners, mates, 1, (0, last, last - width + 1), (2, -1, -1))
