import json
from dataclasses import asdict

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.fittings import PLACES, Edge, Frame, Hole, Keyhole
from relieffab.stock import Stock

SHAPED = Stock(
    120,
    90,
    12,
    work_zero=(60, 45, 0),
    shape="round",
    frame=Frame(10, -2, Edge("chamfer", 1)),
    holes=(Hole((5, 45), 3, 6),),
    keyholes=(Keyhole((60, 70)),),
)


def test_a_slab_is_plain_and_all_else_is_not():
    assert Stock(120, 90, 12).plain
    assert Stock(120, 90, 12).top == Stock(120, 90, 12).rim == 0
    assert not Stock(120, 90, 12, corner=1).plain
    assert not Stock(120, 90, 12, holes=(Hole((9, 9), 3),)).plain
    assert not SHAPED.plain


def test_it_comes_back_from_json():
    assert Stock.of(json.loads(json.dumps(asdict(SHAPED)))) == SHAPED
    assert Stock.of(json.loads(json.dumps(asdict(Stock(1, 2, 3))))) == Stock(1, 2, 3)


def test_levels_of_a_sunk_and_a_raised_frame():
    assert (SHAPED.top, SHAPED.rim) == (0, 11)
    assert (SHAPED.level(5, 45), SHAPED.level(60, 45)) == (-2, 0)
    raised = Stock(120, 90, 12, frame=Frame(10, 3, Edge("fillet", 1)))
    assert (raised.top, raised.rim, raised.level(5, 5)) == (3, 10, 3)


def test_the_face_keeps_clear_of_frame_and_holes():
    stock = Stock(120, 90, 12, frame=Frame(10, 3), holes=(Hole((40, 40), 4, 8),))
    x = np.array([9.9, 10.1, 40, 43.9, 44.1])
    assert stock.on_face(x, np.full(5, 40.0)).tolist() == [False, True, False, False, True]
    assert stock.on_face(x, np.full(5, 40.0), 0.2).tolist() == [False] * 5
    assert not stock.on_face(60, 45, 40)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"frame": Frame(45, 2)}, "wider than the panel"),
        ({"frame": Frame(10, -11.5)}, "sunk through"),
        ({"frame": Frame(42.5, -3, Edge("chamfer", 2.9))}, "leaves no face"),
        ({"holes": (Hole((2, 2), 3),)}, "(?s)runs over an edge.*to the outline"),
        ({"holes": (Hole((10, 45), 3),), "frame": Frame(10, 2)}, "edges of frame and face"),
        ({"holes": (Hole((30, 30), 3, 28),)}, "goes through"),
        ({"holes": (Hole((30, 30), 3), Hole((33, 30), 3))}, "run into each other"),
        ({"keyholes": (Keyhole((60, 12)),)}, "(?s)runs over the stock's side.*10 mm under"),
        ({"thickness": 6.0, "keyholes": (Keyhole((60, 60)),)}, "too thin for keyholes"),
        ({"holes": (Hole((60, 52), 3),), "keyholes": (Keyhole((60, 60)),)}, "run into each other"),
        ({"holes": (Hole((10, 10), 3),), "shape": "round"}, "runs over an edge"),
        ({"width": float("nan")}, "width cannot be"),
    ],
)
def test_what_does_not_fit_is_refused(more, message):
    with pytest.raises(InputError, match=message):
        Stock(**{"width": 120, "height": 90, "thickness": 12, **more})


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Frame(0, 2), "no frame"),
        (lambda: Frame(5, 0), "no frame"),
        (lambda: Frame(5, 2, Edge("fillet", 2)), "no room for such a fillet"),
        (lambda: Hole((5, 5), 3, 3), "no wider than its hole"),
    ],
)
def test_fittings_that_are_none_are_refused(make, message):
    with pytest.raises(InputError, match=message):
        make()


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


def test_a_turned_stock_is_seen_from_its_far_side():
    stock = Stock(120.0, 90.0, 12.0, work_zero=(120.0, 90.0, -12.0), turned=True)
    work = stock.to_work([[120.0, 90.0, 0.0], [0.0, 80.0, -1.0]])
    assert work.tolist() == [[0.0, 0.0, 12.0], [120.0, 10.0, 11.0]]
    assert stock.to_panel(work).tolist() == [[120.0, 90.0, 0.0], [0.0, 80.0, -1.0]]
