import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.model import Layers
from relieffab.relief.edge import fill, inward_distance, wall
from relieffab.relief.targets import Carving, groove, terms_of, to_nodes


def disc(radius, size=80):
    i, j = np.indices((size, size)) + 0.5
    return np.hypot(i - size / 2, j - size / 2) < radius


def test_distance_to_a_discs_edge_is_smooth_and_right():
    d = inward_distance(disc(30))
    i, j = np.indices((81, 81))
    true = 30 - np.hypot(i - 40, j - 40)
    near = np.abs(true) < 5
    assert np.abs(d - true)[near].max() < 0.6
    assert np.abs(d - true)[near].mean() < 0.25


def test_the_wall_has_its_angle():
    w = wall(disc(30), 0.2, 80.0)
    assert (w[:9] == 0).all()
    slope = (w[40, 16] - w[40, 20]) / (4 * 0.2)
    assert np.degrees(np.arctan(slope)) == pytest.approx(80, abs=0.5)


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
        terms_of(x, Carving(), (-4.0, -1.0), (-4.0, 0.0)) for x in (layers, finer_layers)
    )
    assert fine.depth_weight.sum() == pytest.approx(coarse.depth_weight.sum(), rel=0.02)
    assert fine.light_weight.sum() == pytest.approx(coarse.light_weight.sum(), rel=0.03)
    assert fine.form_weight.sum() == pytest.approx(coarse.form_weight.sum(), rel=0.03)


def test_nothing_is_asked_outside_the_figure(layers):
    terms = terms_of(layers, Carving(), (-4.0, -1.0), (-4.0, 0.0))
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
    ],
)
def test_carvings_that_make_no_sense_are_refused(values):
    with pytest.raises(InputError):
        Carving(**values)


def test_filling_is_the_rolling_ball_and_keeps_what_the_ball_reaches():
    # A slot 0.3 mm wide and 1 mm deep; a ball of 0.25 mm radius bridges it.
    pitch, radius = 0.05, 0.25
    heights = np.zeros((41, 41))
    heights[:, 18:23] = -1.0
    filled = fill(heights, pitch, radius)
    sag = radius - np.sqrt(radius**2 - 0.15**2)
    assert filled[20, 20] == pytest.approx(-sag, abs=0.01)
    assert (filled >= heights).all()
    bowl = np.add.outer(np.linspace(-1, 1, 41) ** 2, np.linspace(-1, 1, 41) ** 2)
    np.testing.assert_allclose(fill(bowl, pitch, radius)[9:-9, 9:-9], bowl[9:-9, 9:-9], atol=5e-3)
    assert fill(heights, 1.0, radius) is heights
