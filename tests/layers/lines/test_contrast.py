import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.contrast import FLAT_ON, LEAST, contrast, contrast_strength
from relieffab.layers.raster import Raster, rasterise
from relieffab.subject import shapes

GRID = Grid(40, 200, 0.1, (0.0, 4.0))


def across(angles_of_x, depth=None):
    """Contrast of a line along Y at x = 10 in a picture that depends on X alone."""
    x = np.broadcast_to(GRID.to_xy(0, np.arange(200) + 0.5)[0], GRID.shape)
    angles = np.where(np.isnan(angles_of_x(x)), -1.0, angles_of_x(x))
    depth = np.zeros(GRID.shape) if depth is None else depth(x)
    raster = Raster(depth, np.where(angles < 0, -1, 0).astype(np.int32))
    line = np.array([[10.0, y, 0.0] for y in (1.0, 2.0, 3.0)])
    normals = np.tile([0.6, 0.0, 0.8], (3, 1))
    chains = Chains(line, np.ones(3), normals, np.zeros(3), np.array([0, 3]))
    return contrast(chains, angles, raster, GRID)


def test_the_lesser_of_two_falls_counts():
    def valley(x):
        return 1.0 - np.where(x < 10, 0.2, 0.05) * np.minimum(np.abs(x - 10), 2)

    np.testing.assert_allclose(across(valley), 0.1, atol=0.01)


def test_a_fall_ends_where_a_deeper_valley_begins():
    def valleys(x):
        # A ripple 0.06 high on the right, then a valley that is deeper still.
        ripple = np.where(x < 12, 0.06 * np.sin(np.pi * (x - 10) / 2), -0.3 * (x - 12))
        return 1.0 - np.where(x < 10, 0.2 * (10 - x), np.clip(ripple, -0.5, None))

    np.testing.assert_allclose(across(valleys), 0.06, atol=0.01)


def test_a_slope_is_no_valley():
    np.testing.assert_allclose(across(lambda x: 1 - 0.05 * x), 0.0, atol=0.02)


def test_what_is_hidden_before_it_falls_counts_in_full():
    def half(x):
        return 1.0 - np.where(x < 10, 0.1 * np.minimum(10 - x, 2), 0.0)

    np.testing.assert_allclose(across(half), 0.0, atol=0.01)
    hidden = across(half, depth=lambda x: np.where(x > 10.2, 5.0, 0.0))
    np.testing.assert_allclose(hidden, 0.2, atol=0.02)
    gone = across(lambda x: np.where(x > 10.2, np.nan, half(x)))
    np.testing.assert_allclose(gone, 0.2, atol=0.02)


def test_hidden_on_both_sides_counts_most():
    both = across(lambda x: np.where(np.abs(x - 10) > 0.25, np.nan, 1.0))
    np.testing.assert_allclose(both, FLAT_ON)


@pytest.mark.parametrize("height", [0.02, 0.3])
def test_shallow_ripples_are_weak_and_deep_ones_strong(prepared, height):
    def surface(u, v):
        x, y = 20 * u, 4 * v
        # On a slope, so that n.v has one valley a ripple.
        return np.stack([x, y, 0.5 * x + height * np.sin(np.pi * x)], axis=1)

    vertices, faces = shapes.sheet(surface, (200, 40))
    ready = prepared(vertices, faces)
    raster = rasterise(vertices, faces, GRID)
    # n.v is least where the slope is steepest: at even x.
    line = np.array([[10.0, y, 0.0] for y in (1.0, 2.0, 3.0)])
    normals = np.tile([-0.6, 0.0, 0.8], (3, 1))
    chains = Chains(line, np.ones(3), normals, np.zeros(3), np.array([0, 3]))
    steep, gentle = (np.arctan(0.5 + s * np.pi * height) for s in (1, -1))
    fall = steep - abs(gentle) if gentle > 0 else steep
    want = fall / (3 * LEAST + fall)
    np.testing.assert_allclose(contrast_strength(chains, ready, raster, GRID), want, atol=0.03)


def test_no_lines_have_no_strength(prepared):
    vertices, faces = shapes.sphere(3.0, 500)
    raster = rasterise(vertices + np.array([10, 2, 0]), faces, GRID)
    none = Chains(np.empty((0, 3)), np.empty(0), np.empty((0, 3)), np.empty(0), np.array([0]))
    assert len(contrast_strength(none, prepared(vertices, faces), raster, GRID)) == 0
