import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.grid import Grid
from relieffab.layers.raster import interpolate, rasterise

GRID = Grid(24, 32, 0.5, (0.0, 12.0))


def slow_raster(vertices, faces, grid):
    """Every pixel against every triangle by barycentric coordinates."""
    depth = np.full(grid.shape, -np.inf)
    for i in range(grid.rows):
        for j in range(grid.cols):
            x, y = grid.to_xy(i + 0.5, j + 0.5)
            for a, b, c in vertices[faces]:
                edges = np.array([[b[0] - a[0], c[0] - a[0]], [b[1] - a[1], c[1] - a[1]]])
                if abs(np.linalg.det(edges)) < 1e-12:
                    continue
                u, v = np.linalg.solve(edges, [x - a[0], y - a[1]])
                if u >= -1e-12 and v >= -1e-12 and u + v <= 1 + 1e-12:
                    depth[i, j] = max(depth[i, j], a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]))
    return depth


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1))
def test_agrees_with_every_pixel_against_every_triangle(seed):
    rng = np.random.default_rng(seed)
    vertices = rng.uniform([-4, -4, -5], [20, 16, 5], (12, 3))
    faces = rng.integers(0, 12, (8, 3))
    np.testing.assert_allclose(
        rasterise(vertices, faces, GRID).depth, slow_raster(vertices, faces, GRID), atol=1e-9
    )


def test_a_shared_edge_through_pixel_centres_leaves_no_gap():
    # The diagonal passes exactly through centres.
    vertices = np.array([[0.0, 0, 0], [12, 0, 0], [12, 12, 0], [0, 12, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    assert rasterise(vertices, faces, GRID).mask[:, :24].all()


def test_depth_of_a_plane_is_exact_at_centres():
    vertices = np.array([[-50.0, -50, 0], [90, -50, 0], [0, 90, 0]])
    vertices[:, 2] = 0.3 * vertices[:, 0] - 0.7 * vertices[:, 1] + 2
    depth = rasterise(vertices, np.array([[0, 1, 2]]), GRID).depth
    i, j = np.indices(GRID.shape)
    x, y = GRID.to_xy(i + 0.5, j + 0.5)
    np.testing.assert_allclose(depth, 0.3 * x - 0.7 * y + 2, atol=1e-12)


def test_nearest_wins_whatever_the_order():
    near = np.array([[-9.0, -9, 2], [40, -9, 2], [-9, 40, 2]])
    far = near - [0, 0, 3]
    vertices = np.concatenate([far, near])
    for faces in ([[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]):
        assert (rasterise(vertices, np.array(faces), GRID).depth == 2).all()


def test_values_are_carried_linearly():
    vertices = np.array([[-50.0, -50, 0], [90, -50, 1], [0, 90, 2]])
    faces = np.array([[0, 1, 2]])
    raster = rasterise(vertices, faces, GRID)
    got = interpolate(raster, vertices, faces, vertices, GRID)
    np.testing.assert_allclose(got[..., 2], raster.depth, atol=1e-12)
    np.testing.assert_allclose(got[3, 5, :2], GRID.to_xy(3.5, 5.5), atol=1e-12)


def test_a_sliver_through_a_centre_is_no_division_by_zero():
    # Its area is so small that the edge functions at the centre round to 0.
    y = GRID.to_xy(3.5, 0.0)[1]
    vertices = np.array([[0.0, y, 0], [9.0, y, 0], [4.5, y + 1e-17, 0], [4.5, y + 4e-16, 1]])
    faces = np.array([[0, 1, 2], [0, 1, 3]])
    assert np.isfinite(
        rasterise(vertices, faces, GRID).depth[rasterise(vertices, faces, GRID).mask]
    ).all()
