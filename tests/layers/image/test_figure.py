from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from relieffab.errors import InputError
from relieffab.layers.image.figure import ALPHA, BACKGROUND, GIVEN, SEGMENTED, WHOLE, find_figure
from relieffab.layers.image.read import read_picture


def test_transparency_and_nan_are_background(stone, make_picture):
    alpha = stone.mask.astype(float)
    mask, source = find_figure(make_picture(stone.depth, alpha=alpha), even=True)
    assert source == ALPHA
    np.testing.assert_array_equal(mask, stone.mask)
    unknown = np.where(stone.mask, stone.depth, np.nan)
    mask, source = find_figure(make_picture(unknown, bits=None), even=True)
    np.testing.assert_array_equal(mask, stone.mask)


def test_an_even_background_is_background(stone, depth_map, normal_map):
    for picture in (depth_map(stone, 16)[0], depth_map(stone, 8, white_far=True)[0]):
        mask, source = find_figure(picture, even=True)
        assert source == BACKGROUND
        np.testing.assert_array_equal(mask, stone.mask)
    mask, _ = find_figure(normal_map(stone, 8), even=True)
    np.testing.assert_array_equal(mask, stone.mask)


def test_a_spot_of_the_backgrounds_value_is_a_hole_of_a_depth_map_but_level_in_a_normal_map(
    stone, depth_map, normal_map
):
    row, col = (int(np.median(every)) for every in np.nonzero(stone.mask))
    spot = np.s_[row : row + 3, col : col + 3]
    for picture, there in ((depth_map(stone, 16)[0], False), (normal_map(stone, 8), True)):
        values = picture.values.copy()
        values[spot] = values[0, 0]
        mask, _ = find_figure(replace(picture, values=values), even=True)
        assert mask[spot].all() == there == mask[spot].any()


def test_a_photograph_is_segmented(stone, make_picture):
    rng = np.random.default_rng(0)
    shaded = np.where(stone.mask, 0.2 + 0.8 * stone.shading[0], 0.45)
    shaded = shaded + 0.01 * rng.standard_normal(shaded.shape)
    mask, source = find_figure(make_picture(shaded), even=False)
    assert source == SEGMENTED
    assert (mask != stone.mask).mean() < 0.01


def test_light_that_falls_off_along_the_background_is_not_taken_for_a_figure(stone, make_picture):
    rng = np.random.default_rng(0)
    away = np.linspace(0.25, 0.7, stone.grid.cols) ** 1.5
    shaded = np.where(stone.mask, 0.1 + 0.8 * stone.shading[0], away)
    shaded = shaded + 0.01 * rng.standard_normal(shaded.shape)
    mask, source = find_figure(make_picture(shaded), even=False)
    assert source == SEGMENTED
    assert (mask != stone.mask).mean() < 0.02


def test_the_background_is_seen_through_small_gaps(stone, make_picture):
    rng = np.random.default_rng(0)
    row, col = (int(np.median(every)) for every in np.nonzero(stone.mask))
    gap = np.zeros(stone.grid.shape, bool)
    gap[row - 11 : row + 11, col - 11 : col + 11] = True
    shaded = np.where(stone.mask & ~gap, 0.2 + 0.8 * stone.shading[0], 0.6)
    shaded = shaded + 0.01 * rng.standard_normal(shaded.shape)
    mask, _ = find_figure(make_picture(shaded), even=False)
    assert mask[gap].mean() < 0.3
    assert mask[stone.mask & ~gap].mean() > 0.98


def test_what_has_no_background_is_figure_all_over(make_picture):
    noise = np.random.default_rng(0).random((64, 80))
    mask, source = find_figure(make_picture(noise), even=False)
    assert (source, mask.all()) == (WHOLE, True)


def test_a_given_mask_counts_and_must_fit(stone, make_picture, tmp_path):
    path = tmp_path / "mask.png"
    half = stone.mask & (np.arange(stone.grid.cols) < 160)
    Image.fromarray(half.astype(np.uint8) * 255).save(path)
    mask, source = find_figure(make_picture(stone.depth), read_picture(path), even=True)
    assert source == GIVEN
    np.testing.assert_array_equal(mask, half)
    Image.fromarray(half[:100].astype(np.uint8) * 255).save(path)
    with pytest.raises(InputError, match="does not fit"):
        find_figure(make_picture(stone.depth), read_picture(path), even=True)
    with pytest.raises(InputError, match="is empty"):
        find_figure(make_picture(stone.depth, alpha=np.zeros(stone.grid.shape)), even=True)


def test_specks_are_no_figure(stone, depth_map):
    picture, _ = depth_map(stone, 16)
    spoiled = picture.values.copy()
    spoiled[3, 3] = 0.5
    mask, _ = find_figure(type(picture)(spoiled, None, 16, "PNG", "a"), even=True)
    assert not mask[3, 3]
