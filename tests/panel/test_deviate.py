import numpy as np
import pytest

from relieffab.panel.deviate import deviations


def height(h, x, y):
    """The relief at a point, by its pixel's two triangles."""
    i, j = min(int(y), h.shape[0] - 2), min(int(x), h.shape[1] - 2)
    u, v = x - j, y - i
    a, b, c, d = h[i, j], h[i, j + 1], h[i + 1, j], h[i + 1, j + 1]
    return a + u * (b - a) + v * (d - b) if u > v else a + v * (c - a) + u * (d - c)


def by_sampling(h, corners, count=200):
    """The slow twin: the largest distance at many points of a triangle."""
    worst = 0.0
    for s in range(count + 1):
        for t in range(count + 1 - s):
            x, y, z = (corners * (np.array([s, t, count - s - t]) / count)[:, None]).sum(axis=0)
            worst = max(worst, abs(z - height(h, x, y)))
    return worst


@pytest.mark.parametrize("seed", range(8))
def test_as_large_as_many_samples_find_and_hardly_larger(seed):
    rng = np.random.default_rng(seed)
    h = rng.random((7, 9))
    corners = rng.random((3, 3)) * (8, 6, 1)
    found = deviations(h, corners, np.array([[0, 1, 2]]))[0]
    sampled = by_sampling(h, corners)
    assert sampled <= found + 1e-9
    assert found - sampled < 0.1


def test_between_nodes_that_agree():
    h = np.zeros((3, 3))
    h[0, 1] = -1.0
    # The other diagonal of the far left pixel: half of 1 at the pixel's centre.
    square = np.array([[0.0, 0, 0], [1, 0, -1], [1, 1, 0], [0, 1, 0]])
    wrong, right = np.array([[0, 1, 3], [1, 2, 3]]), np.array([[0, 1, 2], [0, 2, 3]])
    assert deviations(h, square, wrong) == pytest.approx([0.5, 0.5])
    assert deviations(h, square, right) == pytest.approx([0.0, 0.0])


def test_a_node_in_the_middle_counts():
    h = np.zeros((11, 11))
    h[5, 4] = -0.7
    corners = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0]])
    assert deviations(h, corners, np.array([[0, 1, 2]])) == pytest.approx([0.7])


def test_what_stands_upright_or_lies_outside_is_not_looked_at():
    h = np.zeros((3, 3))
    points = np.array([[0.0, 0, 0], [2, 0, 0], [2, 0, -5], [9, 9, -5], [9, 8, -5], [8, 9, -5]])
    assert deviations(h, points, np.array([[0, 1, 2], [3, 4, 5]])).tolist() == [0.0, 0.0]
