import pytest

from relieffab.grbl.controller import Controller
from relieffab.grbl.messages import Note, Setting
from relieffab.grbl.program import prepare
from relieffab.grbl.review import misfits, review


def controller(version="1.1h", zero=(0.0, 0.0, 0.0), **settings):
    known = Controller(version)
    for number, value in {"130": 100, "131": 80, "132": 30, **settings}.items():
        known.learn(Setting(int(number.strip("_")), float(value)))
    known.offsets["G54"] = zero
    return known


def test_without_homing_only_the_extent_is_compared():
    program = prepare("G0X0Y0Z0\nG1X90Y81Z-5")
    assert misfits(program, controller()) == ["Y spans 81.000 mm of 80.000 mm of travel"]
    assert misfits(program, Controller("1.1h")) == []


@pytest.mark.parametrize("setting", ["_20", "_22"])
def test_a_machine_that_knows_its_zero_has_the_place_compared_too(setting):
    program, known = prepare("G0X0Y0Z0\nG1X90Y70Z-5"), {setting: 1}
    assert misfits(program, controller(zero=(-95, -75, -10), **known)) == []
    found = misfits(program, controller(zero=(-85, -75, -26), **known))
    assert [text[0] for text in found] == ["X", "Z"]


def test_only_soft_limits_refuse_and_only_where_the_bounds_are_certain():
    program = prepare("G0X0Y0Z0\nG1X90Y70Z-5")
    assert review(program, controller(_20=1)).refusals
    assert not review(program, controller(_22=1)).refusals
    assert review(program, controller(_22=1)).notes
    assert not review(prepare("G0X0Y0Z0\nG28\nG1X90"), controller(_20=1)).refusals
    lifted = controller(_20=1)
    cleared = prepare("G49G40\nG0X0Y0Z0\nG1X90Y70Z-5")
    assert review(cleared, lifted).refusals
    lifted.learn(Note("TLO", "-40.000"))
    assert not review(cleared, lifted).refusals


@pytest.mark.parametrize(
    ("known", "word"), [(controller("0.9j"), "0.9j"), (controller(_32=1), "laser")]
)
def test_what_cannot_carve_is_refused(known, word):
    assert word in review(prepare("G0X1"), known).refusals[0]


def test_codes_grbl_does_not_know_are_named_with_their_line():
    program = prepare("N5G0X1T1\nM6T1\nG43Z1\nM7\nM7\nG1X2A3F60")
    found = review(program, controller()).refusals
    assert [text.split(" is")[0] for text in found] == [
        "line 2: M6", "line 3: G43", "line 4: M7", "line 6: A"
    ]  # fmt: skip
    mist = controller()
    mist.options = "VM"
    assert len(review(program, mist).refusals) == 3
    hal = controller()
    hal.hal = True
    assert [text.split(" is")[0] for text in review(program, hal).refusals] == ["line 6: A"]


def test_a_spindle_asked_for_too_much_is_noted():
    program = prepare("M3S12000\nG0X1")
    assert "S12000" in review(program, controller(_30=1000)).notes[0]
    assert review(program, controller(_30=24000)).notes == ()


def test_a_zero_never_set_is_noted_on_a_homed_machine():
    assert "work zero" in review(prepare("G0X-1"), controller(_22=1)).notes[0]


def test_a_rotary_axis_is_for_controllers_that_have_one():
    program = prepare("G21G90G93\nG0Z5\nX0A0\nG1X1A5F60\nG0Z5\nM30")
    assert [text[:14] for text in review(program, controller()).refusals] == ["line 3: A is e"]
    hal = controller(_22=1, _133=360)
    hal.hal = True
    assert [text[:14] for text in review(program, hal).refusals] == ["line 3: A is e"]
    hal.offsets["G54"] = (0.0, 0.0, -9.0, 0.0)
    found = review(program, hal)
    assert found.refusals == ()
    assert "never moves Y" in found.notes[-1]
    assert "A goes from 0.000 to 5.000 degrees in machine coordinates" in found.notes[1]
    # Where A has no end there is nothing to leave.
    hal.settings[133] = 0
    assert len(review(program, hal).notes) == 2
