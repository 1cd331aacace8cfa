import numpy as np

from relieffab.relief.energy.couplings import COARSE_ROWS, coarse_couplings, levels
from relieffab.relief.energy.linearise import linearise
from relieffab.relief.multigrid.transfer import coarser, prolong, restrict


def some(figure, seed=3, share=0.1):
    return figure & (np.random.default_rng(seed).random(figure.shape) > share)


def setup(make_terms, make_heights, shape):
    terms = make_terms(shape)
    tangent, free = linearise(terms, make_heights(terms)).tangent, some(terms.figure)
    return tangent, free, *coarse_couplings(tangent, free)


def column(couplings, i, j):
    """What a unit vector at one coarse node gives, by the couplings of the others."""
    rows, _, cols = couplings.shape
    out = np.zeros((rows, cols))
    for o in range(25):
        y, x = i - (o // 5 - 2), j - (o % 5 - 2)
        if 0 <= y < rows and 0 <= x < cols:
            out[y, x] = couplings[y, o, x]
    return out


def inner(shape):
    """Coarse nodes that are not of the border."""
    return [(i, j) for i in range(2, shape[0] - 2) for j in range(2, shape[1] - 2)]


def test_coarse_couplings_are_the_galerkin_product(make_terms, make_heights, dense_of):
    tangent, free, couplings, _ = setup(make_terms, make_heights, (24, 26))
    shape = (coarser(24), coarser(26))
    a, p = dense_of(tangent.apply, free), []
    for i, j in inner(shape):
        unit, fine = np.zeros(shape, np.float32), np.zeros(free.shape, np.float32)
        unit[i, j] = 1
        prolong(unit, free, fine)
        p.append(fine[free])
    product = np.array(p, float) @ a @ np.array(p, float).T
    for k, (i, j) in enumerate(inner(shape)):
        want = np.zeros(shape)
        want[2:-2, 2:-2] = product[k].reshape(shape[0] - 4, shape[1] - 4)
        got = column(couplings, i, j)
        np.testing.assert_allclose(got[2:-2, 2:-2], want[2:-2, 2:-2], atol=1e-6 * product.max())


def test_scale_is_reciprocal_row_sums(make_terms, make_heights, dense_of):
    tangent, free, _, scale = setup(make_terms, make_heights, (24, 26))
    sums = abs(dense_of(tangent.apply, free)).sum(axis=1)
    np.testing.assert_allclose(scale[free], 1 / sums, rtol=1e-5)
    assert (scale[~free] == 0).all()


def test_all_blocks_of_rows_are_the_galerkin_product(make_terms, make_heights):
    shape = (4 * COARSE_ROWS + 16, 27)
    tangent, free, couplings, _ = setup(make_terms, make_heights, shape)
    rows, cols = couplings.shape[0], couplings.shape[2]
    assert rows > 2 * COARSE_ROWS + 4
    # Every coarse row, a few columns of each.
    rng = np.random.default_rng(4)
    for i, j in ((i, j) for i in range(2, rows - 2) for j in rng.integers(2, cols - 2, 4)):
        unit, back = np.zeros((2, rows, cols), np.float32)
        unit[i, j] = 1
        fine = np.zeros(shape, np.float32)
        prolong(unit, free, fine)
        out = np.zeros(shape)
        tangent.apply(fine.astype(float), free, out)
        restrict(out.astype(np.float32), back)
        got = column(couplings, i, j)
        np.testing.assert_allclose(got[2:-2, 2:-2], back[2:-2, 2:-2], atol=2e-6 * couplings.max())


def test_scales_of_all_blocks_are_reciprocal_row_sums(make_terms, make_heights):
    shape = (4 * COARSE_ROWS + 16, 27)
    tangent, free, _, scale = setup(make_terms, make_heights, shape)
    # A node couples with one at most of any that are five apart.
    sums = np.zeros(shape)
    i, j = np.indices(shape)
    for o in range(25):
        units = ((i % 5 == o // 5) & (j % 5 == o % 5) & free).astype(float)
        out = np.zeros(shape)
        tangent.apply(units, free, out)
        sums += abs(out)
    np.testing.assert_allclose(scale[free], 1 / sums[free], rtol=1e-5)
    assert (scale[~free] == 0).all()


def test_levels_begin_with_the_operator_itself(make_terms, make_heights):
    tangent, free, couplings, scale = setup(make_terms, make_heights, (80, 90))
    finest, second, third, *_ = levels(tangent, free)
    assert finest.tangent is tangent
    assert finest.free is free
    np.testing.assert_array_equal(finest.scale, scale)
    np.testing.assert_array_equal(second.couplings, couplings)
    assert third.free.shape == (coarser(coarser(80)), coarser(coarser(90)))
