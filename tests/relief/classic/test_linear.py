import numpy as np

from relieffab.relief.classic.linear import linear
from relieffab.relief.model import nodes_of
from relieffab.relief.targets import to_nodes


def test_a_plane_stays_a_plane(slanted):
    h = linear(slanted, 2.0)
    rows, cols = np.nonzero(nodes_of(slanted.mask))
    inner = h[rows.min() + 1 : rows.max(), cols.min() + 1 : cols.max()]
    np.testing.assert_allclose(np.diff(inner, 2, axis=0), 0, atol=1e-12)
    np.testing.assert_allclose(np.diff(inner, 2, axis=1), 0, atol=1e-12)
    assert (np.diff(inner, axis=1) > 0).all()


def test_the_order_of_depth_is_kept(layers):
    nodes = nodes_of(layers.mask)
    seen = to_nodes(layers.depth, layers.mask.astype(float))[nodes]
    order = np.argsort(seen)
    assert (np.diff(linear(layers, 3.0)[nodes][order]) >= 0).all()


def test_twice_the_depth_is_twice_as_deep(layers):
    np.testing.assert_allclose(linear(layers, 4.0), 2 * linear(layers, 2.0))
