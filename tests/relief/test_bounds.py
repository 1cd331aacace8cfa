import numpy as np

from relieffab.relief.bounds import hold, move, within

LOW = np.array([[-2.0, -2.0, -1.0, -np.inf, -2.0, -2.0]], np.float32)


def test_heights_pushed_against_a_bound_are_held():
    # At the low bound, at it, below none, without one, at the high one, at it.
    h = np.array([[-2.0, -2.0, -1.0, -9.0, 0.0, 0.0]])
    gradient = np.array([[1.0, -1.0, 2.0, 3.0, -1.0, 4.0]])
    free, pull, norm = hold(gradient, h, (LOW, 0.0), np.ones(h.shape, bool))
    np.testing.assert_array_equal(free, [[False, True, False, True, False, True]])
    np.testing.assert_array_equal(pull, [[0, -1, 0, 3, 0, 4]])
    assert norm == np.sqrt(1 + 9 + 16)


def test_heights_between_the_bounds_are_free_whatever_the_gradient():
    h = np.full((1, 6), -0.5)
    gradient = np.array([[1.0, -1.0, 2.0, -3.0, 0.0, 4.0]])
    free, pull, _ = hold(gradient, h, (LOW, 0.0), np.ones(h.shape, bool))
    assert free.all()
    np.testing.assert_array_equal(pull, gradient)


def test_a_height_at_its_bound_that_nothing_pushes_is_free():
    h = np.array([[-2.0, 0.0]])
    free, pull, norm = hold(0 * h, h, (LOW[:, :2], 0.0), np.ones(h.shape, bool))
    assert free.all()
    assert not pull.any()
    assert norm == 0


def test_nodes_outside_the_figure_never_move():
    h, gradient = np.full((1, 6), -0.5), np.ones((1, 6))
    figure = np.array([[True, False, False, True, True, False]])
    free, pull, norm = hold(gradient, h, (LOW, 0.0), figure)
    np.testing.assert_array_equal(free, figure)
    np.testing.assert_array_equal(pull, figure * 1.0)
    assert norm == np.sqrt(3)


def test_without_bounds_the_projected_gradient_is_the_gradient():
    rng = np.random.default_rng(0)
    h, gradient = rng.normal(size=(2, 20, 30))
    none = np.full(h.shape, -np.inf, np.float32), np.inf
    free, pull, norm = hold(gradient, h, none, np.ones(h.shape, bool))
    assert free.all()
    np.testing.assert_array_equal(pull, gradient)
    np.testing.assert_allclose(norm, np.linalg.norm(gradient))


def test_moves_end_at_the_bounds():
    h = np.array([[-1.5, -1.5, -0.5, -9.0, -0.5, -1.0]])
    step = np.array([[-2.0, 0.5, -0.5, -8.0, 2.0, 0.0]])
    before = h.copy()
    out = move(h, step, 0.5, (LOW, 0.0))
    np.testing.assert_array_equal(out, [[-2.0, -1.25, -0.75, -13.0, 0.0, -1.0]])
    np.testing.assert_array_equal(h, before)


def test_a_move_is_the_clipped_sum():
    rng = np.random.default_rng(1)
    h, step = rng.normal(size=(2, 20, 30))
    low = rng.normal(size=h.shape).astype(np.float32) - 1
    np.testing.assert_allclose(move(h, step, 0.3, (low, 0.7)), np.clip(h + 0.3 * step, low, 0.7))


def test_a_guess_is_brought_within_the_bounds_and_the_figure():
    guess = np.array([[-3.0, -1.0, -1.5, -9.0, 0.5, -1.0]], np.float32)
    figure = np.array([[True, True, True, True, True, False]])
    found = within(guess, (LOW, 0.0), figure)
    np.testing.assert_array_equal(found, [[-2, -1, -1, -9, 0, 0]])
    assert found.dtype == np.float64
