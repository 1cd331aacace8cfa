import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.art.fill import inside, winding

GRID = Grid(40, 50, 0.25, (-2.0, 8.0))


def twin(points, x, y):
    """Turns round one point: the angles its edges are seen under, added up."""
    away = points - [x, y]
    after = np.roll(away, -1, axis=0)
    turn = np.arctan2(away[:, 0] * after[:, 1] - away[:, 1] * after[:, 0], (away * after).sum(1))
    return round(turn.sum() / (2 * np.pi))


@pytest.mark.parametrize("seed", range(4))
def test_turns_are_counted_as_angles_add_up(seed):
    rng = np.random.default_rng(seed)
    rings = [rng.uniform([-4, -4], [12, 10], (n, 2)) for n in (3, 7)]
    count = winding(rings, GRID)
    for i in range(0, 40, 3):
        for j in range(0, 50, 3):
            x, y = GRID.to_xy(i + 0.5, j + 0.5)
            assert count[i, j] == sum(twin(ring, x, y) for ring in rings)


def test_rules_of_filling():
    square = np.array([[0, 0], [8, 0], [8, 6], [0, 6]], float)
    inner = square * 0.5 + [2, 1.5]
    x, y = GRID.to_xy(*np.meshgrid(np.arange(40) + 0.5, np.arange(50) + 0.5, indexing="ij"))
    within = [(abs(x - 4) < a) & (abs(y - 3) < b) for a, b in ((4, 3), (2, 1.5))]
    np.testing.assert_array_equal(inside([square, inner], "nonzero", GRID), within[0])
    hole = within[0] & ~within[1]
    np.testing.assert_array_equal(inside([square, inner], "evenodd", GRID), hole)
    np.testing.assert_array_equal(inside([square, inner[::-1]], "nonzero", GRID), hole)
    assert not inside([], "nonzero", GRID).any()


def test_corners_on_pixel_centres_count_once():
    x, y = GRID.to_xy(np.array([10.5, 10.5, 20.5, 20.5]), np.array([10.5, 30.5, 30.5, 10.5]))
    assert inside([np.stack([x, y], axis=1)], "nonzero", GRID).sum() == 10 * 20
