"""The scarab is one closed body within its stated size."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from relieffab.subject import scarab


@pytest.fixture(scope="module", params=[0.5, 0.28])
def mesh(request):
    return scarab(cell=request.param)


def edges(faces):
    return faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def test_every_edge_is_walked_once_each_way(mesh):
    vertices, faces = mesh
    start, end = edges(faces).T
    forth, back = (np.sort(a * len(vertices) + b) for a, b in ((start, end), (end, start)))
    assert (np.diff(forth) > 0).all()
    np.testing.assert_array_equal(forth, back)


def test_it_is_one_body(mesh):
    vertices, faces = mesh
    ends = edges(faces)
    links = coo_array((np.ones(len(ends)), ends.T), shape=(len(vertices),) * 2)
    assert connected_components(links, directed=False)[0] == 1


def test_faces_look_outward(mesh):
    vertices, faces = mesh
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(31_300, rel=0.02)


def test_it_has_its_stated_size(mesh):
    vertices, _ = mesh
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    np.testing.assert_allclose(high - low, (113.0, 81.8, 13.6), atol=0.5)
    np.testing.assert_allclose(low[0], -high[0], atol=1e-3)
    assert low[2] == pytest.approx(0, abs=1e-3)


def test_the_body_stands_above_the_wings_and_they_above_the_back(mesh):
    vertices, _ = mesh

    def top(x, y, r):
        near = np.hypot(vertices[:, 0] - x, vertices[:, 1] - y) < r
        return vertices[near, 2].max()

    assert top(3, -8, 3) > 12.5
    assert top(0, 30.2, 3) == pytest.approx(10.2, abs=0.2)
    assert 9 < top(24, -3, 4) < 12
    assert 6.5 < top(51, 38, 4) < 8.5


def test_it_is_its_own_mirror_image(mesh):
    vertices, _ = mesh
    right = np.sort(vertices[vertices[:, 0] > 1e-3, 0])
    left = np.sort(-vertices[vertices[:, 0] < -1e-3, 0])
    np.testing.assert_allclose(left, right, atol=1e-4)
