from itertools import pairwise

import numpy as np
import pytest

from relieffab.grid import Grid
from relieffab.layers.image.vector import chains_of

GRID = Grid(60, 80, 0.5, (0.0, 30.0))
FLAT = np.zeros((2, 60, 80))


def lengths(chains):
    parts = [chains.points[a:b, :2] for a, b in pairwise(chains.begin)]
    return [float(np.hypot(*np.diff(part, axis=0).T).sum()) for part in parts]


def test_a_straight_line_is_one_chain_through_pixel_centres():
    image = np.zeros(GRID.shape, bool)
    image[30, 10:50] = True
    chains = chains_of(image, np.full(GRID.shape, 0.7), FLAT, GRID)
    assert lengths(chains) == [pytest.approx(39 * 0.5)]
    np.testing.assert_allclose(chains.points[:, 1], 30.0 - 30.5 * 0.5)
    np.testing.assert_allclose(chains.strength, 0.7)


def test_a_ring_closes_and_a_cross_has_four_arms():
    i, j = np.indices(GRID.shape)
    ring = np.abs(np.hypot(i - 30, j - 40) - 20) < 0.8
    chains = chains_of(ring, np.ones(GRID.shape), FLAT, GRID)
    assert len(chains.begin) == 2
    np.testing.assert_array_equal(chains.points[0], chains.points[-1])
    cross = (np.abs(i - 30) < 2) & (np.abs(j - 40) < 25) | (np.abs(j - 40) < 2) & (
        np.abs(i - 30) < 20
    )
    chains = chains_of(cross, np.ones(GRID.shape), FLAT, GRID)
    assert sum(length > 5 for length in lengths(chains)) == 4
    assert sum(lengths(chains)) == pytest.approx((49 + 39) * 0.5, rel=0.08)


def test_nothing_gives_no_chain():
    chains = chains_of(np.zeros(GRID.shape, bool), np.ones(GRID.shape), FLAT, GRID)
    assert len(chains.points) == 0
