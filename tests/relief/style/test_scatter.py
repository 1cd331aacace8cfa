import numpy as np
import pytest
from scipy.spatial import cKDTree

from relieffab.relief.style.scatter import scatter


def ring():
    away = np.hypot(*(np.indices((90, 120)) - 50.0))
    return (away > 15) & (away < 45)


@pytest.mark.parametrize("apart", [3.0, 7.5])
def test_places_keep_their_distance_and_leave_no_room(apart):
    where = ring()
    places = scatter(where, apart, np.random.default_rng(0))
    away, _ = cKDTree(places).query(places, k=2)
    assert away[:, 1].min() >= apart
    assert away[:, 1].mean() < 1.25 * apart
    # Every pixel threw a dart, which was kept or too near one that was.
    gap, _ = cKDTree(places).query(np.argwhere(where))
    assert gap.max() < apart + np.hypot(0.5, 0.5)
    i, j = np.rint(places).astype(int).T
    assert where[i, j].all()


def test_the_same_chance_gives_the_same_places():
    one, other = (scatter(ring(), 5.0, np.random.default_rng(4)) for _ in range(2))
    assert (one == other).all()


def test_nowhere_gives_none():
    assert scatter(np.zeros((5, 5), bool), 2.0, np.random.default_rng(0)).shape == (0, 2)
