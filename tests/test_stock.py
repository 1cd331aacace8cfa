"""The slab, and where its work zero may be."""

import pytest

from relieffab.errors import InputError
from relieffab.stock import PLACES, Stock


def test_nine_points_on_two_levels():
    zeros = {
        Stock.zeroed((120.0, 90.0, 12.0), place, level).work_zero
        for place in PLACES
        for level in ("top", "bottom")
    }
    assert len(PLACES) == 9
    assert zeros == {(x, y, z) for x in (0, 60, 120) for y in (0, 45, 90) for z in (0, -12)}


@pytest.mark.parametrize(
    "zero", [(-0.1, 0, 0), (121, 0, 0), (0, 91, 0), (0, 0, 0.1), (0, 0, -13), (float("nan"), 0, 0)]
)
def test_work_zero_off_the_stock(zero):
    with pytest.raises(InputError, match="off the stock"):
        Stock(120.0, 90.0, 12.0, work_zero=zero)


def test_bad_words_and_sizes():
    with pytest.raises(InputError, match="did you mean near-left"):
        Stock.zeroed((1.0, 1.0, 1.0), "near-lef")
    with pytest.raises(InputError, match="top or bottom"):
        Stock.zeroed((1.0, 1.0, 1.0), "centre", "middle")
    with pytest.raises(InputError, match="width cannot be 0"):
        Stock(0.0, 1.0, 1.0)
