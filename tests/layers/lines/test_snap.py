import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.lines.chains import Chains
from relieffab.layers.lines.snap import snap

GRID = Grid(40, 60, 0.1, (0.0, 4.0))


def chains(x, normal, slack=2.0):
    y = np.linspace(1.0, 3.0, 9)
    points = np.stack([np.full(9, x), y, np.zeros(9)], axis=1)
    return Chains(points, np.ones(9), np.tile(normal, (9, 1)), np.full(9, slack), np.array([0, 9]))


def step(at=3.0, fall=5.0, far=0.0):
    """Depth that falls at x from `fall` to `far`."""
    x, _ = GRID.to_xy(0, np.arange(60) + 0.5)
    return np.broadcast_to(np.where(x < at, fall, far), GRID.shape)


@pytest.mark.parametrize("x", [2.3, 2.7, 3.3, 3.8])
def test_a_contour_moves_to_the_step_from_either_side(x):
    moved, real = snap(chains(x, [1.0, 0.0, 0.0]), step(), GRID)
    assert real.all()
    np.testing.assert_allclose(moved.points[:, 0], 3.0, atol=0.5 * GRID.pitch)
    np.testing.assert_array_equal(moved.points[:, 1:], chains(x, [1.0, 0, 0]).points[:, 1:])


def test_the_background_is_a_step_too():
    moved, _ = snap(chains(2.6, [1.0, 0.0, 0.0]), step(far=-np.inf), GRID)
    np.testing.assert_allclose(moved.points[:, 0], 3.0, atol=0.5 * GRID.pitch)


def test_of_two_steps_the_nearer_counts():
    depth = np.minimum(step(2.5, fall=5.0, far=3.0), step(3.8, fall=5.0, far=0.0))
    moved, _ = snap(chains(2.8, [1.0, 0.0, 0.0]), depth, GRID)
    np.testing.assert_allclose(moved.points[:, 0], 2.5, atol=0.5 * GRID.pitch)


@pytest.mark.parametrize(
    ("line", "depth"),
    [
        (chains(2.6, [-1.0, 0.0, 0.0]), step()),  # the surface ends on the other side
        (chains(1.2, [1.0, 0.0, 0.0]), step()),  # too far away
        (chains(2.6, [1.0, 0.0, 0.0], slack=0.05), step()),  # finer triangles than pixels
        (chains(2.6, [1.0, 0.0, 0.0]), step(fall=0.3)),  # a slope, no step
        (chains(2.6, [0.0, 0.0, 1.0]), step()),  # no side to look to
    ],
)
def test_where_it_has_no_business_nothing_moves(line, depth):
    moved, real = snap(line, depth, GRID)
    np.testing.assert_array_equal(moved.points, line.points)
    assert real.all() == (line.slack[0] < 0.1)
