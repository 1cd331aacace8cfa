from dataclasses import replace

import numba
import numpy as np
import pytest
from scipy.optimize import lsq_linear, minimize

from relieffab.layers.shading import default_lights, lambert
from relieffab.relief.descend import descend
from relieffab.relief.energy.linearise import linearise
from relieffab.relief.energy.terms import Terms, Weights
from relieffab.relief.model import nodes_of, pixel_slopes

PITCH = 0.25
DEPTH = 0.8


def carving(shape=(20, 22), seed=0, light=0.0):
    """A wavy form with rough slopes, too tall for its bounds; a hole in the figure."""
    rng = np.random.default_rng(seed)
    i, j = np.indices(shape)
    mask = np.zeros((shape[0] - 1, shape[1] - 1), bool)
    mask[3:-3, 3:-3] = True
    mask[3:6, 3:8] = mask[9:11, 9:11] = False
    figure = nodes_of(mask)
    whole = np.zeros(shape, bool)
    whole[1:-1, 1:-1] = mask[1:, 1:] & mask[1:, :-1] & mask[:-1, 1:] & mask[:-1, :-1]
    whole[12, 4:9] = False
    wave = 0.6 * np.sin(0.5 * i) * np.cos(0.4 * j)
    slope = pixel_slopes(wave, PITCH) + 0.3 * rng.normal(size=(2, *mask.shape))
    normals = np.stack([-slope[0], -slope[1], np.ones(mask.shape)], axis=2)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    low = np.where(rng.random(shape) > 0.2, np.float32(-DEPTH), np.float32(-np.inf))
    low[14:] = -0.5 * DEPTH
    count = mask.sum()
    return Terms(
        pitch=PITCH,
        lights=default_lights(),
        weights=Weights(0.7 / count, 0.4 / count, 0.1 / count, light / count, 0.8 / count),
        mask=mask & (rng.random(mask.shape) > 0.05),
        stencil=(rng.random(mask.shape) * mask).astype(np.float32),
        slope=slope.astype(np.float32),
        whole=whole,
        radiance=lambert(normals, default_lights()).astype(np.float32),
        figure=figure,
        form=((wave - 0.4 * DEPTH) * figure).astype(np.float32),
        bounds=(low.astype(np.float32), 0.0),
    )


def guess(terms):
    low, high = terms.bounds
    return np.clip(terms.form.astype(float), low, high) * terms.figure


def limits(terms):
    low = terms.bounds[0][terms.figure].astype(float)
    return low, np.full(len(low), terms.bounds[1])


def least_squares(terms):
    """Rows and right-hand side of the energy without light, as it is defined."""
    nodes, w, two = np.argwhere(terms.figure), terms.weights, 2 * terms.pitch
    index = {tuple(node): k for k, node in enumerate(nodes)}
    rows, right = [], []

    def add(weight, signs, want):
        row = np.zeros(len(nodes))
        for node, sign in signs.items():
            row[index[node]] = sign
        rows.append(np.sqrt(weight) * row)
        right.append(np.sqrt(weight) * want)

    for i, j in np.argwhere(terms.mask | (terms.stencil > 0)):
        corners = (i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)
        seen = float(terms.mask[i, j])
        both = w.depth * seen + w.line * float(terms.stencil[i, j])
        for weight, signs, want in (
            (both, (-1, 1, -1, 1), terms.slope[0, i, j]),
            (both, (1, 1, -1, -1), terms.slope[1, i, j]),
            (w.twist * seen, (1, -1, -1, 1), 0.0),
        ):
            add(weight, {c: s / two for c, s in zip(corners, signs, strict=True)}, want)
    for i, j in nodes:
        add(w.form, {(i, j): 1.0}, terms.form[i, j])
    return np.array(rows), np.array(right, float)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_heights_are_those_of_bounded_least_squares(seed):
    terms = carving(seed=seed)
    h, solution = descend(terms, guess(terms), tolerance=1e-9, most=60)
    matrix, right = least_squares(terms)
    low, high = limits(terms)
    turned, square = np.linalg.qr(matrix)
    want = lsq_linear(square, turned.T @ right, (low, high), method="bvls", tol=1e-15)
    least = ((matrix @ want.x - right) ** 2).sum()
    assert solution.energy["total"] == pytest.approx(least, rel=1e-10)
    assert np.abs(h[terms.figure] - want.x).max() < 1e-6 * DEPTH
    at_low, at_high = want.x <= low + 1e-9, want.x >= high - 1e-9
    assert (at_low | at_high).mean() > 0.1
    assert at_low.any()
    assert at_high.any()
    assert (h[~terms.figure] == 0).all()


def test_without_bounds_heights_are_those_of_least_squares():
    terms = replace(carving(), bounds=(np.full((20, 22), -np.inf, np.float32), np.inf))
    h, solution = descend(terms, guess(terms), tolerance=1e-9, most=60)
    want = np.linalg.lstsq(*least_squares(terms), rcond=None)[0]
    assert solution.converged
    assert np.abs(h[terms.figure] - want).max() < 1e-6 * DEPTH


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_lit_heights_are_those_of_another_minimiser(seed):
    terms = carving(seed=seed, light=0.05)
    h, solution = descend(terms, guess(terms), tolerance=1e-9, most=60)

    def energy(x):
        heights = np.zeros(terms.figure.shape)
        heights[terms.figure] = x
        here = linearise(terms, heights)
        return here.value, here.gradient[terms.figure]

    low, high = limits(terms)
    start = guess(terms)[terms.figure]
    want = minimize(
        energy, start, jac=True, method="L-BFGS-B", bounds=list(zip(low, high, strict=True)),
        options={"ftol": 0.0, "gtol": 1e-11, "maxiter": 20000, "maxfun": 40000, "maxcor": 40},
    )  # fmt: skip
    assert solution.energy["light"] > 0.01 * solution.energy["total"]
    assert solution.energy["total"] <= want.fun * (1 + 1e-9)
    assert np.abs(h[terms.figure] - want.x).max() < 1e-4
    assert ((want.x <= low) | (want.x >= high)).mean() > 0.1


@pytest.fixture
def threads():
    before = numba.get_num_threads()
    yield numba.set_num_threads
    numba.set_num_threads(before)


@pytest.mark.skipif(numba.config.NUMBA_NUM_THREADS < 2, reason="one core")
@pytest.mark.parametrize(("shape", "most"), [((20, 22), 60), ((255, 260), 2)])
def test_threads_do_not_change_the_answer(threads, shape, most):
    # The larger one is what kernels take threads for.
    terms = carving(shape, light=0.05)
    found = []
    for count in (1, 2):
        threads(count)
        found.append(descend(terms, guess(terms), tolerance=1e-9, most=most))
    (one, first), (two, second) = found
    np.testing.assert_array_equal(one, two)
    assert first == second
    assert first.iterations > 0
