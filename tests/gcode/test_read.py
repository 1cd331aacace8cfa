"""The interpreter: what Grbl runs is run, what Grbl refuses is refused."""

import numpy as np
import pytest

from relieffab.errors import InputError
from relieffab.gcode.dialect import DIALECTS, GRBL
from relieffab.gcode.read import read_program

HEAD = "G21 G90 G17\nG0 Z5\nX0 Y0\nM3 S500\n"
END = "\nM30\n"


def run(body):
    return read_program(HEAD + body + END, name="job.nc")


def test_modal_words_carry_over():
    program = run("G1 Z-1 F100\nX10\nY10 F200\nG0 Z5\nX0")
    assert program.points.tolist() == [
        [0, 0, 5], [0, 0, -1], [10, 0, -1], [10, 10, -1], [10, 10, 5], [0, 10, 5],
    ]  # fmt: skip
    assert program.feed.tolist() == [np.inf, 100, 100, 200, np.inf, np.inf]
    assert program.line.tolist() == [3, 5, 6, 7, 8, 9]
    assert program.line_count == 10
    assert program.bounds.tolist() == [[0, 0, -1], [10, 10, 5]]
    assert program.cutting_length == 26


def test_blanks_comments_numbers_and_lower_case():
    plain = run("G1X1.5Y-2Z-1F100\nX3\nG0Z5")
    dressed = run("n10 g1 x 1.5 (a (b) y-2 z-1 f100 ; end\n\n X 3.\n(only this)\nN30G0Z+5 ; up")
    assert np.array_equal(plain.points, dressed.points)
    assert np.array_equal(plain.feed, dressed.feed)


def test_the_short_way_and_the_long_way_agree():
    rng = np.random.default_rng(7)
    lines = [f"X{x:.3f}Y{y:.3f}Z{-z:.3f}F{f:.1f}" for x, y, z, f in rng.uniform(1, 9, (200, 4))]
    lines[50], lines[90] = "G0Z5", "G1Z-.5"
    short, long = run("G1F100\n" + "\n".join(lines)), run("G1F100\n" + " \n ".join(lines) + " ")
    for name in ("points", "feed", "line", "spindle", "dwell"):
        assert np.array_equal(getattr(short, name), getattr(long, name))


def test_inches_and_relative_moves():
    program = run("G20 G91 G1 X1 F10\nX1 Y-1\nG21 G90 X0")
    assert program.points[1:].tolist() == [[25.4, 0, 5], [50.8, -25.4, 5], [0, -25.4, 5]]
    assert program.feed[1:].tolist() == [254, 254, 254]


@pytest.mark.parametrize(
    ("line", "centre", "turn"),
    [
        ("G2 X2 Y0 I1 J0", (1, 0), -np.pi),
        ("G3 X2 Y0 I1", (1, 0), np.pi),
        ("G3 X1 Y1 R1", (0, 1), np.pi / 2),
        ("G2 X1 Y1 R1", (1, 0), -np.pi / 2),
        ("G2 X1 Y1 R-1", (0, 1), -3 * np.pi / 2),
        ("G3 X1 Y1 R-1", (1, 0), 3 * np.pi / 2),
        ("G2 X0 Y0 I1", (1, 0), -2 * np.pi),
    ],
)
def test_arcs(line, centre, turn):
    points = run("G1 Z-1 F100\n" + line + " Z-2").points[1:]
    radius = np.hypot(*(points[:, :2] - centre).T)
    assert np.allclose(radius, 1, atol=1e-9)
    angle = np.unwrap(np.arctan2(points[:, 1] - centre[1], points[:, 0] - centre[0]))
    assert angle[-1] - angle[0] == pytest.approx(turn, abs=1e-9)
    # A helix descends evenly, and its chords stay within half a micrometre.
    assert np.allclose(points[:, 2], -1 - (angle - angle[0]) / turn, atol=1e-9)
    assert (1 - np.cos(np.diff(angle) / 2)).max() <= 0.0005 + 1e-12


def test_the_spindle_and_dwells():
    program = run("G4 P2\nG1 Z-1 F100\nM5\nG4 P.5\nG4 P1\nX1\nM4 S700\nX2\nG4P3")
    assert program.spindle.tolist() == [0, 500, 0, 700]
    assert program.dwell.tolist() == [0, 2, 1.5, 0, 3]


