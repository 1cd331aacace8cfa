import numpy as np

from relieffab.layers.lines.edges import find_edges, split_at

SQUARE = np.array([[0, 1, 2], [0, 2, 3]])


def test_edges_of_two_triangles():
    edges = find_edges(SQUARE, 4)
    np.testing.assert_array_equal(edges.ends, [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]])
    np.testing.assert_array_equal(edges.faces, [[0, -1], [0, 1], [1, -1], [0, -1], [1, -1]])
    np.testing.assert_array_equal(edges.of_face, [[3, 1, 0], [4, 2, 1]])
    assert not edges.same_way.any()
    assert find_edges(SQUARE[:, [0, 2, 1]] * [[1], [1]], 4).same_way.sum() == 0
    assert find_edges(np.array([[0, 1, 2], [0, 3, 2]]), 4).same_way.tolist() == [
        False,
        True,
        False,
        False,
        False,
    ]


def test_edges_of_nothing():
    edges = find_edges(np.empty((0, 3), int), 0)
    assert edges.ends.shape == (0, 2)


def test_split_gives_each_side_its_own_vertices():
    # A strip of four triangles, parted across its middle edge (2, 3).
    faces = np.array([[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]])
    edges = find_edges(faces, 6)
    creased = (edges.ends == [2, 3]).all(axis=1)
    parted, parent = split_at(creased, edges, faces)
    np.testing.assert_array_equal(parent[parted], faces)
    assert not set(parted[:2].ravel()) & set(parted[2:].ravel())
    assert parted[0, 2] == parted[1, 2]


def test_a_lone_crease_edge_parts_nothing_at_its_ends():
    # A fan round vertex 0: one creased spoke leaves the fan joined the other way round.
    faces = np.array([[0, k, k % 6 + 1] for k in range(1, 7)])
    edges = find_edges(faces, 7)
    parted, parent = split_at((edges.ends == [0, 1]).all(axis=1), edges, faces)
    assert len(set(parted[:, 0])) == 1
    np.testing.assert_array_equal(parent[parted], faces)
