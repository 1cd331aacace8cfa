import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.grbl.tracker import Tracker


def follow(*lines):
    tracker = Tracker()
    motions = [motion for line in lines if (motion := tracker.follow(line))]
    return tracker, sum(motion.length for motion in motions if motion.cutting)


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


@pytest.mark.parametrize(
    "line", ["G92X0", "G55", "G38.2Z-1F50", "G10L2P1X5", "G28", "G53G0Z0", "G91G1X1"]
)
def test_what_cannot_be_followed_is_admitted(line):
    assert not follow(line)[0].certain


@pytest.mark.parametrize(
    ("line", "followed"),
    [("G28", True), ("G40G49G80", True), ("G92.1", True), ("G91G30Z0", True),
     ("G53G0Z0", True), ("G38.2Z-9F50", True),
     ("G92X0", False), ("G55", False), ("G10L20P1X0", False), ("G43.1Z3", False)],
)  # fmt: skip
def test_places_are_found_again_unless_work_zero_moves(line, followed):
    tracker, _ = follow("G0X1Y2Z3", line, "G90", "G0X1", "G0Y2", "G0Z3")
    assert tracker.followed is followed
    assert tracker.position == (1, 2, 3)


def test_only_the_axes_named_go_away():
    tracker = Tracker((1.0, 2.0, 3.0))
    motion = tracker.follow("G53G0Z-1")
    assert (motion.known, motion.length, tracker.position) == (False, 0, (1, 2, None))
    tracker.follow("G38.2X9F20")
    assert tracker.follow("M5") is None
    assert tracker.position == (None, 2, None)


def test_a_plain_program_is_certain():
    assert follow("G21G90G54G17", "G0X0Y0", "G1X5F100")[0].certain


WORDS = st.lists(
    st.sampled_from(
        ["G0", "G1", "G90", "G91", "G20", "G21", "X1", "Y-2.5", "Z0.25", "F300", "X7.125", "S900"]
    ),
    min_size=1,
    max_size=4,
    unique_by=lambda word: word[0] + ("m" if word in ("G0", "G1") else ""),
)


@given(st.lists(WORDS.map("".join), max_size=30))
def test_the_quick_way_through_plain_lines_changes_nothing(lines):
    """The same lines, once by the pattern of plain moves and once without it."""
    quick, slow = Tracker((0, 0, 0)), Tracker((0, 0, 0))
    for tracker in (quick, slow):
        tracker.follow("G0X0Y0Z0")
    for line in lines:
        a, b = quick.follow(line), slow._any(line)
        if a is None or b is None:
            assert a is b
        else:
            assert a.points == b.points
            assert (a.length, a.feed) == pytest.approx((b.length, b.feed))
    assert (quick.position, quick.low, quick.high) == (slow.position, slow.low, slow.high)
    assert (quick.modal, quick.plunge) == (slow.modal, slow.plunge)


def test_what_is_in_force_is_known():
    modal = follow("G20G91", "G18M4S800", "M8", "G1X1F5", "G93")[0].modal
    assert (modal.units, modal.distance, modal.plane, modal.feed_mode) == (20, 91, 18, 93)
    assert (modal.spindle, modal.speed, modal.flood, modal.feed) == (4, 800, True, 5)
    ended = follow("G20G91", "G18M4S800", "M8", "M30")[0].modal
    assert (ended.units, ended.distance, ended.plane, ended.quiet) == (20, 90, 17, True)


def test_the_slowest_plunge_and_the_feeds_are_known():
    tracker, _ = follow("G0X0Y0Z5", "G1Z1F300", "Z-1F100", "X5F900", "Z2")
    assert tracker.plunge == 100
    assert Tracker((0, 0, 0)).follow("G93G1X10F2").feed == 20
    assert Tracker((0, 0, 0)).follow("G0X1").feed == math.inf
