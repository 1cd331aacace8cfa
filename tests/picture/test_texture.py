import numpy as np
import pytest

from relieffab.picture.texture import colour_of, plain_colour


def test_stone_is_the_same_all_over():
    assert colour_of("stone", np.zeros((4, 5), np.float32), 0.1).tolist() == [0.82, 0.67, 0.47]


def test_rings_run_along_the_board():
    wood = colour_of("wood", np.zeros((120, 160), np.float32), 0.5)
    assert wood.shape == (120, 160, 3)
    assert 0 < wood.min() < wood.max() <= 1
    light = wood.sum(axis=2)
    # Smooth the fibres away: what is left changes faster across than along.
    rough = light.reshape(60, 2, 80, 2).mean(axis=(1, 3))
    assert np.abs(np.diff(rough, axis=0)).mean() > 2 * np.abs(np.diff(rough, axis=1)).mean()
    assert wood.mean(axis=(0, 1)) == pytest.approx(plain_colour("wood"), abs=0.08)


def test_the_same_board_at_every_resolution():
    coarse = colour_of("wood", np.zeros((60, 80), np.float32), 1.0)
    fine = colour_of("wood", np.zeros((240, 320), np.float32), 0.25)
    averaged = fine.reshape(60, 4, 80, 4, 3).mean(axis=(1, 3))
    assert np.corrcoef(coarse.ravel(), averaged.ravel())[0, 1] > 0.9


def test_carving_cuts_through_the_rings():
    flat = np.zeros((60, 80), np.float32)
    deeper = colour_of("wood", flat - 1.5, 0.5)
    assert np.abs(deeper - colour_of("wood", flat, 0.5)).max() > 0.05
