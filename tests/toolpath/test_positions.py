"""Windows cover the stock, overlap as asked, and lie within the machine's travel."""

from dataclasses import asdict, replace
from itertools import pairwise

import numpy as np
import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position, positions

MACHINE = profiles.machine("3018-prover")
CUTTERS = tuple(profiles.cutter(name) for name in ("flat-3.175", "tapered-ball-1"))


def placed(width, height, way="index", overlap=5.0, **more):
    return positions(Stock(width, height, 12.0), MACHINE, CUTTERS, way, overlap=overlap, **more)


def test_a_panel_within_reach_needs_none():
    assert placed(263.0, 157.0) == () and placed(263.0, 157.0, "turn") == ()


@pytest.mark.parametrize("overlap", [3.175, 5.0, 40.0])
@pytest.mark.parametrize("length", [263.1, 300.0, 521.0, 600.0, 1234.5])
def test_windows_of_an_indexed_panel(length, overlap):
    found = placed(length, 90.0, overlap=overlap)
    assert found[0].low == (0.0, 0.0) and found[-1].high == (length, 90.0)
    for k, one in enumerate(found):
        assert (one.number, one.count) == (k + 1, len(found))
        assert one.size[0] <= 263.0 and one.size[1] == 90.0
        assert one.zero == one.low and not one.turned
        assert one.low[0] == k * found[1].low[0] == round(one.low[0])
    for one, other in pairwise(found):
        low, high = one.overlap(other)
        assert (high - low)[0] >= overlap - 1e-9
    # One fewer could not reach the end, a millimetre apart or not.
    fewer = len(found) - 1
    assert fewer * 263.0 - (fewer - 1) * overlap < length + fewer


def test_windows_along_y():
    first, second = placed(200.0, 250.0)
    assert first.high == (200.0, 128.0) and second.low == (0.0, 123.0)
    assert second.placing == "move the stock 123 mm nearer than where it lay at position 1"


def test_a_turned_panel_has_its_second_zero_at_the_far_right():
    first, second = placed(300.0, 90.0, "turn")
    assert (first.low, first.high, first.zero) == ((0, 0), (152.5, 90), (0, 0))
    assert (second.low, second.high, second.zero) == ((147.5, 0), (300, 90), (300, 90))
    assert second.turned and not first.turned
    assert "turn" in second.placing


@pytest.mark.parametrize("way", ["index", "turn"])
def test_work_zero_is_at_the_same_point_of_every_window(way):
    stock = Stock(300.0, 90.0, 12.0)
    seen = set()
    for one in placed(300.0, 90.0, way, overlap=6.0, zero=(1.0, 0.5)):
        lies = replace(stock, work_zero=(*one.zero, 0.0), turned=one.turned)
        corners = lies.to_work([(*one.low, 0.0), (*one.high, 0.0)])
        seen.add((*corners.min(axis=0), *corners.max(axis=0)))
    assert seen == {(-153.0, -45.0, 0.0, 0.0, 45.0, 0.0)}


def test_what_a_window_holds():
    one = Position(1, 2, (10.0, 0.0), (20.0, 5.0), (10.0, 0.0))
    x = np.array([9.9, 10.0, 10.02, 19.98, 20.0, 15.0, 15.0])
    y = np.array([2.0, 2.0, 2.0, 2.0, 2.0, -0.1, 5.1])
    assert one.holds(x, y).tolist() == [False, False, True, True, False, False, False]


def test_it_goes_through_json():
    for one in placed(300.0, 90.0, "turn"):
        listed = {k: list(v) if isinstance(v, tuple) else v for k, v in asdict(one).items()}
        assert Position.of(listed) == one


@pytest.mark.parametrize(
    ("size", "more", "word"),
    [
        ((300.0, 160.0), {}, "too large both ways"),
        ((300.0, 90.0), {"overlap": 3.1}, "flat-3.175 is wider than the positions' overlap"),
        ((300.0, 90.0), {"overlap": 262.5}, "no way to go on"),
        ((523.0, 90.0), {"way": "turn"}, "(?s)half the panel.*521 mm in X.*index"),
        ((300.0, 90.0), {"way": "roll"}, "no such way"),
    ],
)
def test_windows_that_cannot_work(size, more, word):
    with pytest.raises(InputError, match=word):
        placed(*size, **more)
