import math

import pytest

from relieffab.grbl.travel import Tracker


def follow(*lines):
    tracker = Tracker()
    return tracker, sum(tracker.follow(line) for line in lines)


@pytest.mark.parametrize(
    ("lines", "length"),
    [
        (["G0X0Y0Z0", "G1X3Y4", "Z-12"], 5 + 12),
        (["G0X0Y0Z0", "G0X100", "G1X101"], 1),
        (["G20", "G0X0Y0Z0", "G1X1"], 25.4),
        (["G0X5Y5Z0", "G91", "G1X1", "X1"], 2),
        (["G1X10"], 0),
        (["G0X0Y0Z0", "G1Z0", "S100", "M3"], 0),
        (["G17G0X10Y0Z0", "G3X0Y10I-10J0"], 10 * math.pi / 2),
        (["G17G0X10Y0Z0", "G2X0Y10I-10J0"], 10 * math.pi * 3 / 2),
        (["G17G0X10Y0Z0", "G3X0Y10R10"], 10 * math.pi / 2),
        (["G17G0X10Y0Z0", "G3X0Y10R-10"], 10 * math.pi * 3 / 2),
        (["G17G0X10Y0Z0", "G2X10Y0I-10J0"], 10 * math.tau),
        (["G18G0X0Y0Z10", "G2X10Z0I0K-10"], 10 * math.pi * 3 / 2),
        (["G17G0X10Y0Z0", "G3X10Y0Z7I-10J0"], math.hypot(10 * math.tau, 7)),
        (["G0X0Y0Z0", "G53G0X-10", "G1X5", "X7"], 2),
    ],
)
def test_length_of_cut(lines, length):
    assert follow(*lines)[1] == pytest.approx(length, rel=1e-3)


def test_bounds_hold_what_arcs_bulge_out():
    tracker, _ = follow("G0X10Y0Z1", "G3X-10Y0I-10J0", "G1Z-2")
    assert tracker.low == pytest.approx([-10, 0, -2])
    assert tracker.high == pytest.approx([10, 10, 1], abs=0.01)


def test_an_axis_never_named_has_no_bounds():
    tracker, _ = follow("G0X1", "G1X2F100")
    assert tracker.low == [1, None, None]


@pytest.mark.parametrize("line", ["G92X0", "G55", "G10L2P1X5", "G28", "G53G0Z0", "G91G1X1"])
def test_what_cannot_be_followed_is_admitted(line):
    assert not follow(line)[0].certain


def test_a_plain_program_is_certain():
    assert follow("G21G90G54G17", "G0X0Y0", "G1X5F100")[0].certain
