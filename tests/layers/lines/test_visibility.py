import numpy as np

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.visibility import borders_background, look_up, visible

GRID = Grid(20, 20, 0.5, (0.0, 10.0))


def chain(points, normal=(0.0, 0.0, 1.0), slack=0.0):
    points = np.asarray(points, float)
    n = len(points)
    normals = np.tile(np.asarray(normal, float), (n, 1))
    return Chains(points, np.ones(n), normals, np.full(n, slack), np.array([0, n]))


def test_look_up_reads_the_pixel_under_a_point():
    image = np.arange(400.0).reshape(20, 20)
    x, y = np.array([0.1, 0.6, 9.9, -0.1, 5.0]), np.array([9.9, 9.4, 0.1, 5.0, 10.1])
    np.testing.assert_array_equal(look_up(image, x, y, GRID, -1.0), [0, 21, 399, -1, -1])


def test_behind_a_wall_is_hidden_and_its_edge_is_seen():
    depth = np.zeros((20, 20))
    depth[:, 10:] = 5.0  # a near half from x = 5 on
    points = [[2.0, 5.0, 0.0], [5.2, 5.0, 5.0], [8.0, 5.0, 0.0], [8.0, 5.0, 5.0], [8.0, 5.0, 9.0]]
    assert visible(chain(points), depth, GRID).tolist() == [True, True, False, True, True]


def test_tolerance_grows_with_slope_and_triangles_seen_from_the_side():
    depth = np.full((20, 20), 1.0)
    point = [[5.0, 5.0, 0.0]]
    side = (1.0, 0.0, 0.0)
    assert not visible(chain(point), depth, GRID)[0]
    assert not visible(chain(point, slack=2.0), depth, GRID)[0]
    assert visible(chain(point, side), depth, GRID)[0]
    assert not visible(chain(point, side), depth + 3, GRID)[0]
    assert visible(chain(point, side, slack=2.0), depth + 3, GRID)[0]


def test_outside_the_grid_nothing_hides():
    assert visible(chain([[-5.0, -5.0, -9.0]]), np.full((20, 20), 1.0), GRID)[0]


def test_background_lies_where_the_normal_points():
    mask = np.zeros((20, 20), bool)
    mask[:, :10] = True  # the figure ends at x = 5
    point = [[4.9, 5.0, 0.0]]
    assert borders_background(chain(point, (1, 0, 0)), mask, GRID, reach=1.0)[0]
    assert not borders_background(chain(point, (-1, 0, 0)), mask, GRID, reach=1.0)[0]
    assert not borders_background(chain([[3.0, 5.0, 0.0]], (1, 0, 0)), mask, GRID, reach=1.0)[0]
    assert np.isfinite(borders_background(chain(point), mask, GRID, reach=1.0)).all()
