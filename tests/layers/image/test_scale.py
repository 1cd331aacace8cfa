import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.image.figure import ALPHA, BACKGROUND, WHOLE
from relieffab.layers.image.scale import to_length, unit_of, white_is_far


@pytest.mark.parametrize("far", [False, True])
def test_which_end_is_near(stone, depth_map, make_picture, far):
    picture, _ = depth_map(stone, 16, white_far=far)
    assert white_is_far(picture, stone.mask, BACKGROUND) == (far, "background")
    cut = make_picture(np.where(stone.mask, picture.grey, np.nan), bits=None)
    assert white_is_far(cut, stone.mask, ALPHA) == (far, "form")


def test_a_map_that_does_not_tell_is_read_by_custom(make_picture):
    noise = np.random.default_rng(0).random((60, 60))
    assert white_is_far(make_picture(noise), np.ones((60, 60), bool), WHOLE) == (False, "custom")


def test_depth_gets_the_length_asked_for_or_half_the_shorter_side(stone):
    depth = to_length(stone.depth, stone.mask, 0.1, 7.0, "a")
    assert np.ptp(depth[stone.mask]) == pytest.approx(7.0)
    assert depth.max() == 0
    rows = np.flatnonzero(stone.mask.any(axis=1))
    usual = to_length(stone.depth, stone.mask, 0.1, None, "a")
    assert np.ptp(usual[stone.mask]) == pytest.approx(0.05 * (np.ptp(rows) + 1))
    with pytest.raises(InputError, match="level"):
        to_length(np.ones((20, 20)), np.ones((20, 20), bool), 0.1, None, "a")


def slopes_of(layers):
    return -np.moveaxis(layers.normals[..., :2] / layers.normals[..., 2:], 2, 0)


@pytest.mark.parametrize("unit", [40.0, -0.5])
def test_normals_tell_a_depth_maps_unit_whatever_steps_in_it(ball, unit):
    found, alike = unit_of(ball.depth / unit + 3.0, ball.mask, slopes_of(ball), 0.25)
    assert found == pytest.approx(unit, rel=0.01)
    assert alike > 0.9


def test_what_shows_something_else_is_not_alike(ball, stone):
    rng = np.random.default_rng(0)
    for other in (ball.depth[::-1], rng.random(ball.depth.shape), ball.normals[..., 2]):
        assert unit_of(other, ball.mask, slopes_of(ball), 0.25)[1] < 0.4
    assert unit_of(np.ones((30, 30)), np.ones((30, 30), bool), np.ones((2, 30, 30)), 1.0) == (0, 0)
