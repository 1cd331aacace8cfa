import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.panel.lattice import insert, turn, two_triangles

ROWS, WIDTH = 9, 13


def grown(nodes):
    """Triangles after nodes were put in one after the other, and their mates."""
    most = 2 * (ROWS - 1) * (WIDTH - 1)
    corners, mates = np.empty((2, 3 * most), np.int64)
    edges, fresh = np.empty((2, most + 8), np.int64)
    two_triangles(corners, mates, ROWS, WIDTH)
    total, changed = 2, 0
    for node in nodes:
        before = corners[: 3 * total].copy()
        total, changed = insert(corners, mates, total, 0, node, edges, fresh, WIDTH)
        same = corners[: len(before)] == before
        assert (
            same.reshape(-1, 3)
            .all(axis=1)[np.setdiff1d(np.arange(total), fresh[:changed])[: len(before) // 3]]
            .all()
        )
    return corners[: 3 * total].reshape(-1, 3), mates[: 3 * total]


def place(node):
    """On the triangular lattice: both axes and one diagonal are 1 long."""
    col, row = node % WIDTH, node // WIDTH
    return np.array([col - row / 2, row * np.sqrt(3) / 2])


NODES = st.permutations(range(ROWS * WIDTH)).map(
    lambda order: [
        n for n in order if n not in (0, WIDTH - 1, ROWS * WIDTH - WIDTH, ROWS * WIDTH - 1)
    ]
)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(NODES, st.integers(0, ROWS * WIDTH - 4))
def test_triangles_are_delaunay_and_cover_the_lattice(order, count):
    triangles, mates = grown(order[:count])
    areas = [turn(a, b, c, WIDTH) for a, b, c in triangles.tolist()]
    assert min(areas) > 0
    assert sum(areas) == 2 * (ROWS - 1) * (WIDTH - 1)
    inner = np.flatnonzero(mates >= 0)
    assert (mates[mates[inner]] == inner).all()
    flat = triangles.ravel()
    assert (flat[mates[inner]] == np.roll(triangles, -1, axis=1).ravel()[inner]).all()
    used = np.unique(flat)
    for a, b, c in triangles[:: max(1, len(triangles) // 8)].tolist():
        p, q, r = place(a), place(b), place(c)
        centre = np.linalg.solve(2 * np.stack([q - p, r - p]), [q @ q - p @ p, r @ r - p @ p])
        radius = np.linalg.norm(p - centre)
        assert min(np.linalg.norm(place(n) - centre) for n in used) >= radius - 1e-9


@pytest.mark.parametrize("seed", range(3))
def test_all_nodes_give_the_two_triangles_of_each_pixel(seed):
    order = np.random.default_rng(seed).permutation(ROWS * WIDTH).tolist()
    order = [n for n in order if n not in (0, WIDTH - 1, ROWS * WIDTH - WIDTH, ROWS * WIDTH - 1)]
    triangles, _ = grown(order)
    a = np.arange(ROWS * WIDTH).reshape(ROWS, WIDTH)[:-1, :-1].ravel()
    d = a + WIDTH + 1
    expected = {frozenset(t) for t in zip(a, a + 1, d, strict=True)}
    expected |= {frozenset(t) for t in zip(a, a + WIDTH, d, strict=True)}
    assert {frozenset(t) for t in triangles.tolist()} == expected