def test_the_height_must_be_known_before_moving_sideways():
    assert run("").blind_line == 0
    program = read_program("G21 G90\nG0 X0 Y0\nX5\nZ5\nM30")
    assert program.blind_line == 2
    assert program.points.tolist() == [[5, 0, 5]]


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("G1 X1", 22),
        ("G1 X1 F0", 22),
        ("G1 X1 X2 F100", 25),
        ("G1 X F100", 2),
        ("G1 XNAN F100", 2),
        ("G1 X1e3 F100", 20),
        ("G1 X--1 F100", 2),
        ("12 X1", 1),
        ("%", 1),
        ("G1 X1 F-5", 4),
        ("G1 X1 A2 F100", 20),
        ("G1 X1 H2 F100", 20),
        ("G43 H1", 20),
        ("G5 X1", 20),
        ("M6 T1", 20),
        ("M7", 20),
        ("G0 G1 X1 F100", 21),
        ("G20 G21", 21),
        ("M3.5", 23),
        ("N99999999 X1", 27),
        ("G4", 28),
        ("G80\nX1", 31),
        ("G2 F100", 26),
        ("G2 Z1 I1 F100", 32),
        ("G2 X2 I3 F100", 33),
        ("G2 X0 Y0 R1 F100", 33),
        ("G2 X9 R1 F100", 34),
        ("G2 X2 F100", 35),
        ("G1 X2 I1 F100", 36),
        ("G1 X2 P1 F100", 36),
        ("I1", 36),
        ("X1." + "0" * 78, 11),
    ],
)
def test_what_grbl_refuses_is_refused_in_its_words(body, code):
    with pytest.raises(InputError, match=rf"Grbl error {code}: [^$]*job.nc line [56]"):
        run(body)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HEAD + "X1", "no end"),
        (HEAD + "M30\nX1", "after the program's end"),
        ("G90\nG0 X1\nM30", "how"),
        ("G21\nG0 X1\nM30", "how"),
        ("G21 G90\nX1\nM30", "how"),
        ("G21 G90\nG0 Z1\nG1 X1 F100\nM30", "a place not known"),
        ("G21 G91\nG0 Z1\nM30", "a place not known"),
        ("G21 G90\nG0 Z1\nG2 X1 I1 F100\nM30", "a place not known"),
        (HEAD + "G92 X0" + END, "not followed"),
        (HEAD + "G53 G0 X0" + END, "not followed"),
        (HEAD + "G18" + END, "not followed"),
        (HEAD + "$H" + END, "system command"),
        (HEAD + "/X1" + END, "left out"),
        (HEAD + "(stop!)" + END, "act on"),
        (HEAD + "(S\u00e4ge)" + END, "act on"),
        (HEAD + "X1\x18" + END, "act on"),
        ("M30", "moves nothing"),
        ("", "no end"),
    ],
)
def test_what_is_no_program(text, words):
    with pytest.raises(InputError, match=words):
        read_program(text)


def test_a_line_is_named_by_its_number():
    with pytest.raises(InputError, match=r"job\.nc line 7"):
        run("G1 F100 X1\nX2\nQ1")
    with pytest.raises(InputError, match=r"job\.nc line 6"):
        run("X1\nX2 (!)")


TURNING = "G21 G90 G17 G54\nG93\nG0 Z5\nX0 A0\n{}\nM30\n"
HAL, RADIUS = DIALECTS["grblhal"], 90 / np.pi  # half a degree is a quarter of a mm


def turned(body, dialect=HAL, radius=RADIUS):
    return read_program(TURNING.format(body), dialect=dialect, radius=radius)


def test_a_rotary_axis_goes_round_the_face_and_f_counts_moves():
    read = turned("G1 Z-1 F100\nX3 A-8 F60\nA-8.5F1\nG0Z5")
    np.testing.assert_allclose(read.points[1:, 1], [0, 4, 4.25, 4.25])
    # 6 mm a hundred times a minute, 5 mm once a second, a quarter of a mm in a minute.
    np.testing.assert_allclose(read.feed[1:], [600, 300, 0.25, np.inf])
    same = turned("g1 z-1 f100\n x3 a-8 f60\n a-8.5 f1\n g0 z5")
    np.testing.assert_array_equal(same.points, read.points)
    np.testing.assert_array_equal(same.feed, read.feed)


def test_steps_of_a_rotary_axis_add_up():
    read = turned("G91\nG1 A-2 F10\nA-2 F10")
    np.testing.assert_allclose(read.points[1:, 1], [1, 2])


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("G1 X1 F60\nX2", "without its own F"),
        ("G1 X1 Y2 F60", "unsupported"),
        ("G2 X1 A2 I1 F60", "is not followed"),
        ("G94\nG1 X1", "without a feed"),
    ],
)
def test_what_turns_the_work_in_no_known_way(body, words):
    with pytest.raises(InputError, match=words):
        turned(body)


def test_where_nothing_turns_a_is_not_known():
    with pytest.raises(InputError, match="unsupported"):
        turned("G1 A1 F60", radius=0.0)
    with pytest.raises(InputError, match="is not followed here"):
        turned("G1 X1 F60", dialect=GRBL)
