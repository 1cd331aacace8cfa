import numpy as np
import pytest

from relieffab.layers.lines.curvature import curvature
from relieffab.layers.lines.edges import find_edges
from relieffab.layers.lines.surface import bounding_radius, feature_size, prepare
from relieffab.subject import shapes


def prepared(vertices, faces):
    edges = find_edges(faces, len(vertices))
    return prepare(vertices, faces, np.zeros(len(edges.ends), bool), edges)


def test_feature_size_takes_the_lesser_bound():
    ball = prepared(*shapes.sphere(5.0, 800))
    assert ball.radius == pytest.approx(5.0, rel=0.01)
    assert ball.size == pytest.approx(0.01 / 0.2, rel=0.03)
    plane = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    assert prepared(plane, np.array([[0, 1, 2], [0, 2, 3]])).size == pytest.approx(
        0.05 * np.sqrt(0.5)
    )


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_feature_size_grows_with_the_model(scale):
    vertices, faces = shapes.torus(3.0, 1.0, (40, 30))
    one, two = prepared(vertices, faces), prepared(scale * vertices + 7 * scale, faces)
    assert two.size == pytest.approx(scale * one.size)


def test_feature_size_weighs_by_area_not_by_vertices():
    # A flat sheet with a hundred curved vertices in a speck of it.
    def surface(u, v):
        x, y = u**3, v**3
        bump = 0.5 * np.maximum(1e-6 - x * x - y * y, 0)
        return np.stack([x, y, bump], axis=1)

    vertices, faces = shapes.sheet(surface, (80, 80))
    surface = prepared(vertices, faces)
    bent = np.abs(surface.bend.principal).max(axis=0) > 0.1
    assert bent.mean() > 0.01
    assert surface.size == pytest.approx(0.05 * surface.radius)


def test_nothing_has_no_size():
    bend = curvature(np.zeros((4, 3)), np.empty((0, 3), int))
    assert bounding_radius(np.empty((0, 3))) == 0.0
    assert feature_size(bend, 0.0) == 0.0
