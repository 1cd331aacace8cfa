"""The limits fire for what is beyond them and are silent at them."""

from dataclasses import replace

import numpy as np

from relieffab.cutter import Cutter
from relieffab.fittings import Frame
from relieffab.gcode.limits import Limits, travel_findings
from relieffab.machine import Machine
from relieffab.stock import Stock
from relieffab.toolpath.positions import Position

MACHINE = Machine(
    "mill", "", (100.0, 80.0, 20.0), (1000.0, 900.0, 300.0), (30.0,) * 3, (0.0, 1e4), 1e3
)
FLAT = Cutter("flat", "flat", 2.0, 6.0, 1.0, 800.0, 300.0, 8000.0)
LIMITS = Limits(4.0, 1.0, FLAT, Stock(100.0, 80.0, 10.0), MACHINE)


def findings(points, feed, line=None, bites=None):
    bites = np.zeros(len(points)) if bites is None else np.array(bites)
    return LIMITS.findings(np.array(points, float), np.array(feed, float), bites, line)


def test_motion_at_the_limits_is_fine():
    corners = [[0, 0, 16], [0, 0, -4], [100, 0, -4], [100, 80, -4], [100, 80, 16]]
    assert findings(corners, [np.inf, 300, 1000, 900, np.inf]) == ()


def test_a_slope_may_ask_more_of_z_than_it_can():
    assert findings([[0, 0, 1], [1, 0, -3]], [np.inf, 1000]) == ()


def test_the_first_move_and_the_number_of_moves_are_told():
    line = np.array([3, 8, 9])
    (text,) = findings([[1, 1, 5], [1, 1, -4.01], [2, 1, -4.01]], [np.inf, 100, 100], line)
    assert "Z reaches -4.010 mm" in text
    assert "(2 moves, first at line 8)" in text


def test_leaving_the_stock_below_its_face():
    (text,) = findings([[50, 1, 5], [99, 1, -1], [101, 1, 5]], [np.inf, 100, 100])[:1]
    assert "outside the stock" in text
    assert findings([[50, 1, 5], [99, 1, 0], [100, 1, 5]], [np.inf, 100, 100]) == ()


def test_a_raised_frame_is_not_run_into():
    stock = Stock(100.0, 80.0, 10.0, frame=Frame(10.0, 3.0))
    framed = replace(LIMITS, stock=stock)

    def found(*points):
        feed, bites = np.full(len(points), 100.0), np.zeros(len(points))
        return framed.findings(np.array(points, float), feed, bites)

    # The cutter is 2 mm across: its axis stays 11 mm from the sides.
    assert found([50, 40, 8], [11, 11, 8], [11, 11, -1], [89, 69, -1], [89, 69, 8], [0, 0, 8]) == ()
    for bad in ([10.9, 40, -1], [50, 69.1, -1], [50, 5, 2.9]):
        (text,) = found([50, 40, 8], [50, 40, -1], bad, [50, 40, 8])
        assert "into the raised frame (2 moves, first at move 2)" in text
    # Down on a slant, from over the frame.
    assert "raised frame" in found([5, 40, 8], [20, 40, 1])[0]
    sunk = replace(LIMITS, stock=replace(stock, frame=Frame(10.0, -3.0)))
    assert not any(
        "raised" in t for t in sunk.findings(np.array([[5.0, 5, 1]]), np.ones(1), np.zeros(1))
    )
    narrow = replace(LIMITS, stock=replace(stock, frame=Frame(39.5, 3.0)))
    assert "raised frame" in narrow.findings(np.array([[50.0, 40, 1]]), np.ones(1), np.zeros(1))[0]


def test_travel():
    assert travel_findings(np.array([[0, 0, -5], [100, 80, 15]]), MACHINE) == ()
    (text,) = travel_findings(np.array([[0, 0, -5], [100, 80, 15.01]]), MACHINE)
    assert "20.010 mm of Z" in text


def test_a_window_is_not_left_even_in_the_air():
    place = Position(2, 2, (40.0, 0.0), (100.0, 80.0), (40.0, 0.0))
    limits = replace(LIMITS, position=place)
    inside = np.array([[40.0, 0.0, 5.0], [100.0, 80.0, 5.0]])
    feed = np.array([np.inf, np.inf])
    assert limits.findings(inside, feed, np.zeros(2)) == ()
    (text,) = limits.findings(inside - [0.01, 0.0, 0.0], feed, np.zeros(2))
    assert text == "leaves the window of position 2 (1 moves, first at move 0)"
