import numpy as np

from relieffab.layers.lines.slopes import slope, slope_of_directed
from relieffab.subject import shapes

GRADIENT = np.array([0.7, -0.4, 0.0])


def plane(prepared):
    rng = np.random.default_rng(1)

    def surface(u, v):
        inner = (u > 0) & (u < 1) & (v > 0) & (v < 1)
        return np.stack([u + 0.02 * inner * rng.uniform(-1, 1, len(u)), v, 0 * u], axis=1)

    return prepared(*shapes.sheet(surface, (12, 12)))


def test_the_slope_of_a_linear_field_is_exact(prepared):
    surface = plane(prepared)
    along = np.random.default_rng(2).normal(size=surface.vertices.shape)
    got = slope(surface, surface.vertices @ GRADIENT + 3, along)
    np.testing.assert_allclose(got, along @ GRADIENT, atol=1e-12)


def test_directed_fields_may_be_given_in_either_sense(prepared):
    surface = plane(prepared)
    along = np.broadcast_to([0.6, 0.8, 0.0], surface.vertices.shape)
    field = surface.vertices @ GRADIENT
    flips = np.where(np.random.default_rng(3).random(len(field)) < 0.5, -1.0, 1.0)
    want = along @ GRADIENT
    np.testing.assert_allclose(slope_of_directed(surface, field, along), want, atol=1e-12)
    flipped = slope_of_directed(surface, flips * field, flips[:, None] * along)
    np.testing.assert_allclose(flipped, want, atol=1e-12)


def test_flat_triangles_do_no_harm(prepared):
    surface = prepared(
        np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 1, 3]])
    )
    along = np.ones((4, 3))
    assert np.isfinite(slope(surface, np.arange(4.0), along)).all()
    assert np.isfinite(slope_of_directed(surface, np.arange(4.0), along)).all()
