import itertools

import numpy as np
import pytest
from scipy import sparse

from relieffab.layers.lines.aggregation import Level, coarsen, cycle


def grid(count, stretch=1.0, mass=1e-4):
    """Mass and stiffness on a square of nodes; links along X stretch times as strong."""
    line = sparse.diags(
        [-np.ones(count - 1), np.r_[1.0, np.full(count - 2, 2.0), 1.0], -np.ones(count - 1)],
        [-1, 0, 1],
    )
    one = sparse.identity(count)
    stiffness = sparse.kron(one, stretch * line) + sparse.kron(line, one)
    return (stiffness + mass * sparse.identity(count**2)).tocsr()


def as_matrix(levels):
    return cycle(levels, np.eye(levels[0].matrix.shape[0], dtype=np.float32))


@pytest.mark.parametrize("stretch", [1.0, 16.0, 0.01])
def test_a_cycle_is_close_to_the_inverse_and_symmetric(stretch):
    matrix = grid(20, stretch)
    levels = coarsen(matrix)
    got = as_matrix(levels).astype(np.float64)
    np.testing.assert_allclose(got, got.T, atol=1e-5 * np.abs(got).max())
    eigenvalues = np.linalg.eigvals(got @ matrix.toarray()).real
    assert eigenvalues.min() > 0.02
    assert eigenvalues.max() < 1.34
    # The sweeps alone reach no further than their neighbours.
    alone = as_matrix([Level(levels[0].matrix, levels[0].scale)])
    assert np.linalg.eigvals(alone @ matrix.toarray()).real.min() < 1e-3


def test_every_level_is_at_most_half_the_one_before():
    sizes = [level.matrix.shape[0] for level in coarsen(grid(60, 0.3))]
    assert len(sizes) > 2
    assert all(2 * coarse <= fine for fine, coarse in itertools.pairwise(sizes))


def test_where_mass_rules_nothing_is_coarsened():
    assert len(coarsen(grid(20, mass=4.0))) == 1


def test_a_vertex_without_neighbours_is_left_to_the_sweeps():
    matrix = sparse.block_diag([grid(10), sparse.identity(1)], format="csr")
    levels = coarsen(matrix)
    assert levels[0].up[[-1]].nnz == 0
    out = cycle(levels, np.ones((101, 1), np.float32))
    assert np.isfinite(out).all()
