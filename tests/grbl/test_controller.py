from relieffab.grbl.controller import Controller, misfits
from relieffab.grbl.messages import Note, Setting
from relieffab.grbl.program import prepare


def controller(*notes, soft=False, zero=(0, 0, 0)):
    known = Controller("1.1h")
    for number, value in {130: 100, 131: 80, 132: 30, 20: int(soft)}.items():
        known.learn(Setting(number, float(value)))
    known.offsets["G54"] = zero
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


def test_a_damaged_answer_says_nothing():
    known = controller(Note("G54", "1.000,0\ufffd000,3.000"), Note("TLO", "x"), Note("G92", "1,2"))
    assert known.work_zero == (0.0, 0.0, 0.0)


def test_work_zero_is_the_sum_of_the_offsets_in_force():
    known = controller(
        Note("GC", "G0 G55 G17 G21 G90 G94 M5 M9 T0 F0 S0"),
        Note("G55", "1.000,2.000,3.000"),
        Note("G92", "0.500,0.000,0.000"),
        Note("TLO", "-4.000"),
    )
    assert known.work_zero == (1.5, 2.0, -1.0)


def test_without_soft_limits_only_the_extent_is_compared():
    program = prepare("G0X0Y0Z0\nG1X90Y81Z-5")
    assert misfits(program, controller()) == ["Y spans 81.000 mm of 80.000 mm of travel"]
    assert misfits(program, Controller("1.1h")) == []


def test_with_soft_limits_the_place_is_compared_too():
    program = prepare("G0X0Y0Z0\nG1X90Y70Z-5")
    assert misfits(program, controller(soft=True, zero=(-95, -75, -10))) == []
    found = misfits(program, controller(soft=True, zero=(-85, -75, -26)))
    assert [text[0] for text in found] == ["X", "Z"]
