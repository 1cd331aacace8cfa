import numpy as np
import pytest
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from relieffab.layers.image.fuse import _solve, fuse

PITCH = 0.25


def off(ball, depth):
    """RMS difference, percent of the depth, and its 99th percentile."""
    d = np.abs(depth - ball.depth)[ball.mask] / np.ptp(ball.depth[ball.mask]) * 100
    return np.sqrt((d**2).mean()), np.percentile(d, 99)


def fused(ball, depth, known=None, **more):
    known = ball.mask if known is None else known
    return fuse(depth, known, ball.normals, ball.mask, PITCH, **more)


def test_an_exact_depth_map_stays_as_it_is(ball):
    rms, most = off(ball, fused(ball, ball.depth + 5.0))
    assert rms < 0.5
    assert most < 1.0


def test_grain_gives_way_to_the_form_of_the_normals(ball):
    grain = np.random.default_rng(0).normal(0.0, 0.2, ball.depth.shape)
    before, after = off(ball, ball.depth + grain), off(ball, fused(ball, ball.depth + grain))
    assert after[0] < 0.4 * before[0]


def test_a_smeared_step_becomes_a_step_again(ball):
    smeared = ndimage.gaussian_filter(ball.depth, 1.5)
    mass = ndimage.gaussian_filter(ball.mask.astype(float), 1.5)
    smeared = np.where(ball.mask, smeared / np.maximum(mass, 1e-6), 0.0)
    before, after = off(ball, smeared), off(ball, fused(ball, smeared))
    assert after[0] < 0.5 * before[0]


def test_holes_are_filled_by_the_normals(ball):
    known = ball.mask.copy()
    known[50:70, 75:95] = known[90:100, 40:60] = False
    assert off(ball, fused(ball, np.where(known, ball.depth, 99.0), known))[0] < 1.0


def test_the_direct_solution_is_found():
    rng = np.random.default_rng(1)
    mask = np.ones((9, 8), bool)
    mask[2:4, 3] = False
    near, trust = rng.normal(size=mask.shape), rng.random(mask.shape) + 0.1
    steps = rng.normal(size=(9, 7)), rng.normal(size=(8, 8))
    both = mask[:, 1:] & mask[:, :-1], mask[1:] & mask[:-1]
    weights = [rng.random(b.shape) * b for b in both]
    weights[0][5] = 0.0
    rows = []  # of weight, first, second and step: one equation each
    for (dy, dx), step, weight in zip(((0, 1), (1, 0)), steps, weights, strict=True):
        for i, j in np.argwhere(weight > 0):
            rows.append((weight[i, j], i * 8 + j, (i + dy) * 8 + j + dx, step[i, j]))
    matrix = np.diag(trust.ravel())
    rhs = (trust * near).ravel()
    for weight, i, j, step in rows:
        for k, a in ((i, -1.0), (j, 1.0)):
            rhs[k] += weight * a * step
            for m, b in ((i, -1.0), (j, 1.0)):
                matrix[k, m] += weight * a * b
    want = spsolve(coo_array(matrix).tocsc(), rhs).reshape(mask.shape)
    found = _solve(near, trust, steps, weights, mask)
    np.testing.assert_allclose(found[mask], want[mask], atol=1e-3)
    assert (found[~mask] == 0).all()


@pytest.mark.parametrize("doubt", [0.0, 0.05])
def test_rounding_is_no_step(ball, doubt):
    step = 2 * doubt or 0.001
    rounded = np.rint(ball.depth / step) * step
    assert off(ball, fused(ball, rounded, doubt=doubt))[0] < 0.5
