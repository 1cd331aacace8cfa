import math

import pytest

from relieffab.grbl.simulator.interpreter import Interpreter, Move, Wait
from relieffab.grbl.simulator.settings import Settings
from relieffab.grbl.simulator.words import Refused


@pytest.fixture
def run():
    interpreter = Interpreter(Settings())

    def lines(*text):
        return [action for line in text for action in interpreter.run(line)]

    lines.interpreter = interpreter
    return lines


def test_modal_motion_units_and_distance(run):
    assert run("G21G90G0X10", "G1Y2F600", "G91X1", "G90G20G1X1F10") == [
        Move((10.0, 0.0, 0.0), math.inf),
        Move((10.0, 2.0, 0.0), 10.0),
        Move((11.0, 2.0, 0.0), 10.0),
        Move((25.4, 2.0, 0.0), 254 / 60),
    ]


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("1", 1), ("G", 2), ("GX1", 2), ("G1X1", 22), ("G1X1F-1", 4), ("M3.5", 23), ("G5", 20),
        ("M6", 20), ("M7", 20), ("G43Z1", 20), ("G0G1X1", 21), ("G0X1X2", 25), ("G4", 28),
        ("G10L2P1", 26), ("G10X1", 28), ("G10L2P9X1", 29), ("G53G2X1I1F9", 30), ("G92", 26),
        ("G80X1", 31), ("G2I1F100", 32), ("G2X1F100", 35), ("G2X1I9F100", 33), ("G2X9R1F100", 34),
        ("G0X1I1", 36), ("P1", 36), ("G43.1X1", 37), ("G28G1X1F100", 24), ("N99999999G0X1", 27),
        ("A1", 20), ("G93G1X1", 22), ("G41", 20),
    ],
)  # fmt: skip
def test_every_refusal_has_grbls_own_number(run, line, code):
    with pytest.raises(Refused) as caught:
        run(line)
    assert caught.value.code == code


def test_a_refused_line_changes_nothing(run):
    run("G0X5")
    before = dict(run.interpreter.modal)
    with pytest.raises(Refused):
        run("G20G91G55G92X0P1")
    assert run.interpreter.modal == before
    assert run("G0X6") == [Move((6.0, 0.0, 0.0), math.inf)]


def test_offsets_add_up(run):
    moves = run("G10L2P1X10", "G92X0", "G43.1Z2", "G0X5Z0")
    assert moves == [Wait("eeprom"), Move((5.0, 0.0, 2.0), math.inf)]
    assert run("G53G0X-1") == [Move((-1.0, 0.0, 2.0), math.inf)]


def test_g10_l20_makes_the_position_the_given_coordinates(run):
    run("G0X7Y8", "G10L20P1X0Y0")
    assert run("G0X1Y1") == [Move((8.0, 9.0, 0.0), math.inf)]


def test_g28_goes_by_way_of_the_named_axes(run):
    run("G0X5Y5Z5", "G28.1", "G0X0Y0Z0")
    assert run("G28Z9") == [Move((0.0, 0.0, 9.0), math.inf), Move((0.0, 0.0, 5.0), math.inf)]
    assert run("G28") == [Move((5.0, 5.0, 5.0), math.inf)]


def test_inverse_time_feed(run):
    assert run("G93G1X30F2") == [Move((30.0, 0.0, 0.0), 1.0)]


def test_order_on_one_line(run):
    assert run("G1X1F60S900M3M8") == [
        Wait("spindle", 900.0), Wait("coolant", 8), Move((1.0, 0.0, 0.0), 1.0),
    ]  # fmt: skip
    assert run("S1000") == [Wait("spindle", 1000.0)]
    assert run("G4P0.5") == [Wait("dwell", 0.5)]
    assert run("M0") == [Wait("pause")]


def test_m30_resets_some_modes_and_keeps_the_units(run):
    run("G20G91G18G55G93M3S1")
    assert run("M30") == [Wait("end")]
    modal = run.interpreter.modal
    assert {group: modal[group] for group in (1, 2, 3, 5, 6, 12)} == {
        1: 1, 2: 17, 3: 90, 5: 94, 6: 20, 12: 54,
    }  # fmt: skip


@pytest.mark.parametrize(("plane", "line"), [("G17", "G3X-10I-10"), ("G18", "G3Z-10K-10")])
def test_half_circles_bulge_where_the_plane_says(run, plane, line):
    run("G0X10" if plane == "G17" else "G0Z10", plane, "F100")
    middle = run(line)
    top = max(move.target[1 if plane == "G17" else 0] for move in middle)
    assert top == pytest.approx(10, abs=0.01)
