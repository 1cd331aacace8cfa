from dataclasses import replace

import numpy as np
import pytest

from relieffab.relief.energy.linearise import linearise
from relieffab.relief.energy.terms import ROWS, Weights

NOTHING = Weights(depth=0.0, line=0.0, twist=0.0, light=0.0, form=0.0)
PARTS = ["depth", "light", "line", "form"]


def slow_parts(terms, h, straight=None):
    """The energy as its definition reads, one pixel and one node at a time.

    Normals may take their length from other heights, `straight`.
    """
    n, m = h.shape
    w, two = terms.weights, 2 * terms.pitch
    error = np.zeros((len(terms.lights), n - 1, m - 1))
    depth = light = line = form = 0.0
    for i in range(n - 1):
        for j in range(m - 1):
            p, q = slow_slopes(terms, h, i, j)
            square = ((np.array([p, q]) - terms.slope[:, i, j]) ** 2).sum()
            if terms.mask[i, j]:
                bend = h[i, j] - h[i, j + 1] - h[i + 1, j] + h[i + 1, j + 1]
                depth += w.depth * square + w.twist * (bend / two) ** 2
            line += w.line * float(terms.stencil[i, j]) * square
            a, b = (p, q) if straight is None else slow_slopes(terms, straight, i, j)
            normal = np.array([-p, -q, 1]) / np.sqrt(1 + a * a + b * b)
            error[:, i, j] = terms.lights @ normal - terms.radiance[:, i, j]
    for i in range(1, n - 1):
        for j in range(1, m - 1):
            a, b = error[:, i - 1, j - 1], error[:, i - 1, j]
            c, d = error[:, i, j - 1], error[:, i, j]
            x, y = (b + d - a - c) / two, (a + b - c - d) / two
            if terms.whole[i, j]:
                light += w.light * (x @ x + y @ y)
            if terms.figure[i, j]:
                form += w.form * (h[i, j] - terms.form[i, j]) ** 2
    return {"depth": depth, "light": light, "line": line, "form": form}


def slow_slopes(terms, h, i, j):
    a, b, c, d = h[i, j], h[i, j + 1], h[i + 1, j], h[i + 1, j + 1]
    return (b + d - a - c) / (2 * terms.pitch), (a + b - c - d) / (2 * terms.pitch)


def slope_along(value, h, d, step=1e-5):
    return (value(h + step * d) - value(h - step * d)) / (2 * step)


@pytest.mark.parametrize("shape", [(24, 26), (2 * ROWS + 9, 21)])
def test_the_value_is_the_definition(make_terms, make_heights, shape):
    terms = make_terms(shape)
    h = make_heights(terms)
    here, want = linearise(terms, h), slow_parts(terms, h)
    for name in PARTS:
        assert here.parts[name] == pytest.approx(want[name], rel=1e-12)
        assert want[name] > 0
    assert here.value == pytest.approx(sum(want.values()), rel=1e-12)


@pytest.mark.parametrize("name", PARTS)
def test_each_part_on_its_own_is_the_definition(terms, h, name):
    alone = replace(terms, weights=replace(NOTHING, **{name: 0.6}))
    here = linearise(alone, h)
    assert here.value == pytest.approx(slow_parts(alone, h)[name], rel=1e-12)
    assert [part for part in PARTS if here.parts[part] != 0] == [name]


@pytest.mark.parametrize("name", [*PARTS, "twist", "all"])
def test_the_gradient_is_the_difference_of_values(terms, h, make_heights, name):
    if name != "all":
        terms = replace(terms, weights=replace(NOTHING, **{name: 0.6}))
    gradient = linearise(terms, h).gradient
    for seed in range(5):
        d = make_heights(terms, seed, size=1.0)
        want = slope_along(lambda x: linearise(terms, x).value, h, d)
        assert (gradient * d).sum() == pytest.approx(want, rel=1e-6)


def test_the_gradient_is_that_of_the_definition_node_by_node(terms, h):
    gradient = linearise(terms, h).gradient
    for i, j in np.random.default_rng(2).permutation(np.argwhere(terms.figure))[:12]:
        unit = np.zeros(h.shape)
        unit[i, j] = 1
        want = slope_along(lambda x: sum(slow_parts(terms, x).values()), h, unit)
        assert gradient[i, j] == pytest.approx(want, rel=1e-6, abs=1e-5)


def test_the_gradient_is_zero_outside_the_figure(terms, h):
    gradient = linearise(terms, h).gradient
    assert (gradient[~terms.figure] == 0).all()
    assert (gradient[terms.figure] != 0).all()


def test_a_checkerboard_costs_energy(terms):
    i, j = np.indices(terms.figure.shape)
    flat = replace(terms, slope=0 * terms.slope, form=0 * terms.form)
    board = (-1.0) ** (i + j) * terms.figure
    # Of the inside: there no slope sees it.
    inner = np.zeros_like(terms.mask)
    inner[8:-8, 8:-8] = terms.mask[8:-8, 8:-8]
    inside = replace(
        flat, mask=inner, stencil=terms.stencil * inner, whole=np.zeros_like(flat.whole)
    )
    assert linearise(inside, 0 * board).parts["depth"] == 0
    bend = 4 / (2 * terms.pitch)
    nodes = [board[i : i + 2, j : j + 2] for i, j in np.argwhere(inner)]
    count = sum(abs(four).sum() == 4 for four in nodes)
    assert count == inner.sum() > 20
    assert linearise(inside, board).parts["depth"] == pytest.approx(
        count * terms.weights.twist * bend**2
    )


def test_no_lights_at_all_is_no_light(terms, h):
    dark = replace(terms, lights=np.zeros((0, 3)), radiance=terms.radiance[:0])
    off = replace(terms, weights=replace(terms.weights, light=0.0))
    here, want = linearise(dark, h), linearise(off, h)
    assert here.parts["light"] == 0
    assert here.value == pytest.approx(want.value, rel=1e-14)
    np.testing.assert_allclose(here.gradient, want.gradient, rtol=1e-12, atol=1e-12)


def test_lagged_leaves_the_value_and_keeps_lengths_out_of_the_gradient(terms, h, make_heights):
    lagged = linearise(replace(terms, lagged=True), h)
    plain = linearise(terms, h)
    assert lagged.value == plain.value
    assert np.abs(lagged.gradient - plain.gradient).max() > 0.01 * np.abs(plain.gradient).max()
    for seed in range(3):
        d = make_heights(terms, seed, size=1.0)
        want = slope_along(lambda x: sum(slow_parts(terms, x, straight=h).values()), h, d)
        assert (lagged.gradient * d).sum() == pytest.approx(want, rel=1e-6)


def test_radiance_is_asked_for_up_to_a_constant(terms, h):
    brighter = replace(terms, radiance=terms.radiance + np.float32(0.25))
    assert linearise(brighter, h).value == pytest.approx(linearise(terms, h).value, rel=1e-5)
