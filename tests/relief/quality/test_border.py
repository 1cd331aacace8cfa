import numpy as np
import pytest

from relieffab.relief.quality.border import border, ripple, touching
from relieffab.relief.quality.pair import Pair


def board(shape):
    i, j = np.indices(shape)
    return 1.0 - 2.0 * ((i + j) % 2)


def test_a_sound_relief_has_no_fault(bench, waves, square):
    h = np.where(touching(square), 0.1 * waves - 1, 0.0)
    found = border(bench.pair_of(waves, h, mask=square))
    assert found.outside == found.beyond == 0
    assert found.checkerboard < 1e-3
    assert found.twist < 0.01


def test_what_is_cut_outside_is_found(bench, waves, square):
    h = np.zeros(waves.shape)
    h[9, 80] = -0.3
    assert border(bench.pair_of(waves, h, mask=square)).outside == pytest.approx(0.3)
    h = np.zeros(waves.shape)
    h[10, 80] = -0.3
    assert border(bench.pair_of(waves, h, mask=square)).outside == 0


def test_a_checkerboard_is_detected(bench, waves):
    found = border(bench.pair_of(waves, board(waves.shape)))
    assert found.checkerboard == pytest.approx(1)
    assert found.twist == pytest.approx(1)


def test_patches_out_of_step_are_too(bench, waves):
    h = board(waves.shape) * np.where(bench.x > 0.1, 1.0, -1.0)
    found = border(bench.pair_of(waves, h))
    assert found.checkerboard < 0.05
    assert found.twist > 0.9


def test_a_flat_relief_ripples_nowhere(bench, waves):
    found = border(bench.pair_of(waves, 0 * waves))
    assert (found.checkerboard, found.twist) == (0, 0)


def test_the_ripple_has_unit_gain_and_sees_no_slope():
    i, j = np.indices((6, 7))
    np.testing.assert_allclose(ripple(board((6, 7)) + 3 * i - 2 * j), board((6, 7))[1:-1, 1:-1])


def test_bounds_that_are_passed_are_measured(bench, waves):
    """No relief can be made that passes them: one that is damaged later can."""
    pair = bench.pair_of(waves, waves)
    relief = pair.relief
    damaged = relief.heights.copy()
    damaged[3, 3] = 0.25
    object.__setattr__(relief, "heights", damaged)
    assert border(Pair(relief, pair.layers)).beyond == 0.25
