"""The relief's surface below the face as few exact triangles.

A pixel needs its two triangles only where the relief bends.  Elsewhere square
blocks of 2, 4, 8 ... pixels stand for many, a quadtree as in Samet (1990) with
cracks closed by fans.  A block is two triangles along the relief's own diagonal
if nothing but its corners is used; if a smaller neighbour uses nodes on its
sides, it is a fan from its centre to them.

Every vertex is a node of the relief, and all nodes of a block lie within
`bound` of its two triangles P.  Neither a fan's triangle nor one of the
relief's crosses P's diagonal, so over each of them the difference to P is
linear and at most `bound`.  Fan and relief are therefore never further apart
than 2 `bound`, at and between the nodes.
"""

import numpy as np
from numpy.typing import NDArray

from relieffab.panel.model import Floats, Ints, Sinking, Surface

Bools = NDArray[np.bool_]
LARGEST_BLOCK = 256


def _deviation(heights: Floats, row: Ints, col: Ints, size: int) -> Floats:
    """Largest distance of any node of each block from its two triangles, mm."""
    windows = np.lib.stride_tricks.sliding_window_view(heights, (size + 1, size + 1))
    h = windows[row, col]
    u, v = np.mgrid[0 : size + 1, 0 : size + 1] / size
    a, b, c, d = (h[:, i, j, None, None] for i, j in ((0, 0), (0, -1), (-1, 0), (-1, -1)))
    plane = a + np.where(u >= v, (c - a) * u + (d - c) * v, (d - b) * u + (b - a) * v)
    return np.abs(h - plane).max(axis=(1, 2))  # type: ignore[no-any-return]


def _blocks(sinking: Sinking, bound: float) -> list[tuple[int, Ints, Ints]]:
    """Merge pixels four by four while they stay within `bound`: (size, rows, cols)."""
    alive = sinking.near & sinking.far
    size, found = 1, []
    while True:
        rows, cols = alive.shape[0] // 2, alive.shape[1] // 2
        fours = alive[: 2 * rows, : 2 * cols].reshape(rows, 2, cols, 2).all(axis=(1, 3))
        merged = np.zeros((rows, cols), bool)
        row, col = np.nonzero(fours)
        if len(row) and size < LARGEST_BLOCK:
            step = 2 * size
            good = _deviation(sinking.heights, row * step, col * step, step) <= bound
            merged[row[good], col[good]] = True
        left = alive.copy()
        left[: 2 * rows, : 2 * cols] &= ~merged.repeat(2, axis=0).repeat(2, axis=1)
        row, col = np.nonzero(left)
        found.append((size, row * size, col * size))
        if not merged.any():
            return found
        alive, size = merged, 2 * size


def _halves(corner: Ints, size: int, width: int) -> Ints:
    """Near and far triangle of square blocks, as node numbers, (2 n, 3)."""
    a, b = corner, corner + size
    c, d = a + size * width, b + size * width
    return np.concatenate([np.stack([a, c, d], axis=1), np.stack([a, d, b], axis=1)])


def _fans(corner: Ints, size: int, used: Bools) -> Ints:
    """Triangles of the blocks of one size, with every used node on their sides."""
    width = used.shape[1]
    along = np.arange(size)
    ring = np.concatenate(
        [along * width, size * width + along, (size - along) * width + size, size - along]
    )
    taken = used.ravel()[corner[:, None] + ring]
    plain = taken.sum(axis=1) == 4
    block, place = np.nonzero(taken[~plain])
    corner_of = corner[~plain]
    node = corner_of[block] + ring[place]
    last = np.append(block[1:] != block[:-1], True)[: len(block)]
    start = np.flatnonzero(np.roll(last, 1))
    following = np.roll(node, -1)
    following[last] = node[start]
    centre = corner_of[block] + size // 2 * (width + 1)
    fans = np.stack([centre, node, following], axis=1)
    return np.concatenate([_halves(corner[plain], size, width), fans])


def triangulate(sinking: Sinking, bound: float) -> Surface:
    """Cover what lies below the face with triangles between nodes of the relief.

    Parameters
    ----------
    sinking : Sinking
    bound : float
        Half the largest distance to the relief, mm; 0 merges only what is flat.

    Returns
    -------
    Surface
        Its outline lies on the face, or on the grid's border.
    """
    rows, width = sinking.heights.shape
    blocks = _blocks(sinking, bound)
    single = np.zeros(sinking.near.shape, bool)
    single[blocks[0][1], blocks[0][2]] = True
    merged = sinking.near & sinking.far & ~single
    number = np.arange(rows * width).reshape(rows, width)
    near = number[:-1, :-1][sinking.near & ~merged]
    far = number[:-1, :-1][sinking.far & ~merged]
    pieces = [
        np.stack([near, near + width, near + width + 1], axis=1),
        np.stack([far, far + width + 1, far + 1], axis=1),
    ]
    used = np.zeros((rows, width), bool)
    for piece in pieces:
        used.ravel()[piece] = True
    for size, row, col in blocks[1:]:
        for i, j in ((0, 0), (0, size), (size, 0), (size, size)):
            used[row + i, col + j] = True
    pieces += [_fans(number[row, col], size, used) for size, row, col in blocks[1:]]
    nodes, faces = np.unique(np.concatenate(pieces), return_inverse=True)
    height = sinking.heights.ravel()[nodes] / sinking.grid.pitch
    vertices = np.stack([nodes % width, -(nodes // width), height], axis=1)
    return Surface(sinking.grid, vertices, faces.reshape(-1, 3))


def edge_keys(faces: Ints, *, reverse: bool = False) -> Ints:
    """Give one number to each directed edge of each triangle, (3 f,)."""
    start, end = faces, np.roll(faces, -1, axis=1)
    span = int(faces.max(initial=0)) + 1
    return (end * span + start if reverse else start * span + end).ravel()


def has_repeats(keys: Ints) -> bool:
    """Say whether any number occurs twice (by sorting: np.unique hashes, 70 times slower)."""
    ordered = np.sort(keys)
    return bool((ordered[1:] == ordered[:-1]).any())


def outline(faces: Ints) -> Ints:
    """Directed edges with a triangle on their left only, (n, 2)."""
    there, back = edge_keys(faces), edge_keys(faces, reverse=True)
    either = np.minimum(there, back)
    order = np.argsort(either)
    fresh = np.diff(either[order], prepend=-1) != 0
    alone = there[order[fresh & np.append(fresh[1:], True)[: len(fresh)]]]
    return np.stack(np.divmod(alone, int(faces.max(initial=0)) + 1), axis=1)
