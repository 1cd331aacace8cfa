import pytest

from relieffab.errors import InputError
from relieffab.grbl import program as module
from relieffab.grbl.program import PIECE, commands, prepare


def lines_of(program):
    return [line.wire for line in program.read()]


def test_comments_blanks_and_white_space_stay_behind():
    program = prepare("%\n(a job; really)\n\n g1 x1 (across)y2 ; back\r\nM5\n%\n")
    assert lines_of(program) == [b"G1X1Y2\n", b"M5\n"]
    assert [line.number for line in program.read()] == [4, 5]
    assert program.line(1).where == "line 5: M5"


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
        ("$J=X1", "$ commands"),
        ("$110=!", "$ commands"),
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
    assert len(prepare(fits).line(0).wire) == 80
    assert len(prepare(" ".join(fits)).line(0).wire) == 80
    with pytest.raises(InputError, match="80"):
        prepare(fits + "1")


@pytest.mark.parametrize("source", ["", "\n\n", "%\n(nothing)\n"])
def test_an_empty_program_is_refused(source):
    with pytest.raises(InputError, match="empty"):
        prepare(source)


def test_what_is_known_of_the_whole():
    program = prepare("G0X0Y0Z0\nM3S900\nG1X3F60\nG0Z5\nG1Y4\nZ1F50\nG4P2")
    assert program.cut_mm == 3 + 4 + 4
    assert program.bounds == ((0, 0, 0), (3, 4, 5))
    assert (program.speed, program.plunge, program.dwell_s) == (900, 50, 2)
    assert not program.quiet
    assert prepare("M3S1\nM5").quiet


def test_the_pieces_of_the_way_name_their_line():
    program = prepare("G0X0Y0Z0\nG1X3F60\nG4P2\nG0Z5")
    pieces = [PIECE.unpack_from(data, at) for data in program.pieces()
              for at in range(0, len(data), PIECE.size)]  # fmt: skip
    assert pieces[1:] == [
        (1, 3, 0, 0, 0, 60), (2, 0, 0, 0, 0, -2), (3, 0, 0, 5, 0, float("inf")),
    ]  # fmt: skip


def test_comments_do_not_change_the_digest_but_lines_do():
    assert prepare("g1 x1 (a)").digest == prepare("G1X1\n;b").digest
    assert prepare("G1X1").digest != prepare("G1X2").digest


def test_long_programs_are_read_in_blocks_by_several_readers(monkeypatch):
    monkeypatch.setattr(module, "BLOCK", 7)
    program = prepare(f"X{i}" for i in range(200))
    pairs = list(zip(program.read(), program.read(), strict=True))
    assert [a.wire for a, _ in pairs] == [b"X%d\n" % i for i in range(200)]
    assert [a for a, _ in pairs] == [b for _, b in pairs]
    assert pairs[-1][0].index == 199


def test_lines_of_our_own_may_be_commands():
    assert lines_of(commands("$C")) == [b"$C\n"]


def test_pauses_are_listed():
    assert prepare("G0X0\nM0\nM00\nM03S10\nM30").pauses == [2, 3]
