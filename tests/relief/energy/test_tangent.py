from dataclasses import replace

import numpy as np
import pytest

from relieffab.relief.energy.linearise import linearise
from relieffab.relief.energy.tangent import Finest
from relieffab.relief.energy.terms import ROWS
from relieffab.relief.model import pixel_slopes


def product(tangent, x, free):
    out = np.full(x.shape, 7, x.dtype)
    out[~tangent.terms.figure] = 0
    tangent.apply(x, free, out)
    return out


def some(figure, seed=3, share=0.2):
    """A part of the figure."""
    return figure & (np.random.default_rng(seed).random(figure.shape) > share)


def test_without_light_the_operator_is_the_exact_hessian(terms, h, make_heights):
    dark = replace(terms, weights=replace(terms.weights, light=0.0))
    here = linearise(dark, h)
    d = make_heights(dark, 5, size=1.0)
    change = linearise(dark, h + d).gradient - here.gradient
    want = product(here.tangent, d, dark.figure)
    np.testing.assert_allclose(2 * want, change, atol=1e-11 * abs(change).max())


@pytest.mark.parametrize("shape", [(24, 26), (2 * ROWS + 9, 21)])
def test_the_operator_is_gauss_newtons(make_terms, make_heights, shape):
    # Where the radiance asked for is the one there is, the Hessian has no second part.
    terms = make_terms(shape)
    h = make_heights(terms)
    p, q = pixel_slopes(h, terms.pitch)
    normal = np.stack([-p, -q, np.ones_like(p)]) / np.sqrt(1 + p * p + q * q)
    seen = np.einsum("kn,nij->kij", terms.lights, normal)
    met = replace(terms, radiance=seen.astype(np.float32))
    here = linearise(met, h)
    assert here.parts["light"] < 1e-9
    step, d = 1e-5, make_heights(terms, 5, size=1.0)
    ahead, back = (linearise(met, h + s * step * d).gradient for s in (1, -1))
    change = (ahead - back) / (2 * step)
    dark = replace(terms, weights=replace(terms.weights, light=0.0))
    unlit = product(linearise(dark, h).tangent, d, terms.figure)
    assert abs(2 * unlit - change).max() > 0.1 * abs(change).max()
    np.testing.assert_allclose(
        2 * product(here.tangent, d, terms.figure), change, atol=1e-6 * abs(change).max()
    )


def test_it_is_symmetric_and_positive(terms, h, dense_of):
    free = some(terms.figure)
    matrix = dense_of(linearise(terms, h).tangent.apply, free)
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * abs(matrix).max())
    assert np.linalg.eigvalsh(matrix).min() > 0


def test_fixed_nodes_get_nothing(terms, h, make_heights):
    free = some(terms.figure)
    out = product(linearise(terms, h).tangent, make_heights(terms, 5) * free, free)
    assert (out[~free] == 0).all()
    assert (out[free] != 0).all()


def test_single_precision_agrees_with_double(terms, h, make_heights):
    tangent, free = linearise(terms, h).tangent, some(terms.figure)
    x = (make_heights(terms, 5) * free).astype(np.float32)
    single, double = (product(tangent, x.astype(kind), free) for kind in (np.float32, float))
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, double, atol=1e-6 * abs(double).max())


def test_lagged_is_another_operator(terms, h, make_heights):
    lagged = replace(terms, lagged=True)
    x = make_heights(terms, 5)
    one, two = (product(linearise(t, h).tangent, x, t.figure) for t in (terms, lagged))
    assert abs(one - two).max() > 0.01 * abs(one).max()


def lattices(terms, free, count, seed=8):
    rng = np.random.default_rng(seed)
    return [(rng.normal(size=free.shape) * free).astype(np.float32) for _ in range(count)]


@pytest.mark.parametrize("shape", [(24, 26), (2 * ROWS + 9, 21)])
def test_an_advance_is_a_chebyshev_step(make_terms, make_heights, shape):
    terms = make_terms(shape)
    tangent, free = linearise(terms, make_heights(terms)).tangent, some(terms.figure)
    x, rhs, step, scale = lattices(terms, free, 4)
    scale = abs(scale) * np.float32(0.01)
    want = 0.4 * step + 1.3 * scale * (rhs - product(tangent, x.astype(float), free))
    out = np.zeros_like(x)
    Finest(tangent, free, scale).advance(x, rhs, step, out, 0.4, 1.3)
    np.testing.assert_allclose(step, want, atol=1e-6 * abs(want).max())
    np.testing.assert_allclose(out, x + want, atol=1e-6 * abs(want).max())
    assert (out[~free] == 0).all()


@pytest.mark.parametrize("shape", [(24, 26), (2 * ROWS + 9, 21)])
def test_a_residual_is_what_the_product_leaves(make_terms, make_heights, shape):
    terms = make_terms(shape)
    tangent, free = linearise(terms, make_heights(terms)).tangent, some(terms.figure)
    x, rhs = lattices(terms, free, 2)
    want = np.where(free, rhs - product(tangent, x.astype(float), free), 0)
    out = np.zeros_like(x)
    Finest(tangent, free, x).residual(x, rhs, out)
    np.testing.assert_allclose(out, want, atol=1e-6 * abs(want).max())
    assert (out[~free] == 0).all()


@pytest.mark.parametrize("down", [1, 5, ROWS - 1])
def test_blocks_may_begin_at_any_row(make_terms, make_heights, down):
    shape = (3 * ROWS + 9, 21)
    terms = make_terms(shape)
    mask, figure = terms.mask.copy(), terms.figure.copy()
    mask[-ROWS - 3 :] = figure[-ROWS - 2 :] = False
    terms = replace(terms, mask=mask, figure=figure, whole=terms.whole & figure)
    h, x = make_heights(terms), make_heights(terms, 5)
    names = "mask", "stencil", "slope", "whole", "radiance", "figure", "form"
    moved = replace(terms, **{k: np.roll(getattr(terms, k), down, axis=-2) for k in names})
    one, two = linearise(terms, h), linearise(moved, np.roll(h, down, axis=0))
    np.testing.assert_allclose(np.roll(one.gradient, down, axis=0), two.gradient, rtol=1e-12)
    np.testing.assert_allclose(
        np.roll(product(one.tangent, x, figure), down, axis=0),
        product(two.tangent, np.roll(x, down, axis=0), moved.figure),
        rtol=1e-12,
    )
