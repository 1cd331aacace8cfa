import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.layers.lines.drawing import Drawing


@pytest.mark.parametrize("name", ["detail", "min_length", "spacing", "tolerance", "width"])
@pytest.mark.parametrize("value", [-1.0, np.nan, np.inf])
def test_lengths_must_be_lengths(name, value):
    with pytest.raises(InputError, match=name):
        Drawing(**{name: value})


@pytest.mark.parametrize("value", [-0.1, 1.1, np.nan])
def test_secondary_is_a_share(value):
    with pytest.raises(InputError, match="secondary"):
        Drawing(secondary=value)


def test_spread_may_be_negative_but_not_endless():
    assert Drawing(spread=-0.2).spread == -0.2
    for spread in (np.inf, np.nan, -5.0, 2.0):
        with pytest.raises(InputError, match="spread"):
            Drawing(spread=spread)


def test_kinds_are_put_in_order():
    assert Drawing(kinds=("valley", "contour")).kinds == ("contour", "valley")
