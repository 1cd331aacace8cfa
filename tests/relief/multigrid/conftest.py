"""Small operators of 25 couplings, and their matrices."""

import numpy as np
import pytest


def couplings_of(matrix, shape):
    """Lay a matrix out as the lattice's couplings."""
    n, m = shape
    couplings = np.zeros((n, 25, m), np.float32)
    for i in range(2, n - 2):
        for j in range(2, m - 2):
            for o in range(25):
                other = (i + o // 5 - 2) * m + j + o % 5 - 2
                couplings[i, o, j] = matrix[i * m + j, other]
    return couplings


def random_system(seed=1, shape=(23, 26), holes=0.1):
    """A symmetric positive definite operator, which nodes it frees, and its matrix."""
    rng = np.random.default_rng(seed)
    n, m = shape
    free = np.zeros(shape, bool)
    free[2:-2, 2:-2] = rng.random((n - 4, m - 4)) > holes
    rows = []
    for i, j in np.argwhere(free):
        # Of a least-squares system, on the 3 x 3 nodes around.
        row = np.zeros(shape)
        row[i - 1 : i + 2, j - 1 : j + 2] = rng.normal(size=(3, 3))
        rows.append((row * free).ravel())
    rows = np.array(rows)
    matrix = rows.T @ rows + 0.3 * np.diag(free.ravel().astype(float))
    # What is stored is in single precision.
    matrix = matrix.astype(np.float32).astype(float)
    return couplings_of(matrix, shape), free, matrix


def splines(shape, free):
    """Quadratic B-splines: coarse node I spans fine nodes 2 I - 4 to 2 I - 1."""
    axes = []
    for n in shape:
        away = np.arange(n)[:, None] - 2 * np.arange(n // 2 + 4) + 2.5
        axes.append(np.select([abs(away) == 0.5, abs(away) == 1.5], [0.75, 0.25]))
    return np.kron(*axes) * free.reshape(-1, 1)


@pytest.fixture
def system():
    return random_system()


@pytest.fixture
def make_system():
    return random_system


@pytest.fixture
def layout():
    return couplings_of


@pytest.fixture
def interpolation():
    return splines
