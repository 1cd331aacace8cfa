import numpy as np
import pytest

from relieffab.relief import multigrid


def random_system(rng, shape=(23, 26), holes=0.1):
    """A symmetric positive definite operator of 25 couplings, and its matrix."""
    n, m = shape
    free = np.zeros(shape, bool)
    free[2:-2, 2:-2] = rng.random((n - 4, m - 4)) > holes
    matrix = np.zeros((n * m, n * m))
    for i in range(2, n - 2):
        for j in range(2, m - 2):
            if not free[i, j]:
                continue
            # A row of a least-squares system on the 3 x 3 nodes around.
            row = np.zeros(shape)
            row[i - 1 : i + 2, j - 1 : j + 2] = rng.normal(size=(3, 3))
            row[~free] = 0
            matrix += np.outer(row, row)
    matrix += 0.3 * np.diag(free.ravel().astype(float))
    stencil = np.zeros((n, 25, m), np.float32)
    for i in range(2, n - 2):
        for j in range(2, m - 2):
            for o in range(25):
                stencil[i, o, j] = matrix[i * m + j, (i + o // 5 - 2) * m + j + o % 5 - 2]
    return stencil, free, matrix


def dense_interpolation(fine, coarse, free):
    """Quadratic B-splines: coarse node I spans fine nodes 2 I - 4 to 2 I - 1."""
    weights = {-1.5: 0.25, -0.5: 0.75, 0.5: 0.75, 1.5: 0.25}
    p = np.zeros((fine[0] * fine[1], coarse[0] * coarse[1]))
    for i, j in np.argwhere(free):
        for big_i in range(coarse[0]):
            for big_j in range(coarse[1]):
                w = weights.get(i - 2 * big_i + 2.5, 0) * weights.get(j - 2 * big_j + 2.5, 0)
                p[i * fine[1] + j, big_i * coarse[1] + big_j] = w
    return p


def test_coarse_operator_is_the_galerkin_product():
    rng = np.random.default_rng(1)
    stencil, free, matrix = random_system(rng)
    n, m = free.shape
    rows, cols = n // 2 + 4, m // 2 + 4
    coarse = np.zeros((rows, 25, cols), np.float32)
    multigrid._fix(stencil, free.astype(np.float32))
    multigrid._coarsen(stencil, coarse)
    p = dense_interpolation((n, m), (rows, cols), free)
    product = p.T @ matrix @ p
    for i in range(2, rows - 2):
        for j in range(2, cols - 2):
            for o in range(25):
                want = product[i * cols + j, (i + o // 5 - 2) * cols + j + o % 5 - 2]
                assert coarse[i, o, j] == pytest.approx(want, abs=1e-4)


def test_interpolation_and_restriction_are_transposes():
    rng = np.random.default_rng(2)
    _, free, _ = random_system(rng)
    n, m = free.shape
    rows, cols = n // 2 + 4, m // 2 + 4
    p = dense_interpolation((n, m), (rows, cols), free)
    np.testing.assert_allclose(p.sum(axis=1)[free.ravel()], 1)
    coarse = np.zeros((rows, cols), np.float32)
    coarse[2:-2, 2:-2] = rng.normal(size=(rows - 4, cols - 4))
    fine = np.zeros((n, m), np.float32)
    multigrid._prolong(coarse, free, fine)
    np.testing.assert_allclose(fine.ravel(), p @ coarse.ravel(), atol=1e-6)
    back = np.zeros((rows, cols), np.float32)
    x = (rng.normal(size=(n, m)) * free).astype(np.float32)
    multigrid._restrict(x, back)
    np.testing.assert_allclose(
        back[2:-2, 2:-2].ravel(),
        (p.T @ x.ravel()).reshape(rows, cols)[2:-2, 2:-2].ravel(),
        atol=1e-5,
    )


def test_solution_is_the_dense_one():
    rng = np.random.default_rng(4)
    stencil, free, matrix = random_system(rng)
    rhs = rng.normal(size=free.shape)
    levels = multigrid.build(stencil, free)
    x, used = multigrid.solve(levels, rhs, tolerance=1e-9)
    keep = free.ravel()
    want = np.linalg.solve(matrix[np.ix_(keep, keep)], rhs.ravel()[keep])
    np.testing.assert_allclose(x.ravel()[keep], want, rtol=1e-5, atol=1e-5 * np.abs(want).max())
    assert (x[~free] == 0).all()
    assert 0 < used < 60


def test_a_level_is_never_amplified_by_its_scale():
    # Gershgorin: what Chebyshev needs to be a smoother and not an amplifier.
    rng = np.random.default_rng(5)
    stencil, free, matrix = random_system(rng)
    level = multigrid.build(stencil, free)[0]
    keep = free.ravel()
    scaled = level.scale.ravel()[keep, None] * matrix[np.ix_(keep, keep)]
    assert np.linalg.eigvals(scaled).real.max() <= 1 + 1e-6


def test_the_cycle_is_symmetric():
    rng = np.random.default_rng(6)
    stencil, free, _ = random_system(rng, holes=0.0)
    levels = multigrid.build(stencil, free)
    a, b = ((rng.normal(size=free.shape) * free).astype(np.float32) for _ in range(2))
    left = float((multigrid.cycle(levels, a) * b).sum())
    right = float((multigrid.cycle(levels, b) * a).sum())
    assert left == pytest.approx(right, rel=1e-3)
