"""Colours of a deviation, and no fault lost in making the map small."""

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.picture.deviation import BAR, EVEN, HIGH, LOW, OUTSIDE, deviation_map


def test_colours_are_full_at_the_limit_and_even_at_nothing():
    field = np.array([[-0.3, -0.1, 0.0, 0.05, 0.1, 0.4]], np.float32)
    image = deviation_map(field, np.ones_like(field, bool), 0.1)
    assert image.shape == (1 + BAR, 6, 3)
    assert [tuple(image[0, k].tolist()) for k in (0, 1, 2, 4, 5)] == [LOW, LOW, EVEN, HIGH, HIGH]
    assert np.abs(image[0, 3] - (np.array(EVEN) + HIGH) / 2.0).max() <= 1


def test_one_bad_node_among_many_is_seen():
    field = np.zeros((400, 700), np.float32)
    field[123, 456], field[300, 20] = -0.2, 0.2
    image = deviation_map(field, np.ones_like(field, bool), 0.1, width=100)
    assert image.shape == (58 + BAR, 100, 3)
    assert tuple(image[123 // 7, 456 // 7].tolist()) == LOW
    assert tuple(image[300 // 7, 20 // 7].tolist()) == HIGH
    assert (image[:58] != EVEN).any(axis=2).sum() == 2


def test_off_the_figure_it_is_darker():
    field = np.zeros((2, 2), np.float32)
    image = deviation_map(field, np.array([[True, False], [True, False]]), 0.1)
    assert tuple(image[0, 0].tolist()) == EVEN
    assert np.abs(image[0, 1] - OUTSIDE * np.array(EVEN)).max() <= 0.5


def test_what_does_not_fit():
    with pytest.raises(InputError, match="do not fit"):
        deviation_map(np.zeros((2, 3), np.float32), np.ones((3, 2), bool), 0.1)
    with pytest.raises(InputError, match="do not fit"):
        deviation_map(np.zeros((2, 3), np.float32), np.ones((2, 3), bool), 0.0)
