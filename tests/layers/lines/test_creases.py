import numpy as np

from relieffab.layers.lines.creases import find_creases, turns
from relieffab.layers.lines.edges import find_edges
from relieffab.subject import shapes

CUBE, BOX = shapes.box((1.0, 1.0, 1.0))


def creases(faces, shortest):
    return find_creases(CUBE, faces, find_edges(faces, 8), shortest)


def test_a_cube_has_twelve_creases():
    edges = find_edges(BOX, 8)
    found = creases(BOX, 5.0)
    assert found.sum() == 12
    np.testing.assert_allclose(np.abs(np.diff(CUBE[edges.ends[found]], axis=1)).sum(axis=2), 1.0)
    np.testing.assert_allclose(turns(CUBE, BOX, edges)[found], 90.0)
    np.testing.assert_allclose(turns(CUBE, BOX, edges)[~found], 0.0, atol=1e-5)
    assert creases(BOX, 13.0).sum() == 0


def test_odd_winding_does_not_matter():
    flipped = BOX.copy()
    flipped[::2] = flipped[::2, ::-1]
    assert (creases(flipped, 5.0) == creases(BOX, 5.0)).all()


def folded(degrees):
    """Two squares that meet at an angle along an edge of 1 mm, open at both ends."""
    a = np.radians(degrees)
    vertices = np.array(
        [[0, 0, 0], [0, 1, 0], [-1, 0, 0], [-1, 1, 0]] + [[np.cos(a), y, np.sin(a)] for y in (0, 1)]
    )
    return vertices, np.array([[0, 1, 2], [1, 3, 2], [0, 4, 1], [1, 4, 5]])


def fold(degrees, shortest):
    vertices, faces = folded(degrees)
    return find_creases(vertices, faces, find_edges(faces, 6), shortest).sum()


def test_creases_that_end_in_the_open_must_be_long():
    assert fold(90, 1 / 12.1) == 1
    assert fold(90, 1 / 11.9) == 0


def test_a_crease_must_be_hard_somewhere():
    assert fold(65, 0.01) == 1
    assert fold(55, 0.01) == 0
    assert fold(35, 0.0) == 0


def test_a_boundary_is_no_crease():
    vertices, faces = folded(0.0)
    assert turns(vertices, faces, find_edges(faces, 6)).max() < 1e-5
