import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.model import Layers
from relieffab.layers.occlusion import occlusions
from relieffab.relief.groove import BEYOND, inked
from relieffab.relief.model import nodes_of, pixel_slopes, to_nodes
from relieffab.relief.targets import Carving, Fit, line_depth, terms_of


def test_node_means_use_only_the_figure():
    value = np.array([[1.0, 9.0], [3.0, 9.0]])
    nodes = to_nodes(value, np.array([[1.0, 0], [1, 0]]))
    assert nodes[1, 1] == 2
    assert nodes[0, 2] == 0


def with_line(layers):
    lines = np.zeros(layers.grid.shape)
    lines[:, 78:82] = 1.0
    return Layers(**{**vars(layers), "lines": lines})


def test_a_line_is_as_deep_as_asked(layers):
    cut = inked(with_line(layers), 0.5)
    assert cut.min() == pytest.approx(-0.5)
    assert (cut[:, :70] == 0).all()


@pytest.mark.parametrize(("side", "middle"), [(0.0, 0.0), (1.0, -BEYOND), (-1.0, BEYOND)])
def test_a_groove_lies_downhill_of_its_line(layers, side, middle):
    x = layers.grid.pitch * (np.arange(layers.grid.cols) - 79.5)
    ramp = np.broadcast_to(side * x, layers.grid.shape)
    whole = np.ones(layers.grid.shape, bool)
    lines = with_line(layers).lines
    sloped = Layers(**{**vars(layers), "depth": ramp, "mask": whole, "lines": lines})
    row = inked(sloped, 0.5)[60]
    at = layers.grid.pitch * (np.arange(len(row)) - 80.0)
    assert (at * row).sum() / row.sum() == pytest.approx(middle, abs=0.02)


def test_the_farther_part_is_cut_at_an_occlusion(layers):
    depth = np.zeros(layers.grid.shape)
    depth[:, 80:] = 5.0
    whole = np.ones(layers.grid.shape, bool)
    lines = with_line(layers).lines
    torn = Layers(**{**vars(layers), "depth": depth, "mask": whole, "lines": lines})
    row = inked(torn, 0.5)[60]
    assert row[:81].sum() < 4 * row[81:].sum() < 0


def free(layers):
    return np.full(layers.grid.node_shape, -np.inf, np.float32), np.inf


def test_an_occlusion_asks_for_the_forms_own_step(layers):
    depth = layers.depth.copy()
    depth[:, 80:] += 5.0
    torn = Layers(**{**vars(layers), "depth": depth * layers.mask})
    row = layers.grid.rows // 2
    terms = terms_of(torn, Carving(line_depth=0.0), Fit((-4.0, -1.0), 1.0), free(layers))
    assert not terms.mask[row, 79:81].any()
    assert terms.mask[row, 78]
    assert (terms.stencil[row, 79:81] > 0).all()
    across = pixel_slopes(terms.form.astype(float), layers.pitch)[:, row, 79:81]
    np.testing.assert_allclose(terms.slope[:, row, 79:81], across, atol=1e-5)
    step = terms.slope[0, row, 79:81].sum() * layers.pitch
    assert step == pytest.approx(terms.form[row, 81] - terms.form[row, 79], rel=0.02)


def test_slopes_elsewhere_are_the_compressed_ones_times_the_gain(layers):
    one, half = (
        terms_of(layers, Carving(line_depth=0.0), Fit((-4.0, -1.0), gain), free(layers))
        for gain in (1.0, 0.5)
    )
    np.testing.assert_allclose(half.slope, 0.5 * one.slope, atol=1e-6)
    assert 0.2 < np.hypot(*one.slope).max() <= 1.0


def test_lines_are_not_deeper_than_asked():
    assert line_depth(Carving(depth=1.6)) == pytest.approx(0.1)
    assert line_depth(Carving(depth=16.0)) == pytest.approx(0.4)
    assert line_depth(Carving(depth=16.0, line_depth=1.5)) == 1.5


def test_weights_mean_the_same_at_any_resolution(layers, finer_layers):
    coarse, fine = (
        terms_of(x, Carving(), Fit((-4.0, -1.0), 1.0), free(x)) for x in (layers, finer_layers)
    )
    for name, count in (("depth", "mask"), ("light", "whole"), ("form", "figure")):
        a, b = (getattr(t.weights, name) * getattr(t, count).sum() for t in (coarse, fine))
        assert b == pytest.approx(a, rel=0.03)


def test_nothing_is_asked_outside_the_figure(layers):
    terms = terms_of(with_line(layers), Carving(), Fit((-4.0, -1.0), 1.0), free(layers))
    assert not terms.mask[~layers.mask].any()
    assert (terms.stencil[~layers.mask] == 0).all()
    touched = nodes_of(layers.mask)
    np.testing.assert_array_equal(terms.figure, touched)
    assert not terms.whole[~touched].any()
    assert (terms.form[~touched] == 0).all()


def test_an_occlusion_is_where_depth_jumps(layers):
    depth = layers.depth.copy()
    depth[:, 80:] += 5.0
    torn = Layers(**{**vars(layers), "depth": depth * layers.mask})
    across, _ = occlusions(torn, np.zeros((2, *layers.grid.shape)))
    assert across[layers.grid.rows // 2, 79]


def test_a_single_pixel_that_jumps_parts_nothing(layers):
    depth = layers.depth.copy()
    row, col = layers.grid.rows // 2, 80
    depth[row, col] += 5.0
    speck = Layers(**{**vars(layers), "depth": depth, "lines": np.zeros_like(depth)})
    assert occlusions(speck, np.zeros((2, *layers.grid.shape)))[0][row, col]
    assert terms_of(speck, Carving(), Fit((-4.0, -1.0), 1.0), free(layers)).mask[row, col]


@pytest.mark.parametrize(
    "values",
    [
        {"depth": 0.0},
        {"depth": np.nan},
        {"depth": np.inf},
        {"wall_angle": 90.5},
        {"wall_angle": 0.0},
        {"line_depth": -1.0},
        {"form_length": 0.0},
        {"light_weight": -1.0},
        {"form_weight": 0.0},
        {"method": "engraved"},
    ],
)
def test_carvings_that_make_no_sense_are_refused(values):
    with pytest.raises(InputError):
        Carving(**values)
