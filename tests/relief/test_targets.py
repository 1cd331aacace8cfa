import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.model import Layers
from relieffab.relief.targets import Carving, Fit, groove, terms_of, to_nodes


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
    cut = groove(with_line(layers), 0.5)
    assert cut.min() == pytest.approx(-0.5)
    assert (cut[:, :70] == 0).all()


def test_weights_mean_the_same_at_any_resolution(layers, finer_layers):
    coarse, fine = (
        terms_of(x, Carving(), Fit((-4.0, -1.0), 1.0), (-4.0, 0.0)) for x in (layers, finer_layers)
    )
    assert fine.depth_weight.sum() == pytest.approx(coarse.depth_weight.sum(), rel=0.02)
    assert fine.light_weight.sum() == pytest.approx(coarse.light_weight.sum(), rel=0.03)
    assert fine.form_weight.sum() == pytest.approx(coarse.form_weight.sum(), rel=0.03)


def test_nothing_is_asked_outside_the_figure(layers):
    terms = terms_of(layers, Carving(), Fit((-4.0, -1.0), 1.0), (-4.0, 0.0))
    assert (terms.depth_weight[~layers.mask] == 0).all()
    touched = to_nodes(layers.mask.astype(float), np.ones(layers.grid.shape)) > 0
    assert ((terms.form_weight > 0) == touched).all()
    assert (terms.light_weight[~touched] == 0).all()


@pytest.mark.parametrize(
    "values",
    [
        {"depth": 0.0},
        {"depth": np.nan},
        {"depth": np.inf},
        {"wall_angle": 90.0},
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
