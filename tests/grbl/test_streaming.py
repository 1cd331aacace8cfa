import pytest

from relieffab.grbl.messages import parse
from relieffab.grbl.program import prepare
from relieffab.grbl.stage import Fault, Patience
from relieffab.grbl.streaming import Streaming

IDLE = "<Idle|MPos:0,0,0|Bf:15,128|FS:0,0>"
RUN = "<Run|MPos:0,0,0|Bf:10,100|FS:100,0>"


def stream(text, buffer=128):
    return Streaming(prepare(text), buffer, 15, Patience(), 0.0)


def take(streaming, *lines, now=0.0):
    for line in lines:
        streaming.take(parse(line), now)


def test_the_buffer_is_filled_and_no_further():
    streaming = stream("G1X10\n" * 30, buffer=20)
    assert streaming.give(0.0) == b"G1X10\n" * 3
    assert streaming.give(0.1) == b""
    take(streaming, "ok")
    assert streaming.give(0.1) == b"G1X10\n"


def test_done_is_acknowledged_and_idle_twice():
    streaming = stream("G1X10\nM5")
    streaming.give(0.0)
    take(streaming, IDLE, IDLE, "ok", "ok")
    assert not streaming.over
    take(streaming, IDLE, RUN, IDLE)
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
    take(streaming, "ok")
    assert streaming.give(0.0) == b"G10L2P1X0\n"
    assert streaming.give(0.0) == b""
    take(streaming, "ok")
    assert streaming.give(0.0) == b"G0X2\nG0X3\n"


def test_an_error_names_its_own_line_not_the_last_one_sent():
    streaming = stream("(a)\nG0X1\nG1X2\nG0X3\nG0X4")
    streaming.give(0.0)
    take(streaming, "ok", "error:22")
    failure = streaming.failure
    assert (failure.fault, failure.line) == (Fault.REFUSED, 1)
    assert "no feed rate" in failure.found
    assert "line" in failure.hint
    assert streaming.give(0.0) == b""


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        ("ALARM:2", Fault.ALARM),
        ("<Alarm|MPos:0,0,0|FS:0,0>", Fault.ALARM),
        ("Grbl 1.1h ['$' for help]", Fault.RESTARTED),
    ],
)
def test_what_ends_a_job(line, fault):
    streaming = stream("G0X1\nG0X2")
    streaming.give(0.0)
    take(streaming, "ok", line)
    assert (streaming.failure.fault, streaming.failure.line) == (fault, 1)


@pytest.mark.parametrize(
    "line", ["[MSG:Pgm End]", ">G21:ok", "o?k", "okok", "$0=1", "[PRB:0,0,0:1]"]
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


def test_an_ok_that_never_comes_times_out_only_while_the_machine_is_idle():
    streaming = stream("G0X1\nG0X2")
    streaming.give(0.0)
    for second in range(60):
        take(streaming, RUN, now=float(second))
        streaming.give(float(second))
    assert streaming.failure is None
    for second in range(60, 65):
        take(streaming, IDLE, now=float(second))
        streaming.give(float(second))
    assert streaming.failure.fault is Fault.LOST_ACKNOWLEDGEMENT
    assert streaming.failure.found.endswith("2")


def test_a_dwell_may_be_idle_for_its_own_time():
    streaming = stream("G4P20")
    for second in range(22):
        streaming.give(float(second))
        take(streaming, IDLE, now=float(second))
    assert streaming.failure is None
    take(streaming, IDLE, now=24.0)
    assert streaming.failure.fault is Fault.LOST_ACKNOWLEDGEMENT


def test_silence_is_a_failure():
    streaming = stream("G0X1")
    streaming.give(0.0)
    streaming.give(5.0)
    assert streaming.failure is None
    streaming.give(5.1)
    assert streaming.failure.fault is Fault.SILENT


def test_what_the_planner_holds_is_not_yet_cut():
    streaming = stream("G0X0Y0\n" + "\n".join(f"G1X{i}" for i in range(1, 11)))
    streaming.give(0.0)
    take(streaming, *["ok"] * 11, "<Run|MPos:0,0,0|Bf:12,128|FS:100,0>")
    assert streaming.cut_mm == 7.0
    take(streaming, IDLE, IDLE)
    assert streaming.cut_mm == 10.0
