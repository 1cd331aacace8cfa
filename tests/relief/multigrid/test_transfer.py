import numpy as np
import pytest

from relieffab.relief.multigrid.transfer import coarser, parents, prolong, restrict

SHAPES = [(23, 26), (24, 31), (12, 13)]


def random_free(shape, seed=2):
    free = np.zeros(shape, bool)
    inner = (shape[0] - 4, shape[1] - 4)
    free[2:-2, 2:-2] = np.random.default_rng(seed).random(inner) > 0.1
    return free


def coarse_noise(shape, seed=3):
    rows, cols = (coarser(n) for n in shape)
    coarse = np.zeros((rows, cols), np.float32)
    inner = (rows - 4, cols - 4)
    coarse[2:-2, 2:-2] = np.random.default_rng(seed).normal(size=inner)
    return coarse


def test_parents_are_the_two_nearest():
    for i in range(2, 40):
        away = abs(i - 2 * np.arange(30) + 2.5)
        assert list(parents(i)) == list(np.argsort(away)[:2])


@pytest.mark.parametrize("shape", SHAPES)
def test_weights_are_those_of_b_splines(interpolation, shape):
    free, coarse = random_free(shape), coarse_noise(shape)
    p = interpolation(shape, free)
    fine = np.zeros(shape, np.float32)
    prolong(coarse, free, fine)
    np.testing.assert_allclose(fine.ravel(), p @ coarse.ravel(), atol=1e-6)
    x = (np.random.default_rng(4).normal(size=shape) * free).astype(np.float32)
    back = np.zeros_like(coarse)
    restrict(x, back)
    want = (p.T @ x.ravel()).reshape(coarse.shape)
    np.testing.assert_allclose(back[2:-2, 2:-2], want[2:-2, 2:-2], atol=1e-5)
    assert (back[:2] == 0).all()
    assert (back[:, -2:] == 0).all()


@pytest.mark.parametrize("shape", SHAPES)
def test_coarse_nodes_reach_all_free_ones(interpolation, shape):
    # None of the border is needed.
    rows, cols = (coarser(n) for n in shape)
    inner = np.zeros((rows, cols), bool)
    inner[2:-2, 2:-2] = True
    free = random_free(shape)
    assert not interpolation(shape, free)[:, ~inner.ravel()].any()


@pytest.mark.parametrize("shape", SHAPES)
def test_they_are_transposes(shape):
    free, coarse = random_free(shape), coarse_noise(shape)
    x = (np.random.default_rng(5).normal(size=shape) * free).astype(np.float32)
    fine, back = np.zeros(shape, np.float32), np.zeros_like(coarse)
    prolong(coarse, free, fine)
    restrict(x, back)
    left, right = ((a * b).sum(dtype=float) for a, b in ((fine, x), (coarse, back)))
    assert left == pytest.approx(right, rel=1e-5)


def test_one_becomes_one():
    free, coarse = random_free((23, 26)), np.zeros((15, 17), np.float32)
    coarse[2:-2, 2:-2] = 1
    fine = np.zeros(free.shape, np.float32)
    prolong(coarse, free, fine)
    np.testing.assert_allclose(fine[free], 1, rtol=1e-6)
    assert (fine[~free] == 0).all()


def test_what_is_there_is_added_to():
    free, coarse = random_free((23, 26)), coarse_noise((23, 26))
    alone, more = np.zeros(free.shape, np.float32), np.full(free.shape, 2, np.float32)
    prolong(coarse, free, alone)
    prolong(coarse, free, more)
    np.testing.assert_allclose(more, alone + 2, atol=1e-6)
