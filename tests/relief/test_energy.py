import numpy as np
import pytest

from relieffab.layers.shading import default_lights
from relieffab.relief.energy import Terms, linearise, operator

SHAPE = (13, 15)
PITCH = 0.3


def inner(shape, keep):
    """1 inside, 0 on a border of `keep`."""
    out = np.zeros(shape)
    out[keep : shape[0] - keep, keep : shape[1] - keep] = 1
    return out


def random_terms(rng, light=1.0):
    n, m = SHAPE
    pixels = (n - 1, m - 1)
    slope_weight = rng.random(pixels) * inner(pixels, 2)
    return Terms(
        pitch=PITCH,
        lights=default_lights(),
        depth_weight=0.75 * slope_weight,
        line_weight=0.25 * slope_weight,
        slope=rng.normal(size=(2, *pixels)),
        light_weight=light * rng.random(SHAPE) * inner(SHAPE, 3),
        radiance=rng.random((2, *pixels)),
        twist_weight=0.3 * slope_weight,
        form_weight=rng.random(SHAPE) * inner(SHAPE, 2),
        form=rng.normal(size=SHAPE),
        bounds=(-4.0, 0.0),
    )


def slow_value(terms, h):
    """The energy as its definition reads, one pixel and one node at a time."""
    n, m = h.shape
    two = 2 * terms.pitch
    radiance = np.zeros((len(terms.lights), n - 1, m - 1))
    total = 0.0
    for i in range(n - 1):
        for j in range(m - 1):
            a, b, c, d = h[i, j], h[i, j + 1], h[i + 1, j], h[i + 1, j + 1]
            p, q = (b + d - a - c) / two, (a + b - c - d) / two
            e = np.array([p, q]) - terms.slope[:, i, j]
            total += (terms.depth_weight + terms.line_weight)[i, j] * e @ e
            total += terms.twist_weight[i, j] * ((a - b - c + d) / two) ** 2
            normal = np.array([-p, -q, 1]) / np.sqrt(1 + p * p + q * q)
            radiance[:, i, j] = terms.lights @ normal - terms.radiance[:, i, j]
    for i in range(1, n - 1):
        for j in range(1, m - 1):
            a, b = radiance[:, i - 1, j - 1], radiance[:, i - 1, j]
            c, d = radiance[:, i, j - 1], radiance[:, i, j]
            x, y = (b + d - a - c) / two, (a + b - c - d) / two
            total += terms.light_weight[i, j] * (x @ x + y @ y)
            total += terms.form_weight[i, j] * (h[i, j] - terms.form[i, j]) ** 2
    return total


@pytest.fixture
def setup():
    rng = np.random.default_rng(3)
    return rng, random_terms(rng), 0.2 * rng.normal(size=SHAPE) * inner(SHAPE, 2)


def test_value_is_the_definition(setup):
    _, terms, h = setup
    here = linearise(terms, h)
    assert here.value == pytest.approx(slow_value(terms, h), rel=1e-12)
    assert sum(here.parts.values()) == pytest.approx(here.value)


def test_gradient_is_the_difference_of_values(setup):
    rng, terms, h = setup
    gradient = linearise(terms, h).gradient
    for _ in range(5):
        d = rng.normal(size=SHAPE) * inner(SHAPE, 2)
        there, back = (linearise(terms, h + s * 1e-6 * d).value for s in (1, -1))
        assert (gradient * d).sum() == pytest.approx((there - back) / 2e-6, rel=1e-6)


def multiply(stencil, x):
    """The couplings as a matrix would act, by their definition."""
    out = np.zeros(x.shape)
    for i in range(2, x.shape[0] - 2):
        for j in range(2, x.shape[1] - 2):
            for o in range(25):
                out[i, j] += stencil[i, o, j] * x[i + o // 5 - 2, j + o % 5 - 2]
    return out


def test_without_light_the_operator_is_the_exact_hessian(setup):
    rng, _, h = setup
    terms = random_terms(rng, light=0.0)
    here = linearise(terms, h)
    d = rng.normal(size=SHAPE) * inner(SHAPE, 2)
    change = linearise(terms, h + d).gradient - here.gradient
    np.testing.assert_allclose(
        multiply(operator(terms, here), d), change / 2 * inner(SHAPE, 2), atol=1e-5
    )


def test_the_operator_is_gauss_newtons(setup):
    # Where the radiance asked for is the one there is, the Hessian has no second part.
    rng, terms, h = setup
    zero = Terms(**{**vars(terms), "radiance": np.zeros_like(terms.radiance)})
    p = (h[:-1, 1:] + h[1:, 1:] - h[:-1, :-1] - h[1:, :-1]) / (2 * PITCH)
    q = (h[:-1, :-1] + h[:-1, 1:] - h[1:, :-1] - h[1:, 1:]) / (2 * PITCH)
    normal = np.stack([-p, -q, np.ones_like(p)]) / np.sqrt(1 + p * p + q * q)
    met = Terms(**{**vars(zero), "radiance": np.einsum("kn,nij->kij", terms.lights, normal)})
    here = linearise(met, h)
    assert here.parts["light"] == pytest.approx(0, abs=1e-20)
    d = rng.normal(size=SHAPE) * inner(SHAPE, 2)
    step = 1e-5
    change = linearise(met, h + step * d).gradient - linearise(met, h - step * d).gradient
    np.testing.assert_allclose(
        multiply(operator(met, here), d),
        change / (4 * step) * inner(SHAPE, 2),
        rtol=2e-4,
        atol=2e-3,
    )


def test_a_checkerboard_costs_energy(setup):
    _, terms, _ = setup
    i, j = np.indices(SHAPE)
    board = (-1.0) ** (i + j) * inner(SHAPE, 2)
    flat = Terms(**{**vars(terms), "slope": 0 * terms.slope, "form": 0 * terms.form})
    assert (
        linearise(flat, board).parts["depth"] > 10 * linearise(flat, 0 * board).parts["depth"] + 1
    )
