import math
from dataclasses import replace

import pytest

from relieffab.errors import InputError
from relieffab.grbl.program import prepare
from relieffab.grbl.record import Record
from relieffab.grbl.resume import approach, entry, zero_lost
from relieffab.grbl.tracker import Tracker

PROGRAM = """(head)
G20 G17 G90
M3 S8000
M8
G0 Z0.5
G0 X1 Y1
G1 Z-0.1 F5
G91
G18
G1 X0.1 F20
X0.1
X0.1
G90
G0 Z0.5
"""


def modal_after(lines):
    tracker = Tracker((3.0, 4.0, 2.0))
    for line in lines:
        tracker.follow(line)
    return tracker


@pytest.mark.parametrize("number", range(7, 15))
def test_what_is_in_force_in_front_of_a_line_is_rebuilt(number):
    """State and position after the approach equal those of the program run from its start."""
    program = prepare(PROGRAM)
    point = entry(program, number=number)
    whole = Tracker()
    for line in program.read():
        if line.number >= number:
            break
        whole.follow(line.text)
    rebuilt = modal_after(approach(point, 2.0))
    assert rebuilt.modal == whole.modal
    assert rebuilt.position == pytest.approx(whole.position, abs=1e-3)


def test_up_across_spindle_then_slowly_down():
    lines = approach(entry(prepare(PROGRAM), number=11), 2.0)
    assert lines[:7] == [
        "G17G21G90G94", "G0Z12.7000", "G0X27.9400Y25.4000", "M3S8000", "G4P5", "M8",
        "G1Z-2.5400F127",
    ]  # fmt: skip


def test_a_tool_already_higher_stays_there_until_it_is_across():
    lines = approach(entry(prepare(PROGRAM), number=11), 40.0)
    assert [line for line in lines if "Z" in line] == [
        "G0Z40.0000", "G0Z12.7000", "G1Z-2.5400F127",
    ]  # fmt: skip


TURNING = """G21G90G17G94G54
G93
G0Z5
M3S9000
G0X10A-30
G1Z-1F200
X12A-33.5F150
A-40Z-1.5F90
G0Z5
M5
G94
M30
"""


def test_work_that_turns_is_brought_round_before_anything_goes_down():
    point = entry(prepare(TURNING), number=8)
    assert approach(point, 2.0) == [
        "G17G21G90G94", "G0Z5.0000", "G0A-33.5000", "G0X12.0000", "M3S9000", "G4P5",
        f"G1Z-1.0000F{90 * math.hypot(6.5, 0.5):g}", "G17G21G90", "G1", "G93",
    ]  # fmt: skip


def test_the_turning_is_known_before_work_that_turns_is_taken_up():
    assert entry(prepare(TURNING), number=6).position == (10.0, None, 5.0, -30.0)
    with pytest.raises(InputError, match="no position"):
        entry(prepare(TURNING), number=5)


def test_above_the_stock_there_is_no_plunge():
    lines = approach(entry(prepare(PROGRAM), number=7), 2.0)
    assert not any(line.startswith("G1Z") for line in lines)


def test_a_line_number_means_the_next_line_that_is_sent():
    assert entry(prepare("G0X0Y0Z5\n(a)\n\nG0X1\nG0X2"), number=2).number == 4
    assert entry(prepare("G0X0Y0Z5\nG0X1\nG0X2"), index=2).number == 3


@pytest.mark.parametrize(
    ("text", "number", "why"),
    [
        ("G0X0Y0Z5\nG0X1", 9, "no such line"),
        ("G0X0Y0Z5\nG55\nG0X1", 3, "cannot be rebuilt"),
        ("G0X0Z5\nG0X1", 2, "no position"),
        ("G0X0Y0Z-1\nG1X1F9", 2, "never goes above"),
    ],
)
def test_where_a_job_cannot_be_taken_up(text, number, why):
    with pytest.raises(InputError, match=why):
        entry(prepare(text), number=number)


RECORD = Record("ab", 9, (1.0, 2.0, 3.0), (-9.0, 0.0, 0.0), True, "cancelled")


def test_the_zero_is_believed_only_where_the_machine_stands_as_it_stopped():
    assert zero_lost(RECORD, (1.0, 2.0, 3.001), (-9.0, 0.0, 0.0)) == ""


@pytest.mark.parametrize(
    ("record", "position", "zero", "why"),
    [
        (None, (1, 2, 3), (-9, 0, 0), "no record"),
        (replace(RECORD, position_kept=False), (1, 2, 3), (-9, 0, 0), "lost its position"),
        (RECORD, (0, 0, 0), (-9, 0, 0), "does not stand"),
        (RECORD, (1, 2, 3), (0, 0, 0), "work zero"),
        (RECORD, None, (-9, 0, 0), "lost"),
        (RECORD, (1, 2, 3, 4), (-9, 0, 0), "does not stand"),
        (RECORD, (1, 2, 3, 4), (-9, 0, 0, 0), "work zero"),
    ],
)
def test_why_a_zero_is_not_believed(record, position, zero, why):
    assert why in zero_lost(record, position, zero)


def test_a_feed_never_named_is_slow_and_not_nothing():
    point = replace(entry(prepare("G0X0Y0Z5\nG0Z-1\nG0X1"), number=3), plunge=math.inf)
    assert "G1Z-1.0000F60" in approach(point, 9.0)
