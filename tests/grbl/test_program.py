import pytest

from relieffab.errors import InputError
from relieffab.grbl.program import clean, dwell_seconds, prepare, stands_alone


def lines_of(program):
    return [program.line(i) for i in range(len(program))]


def test_comments_blanks_and_white_space_stay_behind():
    program = prepare("%\n(a job; really)\n\n g1 x1 (across)y2 ; back\r\nM5\n%\n")
    assert lines_of(program) == [b"G1X1Y2\n", b"M5\n"]
    assert list(program.numbers) == [4, 5]
    assert program.where(1) == "line 5: M5"


def test_lines_may_come_from_anywhere():
    for source in ("G0X1\nM5", ["G0X1", "M5\n"], iter(["G0X1\n", "M5"]), ["G0X1\rM5"]):
        assert lines_of(prepare(source)) == [b"G0X1\n", b"M5\n"]


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("G1X1!", "not G-code"),
        ("G1X1?", "not G-code"),
        ("G1X1~", "not G-code"),
        ("G1X1\x18", "not G-code"),
        ("G1X\u00c4", "not G-code"),
        ("G1X1\u20132", "not G-code"),
        ("G1X1) back", "not G-code"),
        ("X1.2.3", "not G-code"),
        ("G1X", "not G-code"),
        ("$H", "$ commands"),
        ("G1X0." + "1" * 75, "too long"),
    ],
)
def test_what_must_not_reach_the_wire_is_refused_with_its_line(line, why):
    with pytest.raises(InputError, match="line 2") as caught:
        prepare(["G21", line])
    assert why in str(caught.value)


def test_in_a_comment_anything_goes_because_it_stays_behind():
    assert lines_of(prepare("G1X1(\u00c4!?~) ; \u2013")) == [b"G1X1\n"]


@pytest.mark.parametrize("odd", ["\x85", "\x0c", "\x1e", "\u2028"])
def test_no_character_of_a_comment_ends_its_line(odd):
    assert lines_of(prepare(f"G0X1 ; {odd} G1X5\nM5")) == [b"G0X1\n", b"M5\n"]


def test_79_characters_fit_and_80_do_not():
    fits = "G1X0." + "1" * 74
    assert len(prepare(fits).line(0)) == 80
    assert len(prepare(" ".join(fits)).line(0)) == 80
    with pytest.raises(InputError, match="80"):
        prepare(fits + "1")


@pytest.mark.parametrize("source", ["", "\n\n", "%\n(nothing)\n"])
def test_an_empty_program_is_refused(source):
    with pytest.raises(InputError, match="empty"):
        prepare(source)


def test_cut_is_cumulative():
    program = prepare("G0X0Y0Z0\nG1X3\nG0Z5\nG1Y4")
    assert list(program.cut) == [0, 3, 3, 7]
    assert program.cut_mm == 7


def test_pauses_are_listed():
    assert prepare("G0X0\nM0\nM00\nM03S10\nM30").pauses == (2, 3)


@pytest.mark.parametrize(
    ("line", "alone"),
    [("G10L2P1X0", True), ("G28.1", True), ("G30.10", True), ("G90G10L20P1Z0", True),
     ("G28", False), ("G1X10", False), ("G100", False), ("X28.1", False)],
)  # fmt: skip
def test_lines_that_write_the_eeprom_stand_alone(line, alone):
    assert stands_alone(line) is alone


@pytest.mark.parametrize(
    ("line", "seconds"), [("G4P2.5", 2.5), ("P1G04", 1.0), ("G1X1", 0.0), ("G43.1Z1", 0.0)]
)
def test_dwell(line, seconds):
    assert dwell_seconds(line) == seconds


def test_special_lines_are_found_by_index():
    program = prepare("G0X0\nG10L2P1X0\n(c)\nG4P1.5\nG28.1")
    assert program.alone == {1, 3}
    assert program.dwells == {2: 1.5}


def test_clean_keeps_what_it_does_not_know():
    assert clean("(open") == ""
    assert clean("a / b") == "A/B"
