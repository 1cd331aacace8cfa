import numpy as np
import pytest

from relieffab.relief.multigrid.conjugate import dot, solve
from relieffab.relief.multigrid.cycle import hierarchy
from relieffab.relief.multigrid.stored import stored


def times(matrix):
    def apply(x, out):
        out[...] = (matrix @ x.ravel()).reshape(x.shape)

    return apply


def bent_plate(size):
    """A square plate held at its border: the biharmonic operator, by its product."""

    def bend(x):
        out = np.zeros_like(x)
        out[1:-1, 1:-1] = x[:-2, 1:-1] + x[2:, 1:-1] + x[1:-1, :-2] + x[1:-1, 2:]
        return out - 4 * x

    free = np.zeros((size, size), bool)
    free[2:-2, 2:-2] = True
    couplings = np.zeros((size, 25, size), np.float32)
    for a in range(5):
        for b in range(5):
            units = np.zeros((size, size))
            units[a::5, b::5] = 1
            out = bend(bend(units * free)) * free
            for i, j in np.argwhere(free):
                down, right = (a - i + 2) % 5, (b - j + 2) % 5
                couplings[i, 5 * down + right, j] = out[i, j]

    def apply(x, out):
        out[...] = bend(bend(x)) * free

    return couplings, free, apply


def test_dot_is_the_inner_product():
    rng = np.random.default_rng(0)
    x, y = rng.normal(size=(2, 23, 26))
    assert dot(x, y) == pytest.approx((x * y).sum(), rel=1e-12)
    single = y.astype(np.float32)
    assert dot(x, single) == pytest.approx((x * single).sum(), rel=1e-12)


def test_the_solution_is_the_dense_one(system):
    couplings, free, matrix = system
    rhs = np.random.default_rng(4).normal(size=free.shape)
    x, used = solve(times(matrix), hierarchy(stored(couplings)), rhs, tolerance=1e-11)
    keep = free.ravel()
    want = np.linalg.solve(matrix[np.ix_(keep, keep)], rhs.ravel()[keep])
    np.testing.assert_allclose(x[free], want, atol=1e-9 * abs(want).max())
    assert (x[~free] == 0).all()
    assert 0 < used < 40


def test_the_residual_is_as_small_as_asked(system):
    couplings, free, matrix = system
    rhs = np.random.default_rng(4).normal(size=free.shape) * free
    levels, before = hierarchy(stored(couplings)), 0
    for tolerance in (1e-1, 1e-3, 1e-6):
        x, used = solve(times(matrix), levels, rhs, tolerance=tolerance)
        left = rhs.ravel() - matrix @ x.ravel()
        assert np.linalg.norm(left) <= 1.001 * tolerance * np.linalg.norm(rhs)
        assert used > before
        before = used


def test_iterations_are_few_and_do_not_grow_with_the_lattice():
    counts = []
    for size in (32, 64, 128):
        couplings, free, apply = bent_plate(size)
        rhs = np.random.default_rng(5).normal(size=free.shape)
        x, used = solve(apply, hierarchy(stored(couplings)), rhs, tolerance=1e-8)
        out = np.zeros_like(x)
        apply(x, out)
        np.testing.assert_allclose(out[free], rhs[free], atol=1e-5)
        counts.append(used)
    assert max(counts) <= 20
    assert counts[-1] <= counts[0] + 4


def test_it_stops_after_the_most_iterations(system):
    couplings, free, matrix = system
    rhs = np.random.default_rng(4).normal(size=free.shape)
    _, used = solve(times(matrix), hierarchy(stored(couplings)), rhs, tolerance=1e-11, most=3)
    assert used == 3


def test_nothing_asked_takes_no_iteration(system):
    couplings, free, matrix = system
    x, used = solve(times(matrix), hierarchy(stored(couplings)), 0.0 * free, tolerance=1e-6)
    assert used == 0
    assert not x.any()


@pytest.mark.parametrize("size", [1e-20, 1e15])
def test_units_do_not_matter(system, size):
    couplings, free, matrix = system
    rhs = np.random.default_rng(4).normal(size=free.shape)
    levels = hierarchy(stored(couplings))
    x, used = solve(times(matrix), levels, rhs, tolerance=1e-6)
    y, again = solve(times(matrix), levels, size * rhs, tolerance=1e-6)
    np.testing.assert_allclose(y, size * x, rtol=1e-3, atol=1e-6 * size * abs(x).max())
    assert abs(used - again) <= 1
