import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.panel.sinking import sink
from relieffab.stock import Stock


def test_less_than_a_nanometre_is_the_face(make_relief):
    h = np.full((3, 3), -1e-9)
    assert sink(make_relief(h), Stock(4, 4, 4)).empty


def test_a_thin_rim_opens_and_a_wide_one_stays(make_relief):
    relief = make_relief(np.full((3, 4), -1.0), rim=0.4)
    grid = sink(relief, Stock(3.4 + 2, 2.4 + 0.7, 4)).grid
    # Left (0.4), near (0.4) and far (0.7) are thin, right (2.0) is not.
    assert grid.shape == (4, 4)
    assert grid.origin == pytest.approx((-0.6, 3.4))


def test_a_relief_as_deep_as_the_stock_is_refused(make_relief):
    relief = make_relief(np.full((3, 3), -2.0))
    with pytest.raises(InputError, match="cut through the stock"):
        sink(relief, Stock(10, 10, 2.0))


@pytest.mark.parametrize("stock", [Stock(2.9, 10, 4), Stock(10, 2.9, 4)])
def test_a_relief_beyond_the_stock_is_refused(make_relief, stock):
    with pytest.raises(InputError, match=r"0\.1 mm over the edge"):
        sink(make_relief(np.zeros((3, 3))), stock)
