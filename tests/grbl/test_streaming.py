import pytest

from relieffab.grbl.course import Course
from relieffab.grbl.feed import Feed
from relieffab.grbl.messages import parse
from relieffab.grbl.program import commands, prepare
from relieffab.grbl.stage import Fault, Patience
from relieffab.grbl.streaming import Streaming

IDLE = "<Idle|MPos:0.000,0.000,0.000|FS:0,0>"
RUN = "<Run|MPos:0.000,0.000,0.000|FS:100,0>"


def stream(text, buffer=128, first=0, **options):
    program = text if not isinstance(text, str) else prepare(text)
    feed = Feed(program, (0.0, 0.0, 0.0), first)
    return Streaming(feed, Course(15, (0.0, 0.0, 0.0)), buffer, Patience(), 0.0, **options)


def take(streaming, *lines, now=0.0):
    for line in lines:
        streaming.take(parse(line), now)


def test_the_buffer_is_filled_and_no_further():
    streaming = stream("G1X10\n" * 30, buffer=20)
    assert streaming.give(0.0) == b"G1X10\n" * 3
    assert streaming.give(0.1) == b""
    take(streaming, "ok")
    assert streaming.give(0.1) == b"G1X10\n"


def test_lines_before_the_first_are_not_sent():
    streaming = stream("G0X1\nG0X2\nG0X3", first=1)
    assert streaming.acknowledged == 1
    assert streaming.give(0.0) == b"G0X2\nG0X3\n"


def test_done_is_acknowledged_and_idle_twice():
    streaming = stream("G1X0\nM5")
    streaming.give(0.0)
    take(streaming, IDLE, IDLE, "ok", "ok")
    assert not streaming.over
    take(streaming, IDLE, RUN)
    assert not streaming.over
    take(streaming, IDLE)
    assert streaming.over
    assert streaming.failure is None


def test_status_is_asked_for_five_times_a_second_at_most():
    streaming = stream("G4P9")
    asked = sum(streaming.give(0.01 * i).count(b"?") for i in range(200))
    assert 9 <= asked <= 10


def test_an_eeprom_line_goes_alone():
    streaming = stream("G0X1\nG10L2P1X0\nG0X2\nG0X3")
    assert streaming.give(0.0) == b"G0X1\n"
    take(streaming, "ok", IDLE, IDLE)
    assert streaming.give(0.0) == b"G10L2P1X0\n"
    assert streaming.give(0.5) == b""
    take(streaming, "ok")
    assert streaming.give(0.5) == b"G0X2\nG0X3\n?"


@pytest.mark.parametrize("line", ["$110=900", "G10L2P1X0", "G28.1"])
def test_what_is_stored_waits_for_a_machine_at_rest(line):
    streaming = stream(f"G0X0\n{line}\nG0X3")
    assert streaming.give(0.0) == b"G0X0\n"
    take(streaming, "ok", RUN, IDLE)
    assert streaming.give(0.0) == b""
    take(streaming, IDLE)
    assert streaming.give(0.0) == f"{line}\n".encode()


def test_an_error_names_its_own_line_not_the_last_one_sent():
    streaming = stream("(a)\nG0X1\nG1X2\nG0X3\nG0X4")
    streaming.give(0.0)
    take(streaming, "ok", "error:22")
    failure = streaming.failure
    assert (failure.fault, failure.where) == (Fault.REFUSED, "line 3: G1X2")
    assert "no feed rate" in failure.found
    assert "next 2 lines" in failure.hint
    assert streaming.give(0.0) == b""


def test_a_refused_line_is_the_last_that_counts_as_reached():
    course = Course(15, (0.0, 0.0, 0.0))
    feed = Feed(prepare("G0X1\nG1X2\nG0X3\nG0X4"), (0.0, 0.0, 0.0))
    streaming = Streaming(feed, course, 128, Patience(), 0.0)
    streaming.give(0.0)
    take(streaming, "ok", "error:22")
    course.report(parse("<Run|MPos:3.500,0.000,0.000|FS:100,0>"))
    assert course.reached.number == 2


def test_in_check_mode_errors_are_gathered():
    streaming = stream("G0X1\nG1X2\nG0X3", checking=True)
    streaming.give(0.0)
    take(streaming, "ok", "error:22", "ok", *["<Check|MPos:9.000,0.000,0.000|FS:0,0>"] * 2)
    assert streaming.over
    assert streaming.failure is None
    assert streaming.errors == ["line 2: G1X2: error:22, no feed rate (F) has been set"]


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        ("ALARM:2", Fault.ALARM),
        ("<Alarm|MPos:0.000,0.000,0.000|FS:0,0>", Fault.ALARM),
        ("<Sleep|MPos:0.000,0.000,0.000|FS:0,0>", Fault.ASLEEP),
        ("Grbl 1.1h ['$' for help]", Fault.RESTARTED),
        ("o\ufffd", Fault.GARBLED),
        ("okok", Fault.GARBLED),
        ("erro:22", Fault.GARBLED),
    ],
)
def test_what_ends_a_job(line, fault):
    streaming = stream("G0X1\nG0X2")
    streaming.give(0.0)
    take(streaming, "ok", line)
    assert streaming.failure.fault is fault


@pytest.mark.parametrize(
    "line", ["[MSG:Pgm End]", ">G21:ok", "$0=1", "[PRB:0,0,0:1]", "", "<Idxe|MPos:0.0,0.0,0.0>"]
)
def test_what_is_no_acknowledgement(line):
    streaming = stream("G0X1")
    streaming.give(0.0)
    take(streaming, line)
    assert (streaming.acknowledged, streaming.failure) == (0, None)


def test_an_acknowledgement_nobody_asked_for():
    streaming = stream("G0X1")
    streaming.give(0.0)
    take(streaming, "ok", "ok")
    assert streaming.failure.fault is Fault.STRAY_ACKNOWLEDGEMENT


def test_silence_is_a_failure_and_any_acknowledgement_is_a_sign_of_life():
    streaming = stream("G0X1\nG0X2")
    streaming.give(0.0)
    take(streaming, "ok", now=4.0)
    streaming.give(9.0)
    assert streaming.failure is None
    streaming.give(9.1)
    assert streaming.failure.fault is Fault.SILENT


def test_real_time_bytes_go_out_of_band():
    streaming = stream("G1X10\n" * 30, buffer=20)
    streaming.give(0.0)
    streaming.command(b"\x91")
    assert streaming.give(0.1) == b"\x91"


def test_ending_elsewhere_than_the_program_is_no_success():
    streaming = stream("G0X1\nG0X2")
    streaming.give(0.0)
    take(streaming, "ok", "ok", *["<Idle|MPos:1.000,3.000,0.000|FS:0,0>"] * 2)
    assert streaming.failure.fault is Fault.OFF_COURSE


def test_our_own_commands_go_one_at_a_time():
    streaming = stream(commands("$C"))
    assert streaming.give(0.0) == b"$C\n"
