import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from relieffab.grid import Grid
from relieffab.panel.edges import outline
from relieffab.panel.sinking import sink
from relieffab.panel.triangulate import triangulate
from relieffab.relief.model import Relief
from relieffab.stock import Stock

STOCK = Stock(100, 100, 10)
HEIGHTS = st.one_of(st.just(0.0), st.sampled_from([-0.5, -1.0, -1e-5]), st.floats(-2, 0, width=16))


def surface_of(heights, bound=0.0):
    heights = np.array(heights, float)
    rows, cols = heights.shape[0] - 1, heights.shape[1] - 1
    grid = Grid(rows, cols, 1.0, (5.0, 5.0 + rows))
    relief = Relief(grid, heights, np.ones((rows, cols), bool), 2.0)
    return relief, triangulate(sink(relief, STOCK), bound)


def height_by_search(surface, x, y):
    """The slow twin of sampling: try every triangle for the point."""
    for a, b, c in surface.points()[surface.faces]:
        frame = np.stack([b - a, c - a], axis=1)[:2]
        u, v = np.linalg.solve(frame, np.array([x, y]) - a[:2])
        if min(u, v, 1 - u - v) >= -1e-9:
            return a[2] + u * (b - a)[2] + v * (c - a)[2]
    return 0.0


@settings(max_examples=60, deadline=None, derandomize=True)
@given(arrays(float, st.tuples(st.integers(2, 9), st.integers(2, 9)), elements=HEIGHTS))
def test_without_a_bound_the_surface_is_the_relief(heights):
    relief, surface = surface_of(heights)
    rng = np.random.default_rng(0)
    size = np.subtract(heights.shape, 1)[::-1]
    for x, y in 5 + size * rng.random((10, 2)):
        assert height_by_search(surface, x, y) == pytest.approx(relief.height_at(x, y), abs=2e-6)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    arrays(float, (9, 9), elements=st.floats(-0.25, -0.125)),
    st.sampled_from([0.02, 0.05, 0.1]),
)
def test_no_point_is_further_than_the_bound(heights, bound):
    relief, surface = surface_of(heights, bound)
    rng = np.random.default_rng(0)
    for x, y in 5 + 8 * rng.random((40, 2)):
        gap = height_by_search(surface, x, y) - relief.height_at(x, y)
        assert abs(gap) <= bound + 1e-9


def test_a_flat_floor_needs_few_triangles():
    h = np.zeros((49, 49))
    h[16:33, 16:33] = -1.0
    _, surface = surface_of(h)
    assert len(surface.faces) < 100


def test_a_plane_is_two_triangles():
    rows, cols = np.mgrid[0:17, 0:17]
    _, surface = surface_of(-0.5 - 0.01 * rows - 0.02 * cols, 1e-9)
    assert len(surface.faces) == 2


def test_the_outline_lies_on_the_face(bumpy):
    surface = triangulate(sink(bumpy, STOCK), 0.01)
    rim = surface.vertices[outline(surface.faces).ravel()]
    assert (rim[:, 2] == 0).all()
