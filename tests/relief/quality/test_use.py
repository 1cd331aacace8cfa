import numpy as np
import pytest

from relieffab.relief.model import Relief
from relieffab.relief.quality.pair import Pair
from relieffab.relief.quality.use import inner_nodes, use


def test_a_ramp_uses_all_there_is(bench, waves):
    ramp = bench.x / 40.0 - 0.5
    pair = Pair(
        Relief(bench.grid, ramp, np.ones(bench.grid.shape, bool), 1.0), bench.layers_of(waves)
    )
    found = use(pair)
    assert found.span == pytest.approx(0.98, abs=0.01)
    assert found.entropy == pytest.approx(1, abs=0.01)


def test_a_flat_one_uses_nothing(bench, waves):
    found = use(bench.pair_of(waves, 0 * waves))
    assert (found.span, found.entropy, found.at_depth, found.at_face) == (0, 0, 0, 1)


def test_heights_at_the_bounds_are_counted(bench, waves, square):
    half = -2.0 * (bench.x > 0.1)
    found = use(bench.pair_of(waves, half, mask=square))
    assert found.at_depth == pytest.approx(0.5, abs=0.01)
    assert found.at_depth + found.at_face == 1
    assert found.entropy == pytest.approx(np.log(2) / np.log(64), abs=1e-3)


def test_nodes_inside_have_four_pixels_of_the_figure(square):
    assert inner_nodes(square).sum() == 99 * 139
    assert inner_nodes(square).shape == (121, 161)


def test_a_figure_of_one_pixel_has_none(bench, waves):
    mask = np.zeros(bench.grid.shape, bool)
    mask[50, 50] = True
    assert np.isnan(use(bench.pair_of(waves, 0 * waves, mask=mask)).span)
