import pytest

from relieffab.grbl.controller import Controller
from relieffab.grbl.messages import Note, Setting


def controller(*notes, **settings):
    known = Controller("1.1h")
    for number, value in {"130": 100, "131": 80, "132": 30, **settings}.items():
        known.learn(Setting(int(number.strip("_")), float(value)))
    for note in notes:
        known.learn(note)
    return known


def test_the_buffer_comes_from_the_controller():
    assert Controller("1.1h").buffer == 128
    assert controller(Note("OPT", "VNMGPH,100,1024,3,0")).buffer == 1024
    assert controller(Note("OPT", "VNMGPH,100,1024,3,0")).blocks == 100
    assert controller(Note("OPT", "V")).buffer == 128
    assert controller(Note("OPT", "V,15,12")).buffer == 128
    assert controller(Note("OPT", "V,15,x28")).buffer == 128


def test_a_smaller_buffer_seen_in_a_report_is_believed():
    known = controller(Note("OPT", "V,15,928"))
    known.limit_buffer(0)
    assert known.buffer == 928
    known.limit_buffer(128)
    known.limit_buffer(1024)
    assert known.buffer == 128


def test_the_version_comes_from_the_build_where_no_banner_was_seen():
    known = Controller()
    known.learn(Note("VER", "1.1h.20190825:my machine"))
    assert known.version == "1.1h"


def test_a_damaged_answer_says_nothing():
    known = controller(Note("G54", "1.000,0\ufffd000,3.000"), Note("TLO", "x"), Note("G92", "1,2"))
    assert known.work_zero == (0.0, 0.0, 0.0)


GC = Note("GC", "G0 G55 G17 G21 G90 G94 M5 M9 T0 F0 S0")


def test_work_zero_is_the_sum_of_the_offsets_in_force():
    known = controller(
        GC,
        Note("G55", "1.000,2.000,3.000"),
        Note("G92", "0.500,0.000,0.000"),
        Note("TLO", "-4.000"),
    )
    assert known.system == "G55"
    assert known.work_zero == (1.5, 2.0, -1.0)


@pytest.mark.parametrize(
    ("codes", "note", "moves"),
    [
        ({"G49"}, Note("TLO", "-4.000"), True),
        ({"G49"}, Note("TLO", "0.000"), False),
        ({"G92.1"}, Note("TLO", "-4.000"), False),
        ({"G92.1"}, Note("G92", "0.000,0.000,2.000"), True),
        ({"G1"}, Note("G92", "0.000,0.000,2.000"), False),
    ],
)
def test_clearing_an_offset_moves_work_zero_where_one_is_in_force(codes, note, moves):
    assert controller(note).cleared_by(codes) is moves


def test_offsets_in_inches_are_millimetres_inside():
    assert controller(Note("G54", "1.000,0.000,-2.000"), _13=1).work_zero == (25.4, 0, -50.8)


@pytest.mark.parametrize(
    ("options", "mask", "low", "high"),
    [("V", 3, (-100, -80, -30), (0, 0, 0)), ("VZ", 3, (0, 0, -30), (100, 80, 0))],
)
def test_the_room_depends_on_where_the_machine_homes(options, mask, low, high):
    assert controller(Note("OPT", f"{options},15,128"), _23=mask).room == (low, high)


def test_limits_are_what_the_settings_say():
    known = controller(_110=900, _111=800, _112=700, _120=30, _121=20, _122=10, _11=0.02)
    assert known.limits.max_rate == (900, 800, 700)
    assert known.limits.acceleration == (30, 20, 10)
    assert known.limits.junction == 0.02


def test_a_fourth_axis_counts_in_all_that_it_says():
    known = controller(
        Note("G54", "1.000,2.000,3.000,45.000"), Note("TLO", "0.500"), _133=0,
        **{f"_{100 + k}": 800 for k in range(3)}, _103=20,
        **{f"_{110 + k}": 1000 + k for k in range(4)},
    )  # fmt: skip
    assert known.axes == 4
    assert known.work_zero == (1.0, 2.0, 3.5, 45.0)
    assert known.travel == (100.0, 80.0, 30.0, 0.0)
    assert known.resolution == 1 / 20
    assert known.limits.max_rate == (1000.0, 1001.0, 1002.0, 1003.0)
    known.learn(Setting(13, 1.0))
    assert known.work_zero == pytest.approx((25.4, 50.8, 88.9, 45.0))
