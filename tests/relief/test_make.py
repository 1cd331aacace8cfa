import numpy as np
import pytest

from relieffab.relief.classic.methods import METHODS
from relieffab.relief.make import make_relief
from relieffab.relief.names import CLASSIC, NAMES, SUNKEN
from relieffab.relief.targets import Carving, to_nodes


def test_the_names_are_those_of_the_methods():
    assert tuple(METHODS) == CLASSIC
    assert Carving().method == SUNKEN


@pytest.mark.parametrize("name", NAMES)
def test_every_method_makes_a_relief_of_the_same_figure(name, layers):
    relief, solution = make_relief(layers, Carving(depth=2.0, method=name))
    figure = to_nodes(layers.mask.astype(float), np.ones(layers.grid.shape)) > 0
    assert relief.heights.min() >= -2.0
    assert relief.heights[figure].max() == 0.0
    assert (relief.heights[~figure] == 0).all()
    assert np.ptp(relief.heights) > 1.0
    np.testing.assert_array_equal(relief.mask, layers.mask)
    assert relief.depth == 2.0
    assert (solution is None) == (name != SUNKEN)


def test_methods_differ(layers):
    made = {n: make_relief(layers, Carving(depth=2.0, method=n))[0].heights for n in NAMES}
    for one in NAMES:
        for other in NAMES:
            assert (one == other) == np.allclose(made[one], made[other], atol=1e-3)
