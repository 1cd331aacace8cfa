import numpy as np
import pytest

from relieffab.relief.multigrid.stored import stored
from relieffab.relief.multigrid.transfer import coarser


def lattices(free, count, seed=7):
    rng = np.random.default_rng(seed)
    return [(rng.normal(size=free.shape) * free).astype(np.float32) for _ in range(count)]


def times(matrix, x):
    return (matrix @ x.ravel().astype(float)).reshape(x.shape)


def test_nodes_with_couplings_are_free(system):
    couplings, free, _ = system
    np.testing.assert_array_equal(stored(couplings).free, free)


def test_nodes_with_next_to_no_couplings_are_fixed(system):
    couplings, free, _ = system
    i, j = np.argwhere(free)[100]
    couplings[i, :, j] *= np.float32(1e-9)
    left = free.copy()
    left[i, j] = False
    np.testing.assert_array_equal(stored(couplings).free, left)


def test_scale_is_reciprocal_row_sums(system):
    couplings, free, matrix = system
    sums = abs(matrix).sum(axis=1).reshape(free.shape)
    scale = stored(couplings).scale
    np.testing.assert_allclose(scale[free], 1 / sums[free], rtol=1e-5)
    assert (scale[~free] == 0).all()


def test_spans_are_tight(system):
    couplings, _, _ = system
    couplings[7] = 0
    level = stored(couplings)
    assert level.spans[7, 0] == level.spans[7, 1]
    for row, (first, last) in zip(level.free, level.spans, strict=True):
        nodes = np.nonzero(row)[0]
        assert last - first == (nodes[-1] + 1 - nodes[0] if len(nodes) else 0)
        assert not len(nodes) or first == nodes[0]


def test_an_advance_is_a_chebyshev_step(system):
    couplings, free, matrix = system
    level = stored(couplings)
    x, rhs, step = lattices(free, 3)
    want = 0.4 * step + 1.3 * level.scale * (rhs - times(matrix, x))
    out = np.zeros_like(x)
    level.advance(x, rhs, step, out, 0.4, 1.3)
    np.testing.assert_allclose(step, want, atol=1e-5)
    np.testing.assert_allclose(out, x + want, atol=1e-5)
    assert (out[~free] == 0).all()


def test_a_residual_is_what_the_product_leaves(system):
    couplings, free, matrix = system
    x, rhs = lattices(free, 2)
    out = np.zeros_like(x)
    stored(couplings).residual(x, rhs, out)
    want = np.where(free, rhs - times(matrix, x), 0)
    np.testing.assert_allclose(out, want, atol=1e-6 * abs(matrix).sum(axis=1).max())
    assert (out[~free] == 0).all()


@pytest.mark.parametrize("shape", [(23, 26), (40, 21)])
def test_coarse_is_the_galerkin_product(make_system, layout, interpolation, shape):
    couplings, free, matrix = make_system(shape=shape)
    rows, cols = coarser(shape[0]), coarser(shape[1])
    p = interpolation(shape, free)
    product = p.T @ matrix @ p
    coarse = stored(couplings).coarse()
    # Nothing of the product is further away than 25 couplings reach.
    want = layout(product, (rows, cols))
    assert abs(want).sum() == pytest.approx(abs(product).sum(), rel=1e-5)
    np.testing.assert_allclose(coarse.couplings, want, atol=1e-6 * product.max())
