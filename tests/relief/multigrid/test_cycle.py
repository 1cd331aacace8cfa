import numpy as np
import pytest
from numpy.polynomial.chebyshev import Chebyshev as Polynomial

from relieffab.relief.multigrid.cycle import COARSEST_SWEEPS, Cycle, chebyshev, hierarchy
from relieffab.relief.multigrid.stored import stored


def dense_cycle(levels):
    """The matrix of a cycle, of free nodes alone."""
    free, cycle = levels[0].free, Cycle(levels)
    columns = []
    for i, j in np.argwhere(free):
        unit = np.zeros(free.shape, np.float32)
        unit[i, j] = 1
        columns.append(cycle(unit)[free].astype(float))
    return np.array(columns).T


def test_levels_are_built_until_little_is_left(make_system):
    couplings, _, _ = make_system(shape=(30, 34))
    levels = hierarchy(stored(couplings))
    assert [level.free.shape for level in levels] == [(30, 34), (19, 21)]
    np.testing.assert_array_equal(levels[1].couplings, levels[0].coarse().couplings)


def test_a_small_level_is_left_alone(make_system):
    couplings, _, _ = make_system(shape=(18, 20))
    assert len(hierarchy(stored(couplings))) == 1


def test_no_level_is_amplified_by_its_scale(make_system):
    # Gershgorin: what Chebyshev needs to be a smoother and not an amplifier.
    couplings, _, _ = make_system(shape=(30, 34))
    for level in hierarchy(stored(couplings)):
        n, m = level.free.shape
        matrix = np.zeros((n * m, n * m))
        for i, j in np.argwhere(level.free):
            for o in range(25):
                other = (i + o // 5 - 2) * m + j + o % 5 - 2
                matrix[i * m + j, other] = level.couplings[i, o, j]
        root = np.sqrt(level.scale.astype(float)).ravel()
        largest = np.linalg.eigvalsh(root[:, None] * matrix * root).max()
        assert 0.1 < largest <= 1 + 1e-6


@pytest.mark.parametrize(("sweeps", "reach"), [(1, 12.0), (2, 12.0), (3, 60.0), (16, 30.0)])
def test_steps_make_the_polynomial_that_is_least_on_the_upper_spectrum(sweeps, reach):
    value = np.linspace(0.0, 1.0, 101)
    error, step = np.ones_like(value), np.zeros_like(value)
    for keep, gain in chebyshev(sweeps, reach):
        step = keep * step - gain * value * error
        error = error + step
    least = Polynomial.basis(sweeps, domain=[1 / reach, 1])
    np.testing.assert_allclose(error, least(value) / least(0.0), atol=1e-12)


def test_a_level_on_its_own_is_smoothed_from_zero(make_system):
    couplings, free, matrix = make_system(shape=(16, 17))
    level, keep = stored(couplings), free.ravel()
    root = np.sqrt(level.scale[free].astype(float))
    value, vector = np.linalg.eigh(root[:, None] * matrix[np.ix_(keep, keep)] * root)
    degree, reach = COARSEST_SWEEPS
    least = Polynomial.basis(degree, domain=[1 / reach, 1])
    inverse = vector * ((1 - least(value) / least(0.0)) / value) @ vector.T
    want = root[:, None] * inverse * root
    np.testing.assert_allclose(dense_cycle([level]), want, atol=1e-5 * abs(want).max())


def test_the_cycle_is_symmetric_and_near_the_inverse(system):
    couplings, free, matrix = system
    levels, keep = hierarchy(stored(couplings)), free.ravel()
    assert len(levels) > 1
    cycle = dense_cycle(levels)
    np.testing.assert_allclose(cycle, cycle.T, atol=1e-5 * abs(cycle).max())
    value = np.linalg.eigvals(cycle @ matrix[np.ix_(keep, keep)]).real
    assert value.min() > 0.05
    assert value.max() < 1.05


def test_a_cycle_leaves_no_trace_of_the_one_before(system):
    couplings, free, _ = system
    rng = np.random.default_rng(6)
    a, b = ((rng.normal(size=free.shape) * free).astype(np.float32) for _ in range(2))
    levels = hierarchy(stored(couplings))
    cycle = Cycle(levels)
    cycle(a)
    np.testing.assert_array_equal(cycle(b), Cycle(levels)(b))


def test_a_cycle_leaves_fixed_nodes_and_its_input_alone(system):
    couplings, free, _ = system
    rhs = (np.random.default_rng(6).normal(size=free.shape) * free).astype(np.float32)
    before = rhs.copy()
    out = Cycle(hierarchy(stored(couplings)))(rhs)
    np.testing.assert_array_equal(rhs, before)
    assert (out[~free] == 0).all()
    assert (out[free] != 0).all()
