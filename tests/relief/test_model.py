import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.grid import Grid
from relieffab.relief.model import Relief, sunk_pixels

GRID = Grid(4, 6, 0.5, (1.0, 3.0))


def relief(heights, depth=2.0):
    return Relief(GRID, heights, np.ones(GRID.shape, bool), depth)


def test_height_is_exact_at_nodes_and_linear_on_the_two_triangles():
    rng = np.random.default_rng(0)
    r = relief(-rng.random(GRID.node_shape))
    i, j = np.indices(GRID.node_shape)
    np.testing.assert_allclose(r.height_at(*GRID.to_xy(i, j)), r.heights)
    h = r.heights
    # On the split from far left to near right, and at both centroids.
    middle = r.height_at(*GRID.to_xy(1.5, 2.5))
    assert middle == pytest.approx((h[1, 2] + h[2, 3]) / 2)
    lower = r.height_at(*GRID.to_xy(1 + 2 / 3, 2 + 1 / 3))
    assert lower == pytest.approx((h[1, 2] + h[2, 2] + h[2, 3]) / 3)
    upper = r.height_at(*GRID.to_xy(1 + 1 / 3, 2 + 2 / 3))
    assert upper == pytest.approx((h[1, 2] + h[1, 3] + h[2, 3]) / 3)


def test_beyond_the_grid_is_the_face():
    r = relief(np.full(GRID.node_shape, -1.0))
    assert r.height_at(0.99, 2.0) == 0
    assert r.height_at(1.0, 2.0) == -1


@pytest.mark.parametrize(
    ("heights", "words"),
    [
        (np.zeros((4, 6)), "does not fit"),
        (np.full(GRID.node_shape, np.nan), "NaN"),
        (np.full(GRID.node_shape, -2.1), "bounds"),
        (np.full(GRID.node_shape, 0.1), "bounds"),
    ],
)
def test_what_is_no_relief_is_refused(heights, words):
    with pytest.raises(InputError, match=words):
        relief(heights)


def test_heights_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        relief(np.zeros(GRID.node_shape)).heights[0, 0] = -1


def test_what_is_sunk_beside_the_figure():
    mask = np.zeros((4, 6), bool)
    mask[1:3, 1:3] = True
    heights = np.zeros((5, 7))
    heights[1:4, 1:4] = -1.0  # the figure, down to its edge
    np.testing.assert_array_equal(sunk_pixels(heights, mask), mask)
    heights[2, 5] = -0.2  # a peck
    mask[1:3, 4:6] = True
    np.testing.assert_array_equal(sunk_pixels(heights, mask & (np.arange(6) < 3)), mask)
