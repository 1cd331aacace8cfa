import pytest

from relieffab.grbl.greeting import QUESTIONS, Greeting
from relieffab.grbl.messages import parse
from relieffab.grbl.stage import Fault, Patience

BANNER = "Grbl 1.1h ['$' for help]"
ANSWERS = {
    b"$I\n": ["[VER:1.1h.20190825:]", "[OPT:V,15,128]"],
    b"$$\n": ["$110=1600.000", "$130=263.000"],
    b"$#\n": ["[G54:1.000,2.000,3.000]"],
    b"$G\n": ["[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]"],
}


def greet(greeting, lines, now=0.0):
    """Feed lines; what is sent in return."""
    for line in lines:
        greeting.take(parse(line), now)
    return greeting.give(now)


def through_the_questions(greeting):
    out = greet(greeting, [BANNER])
    for question in QUESTIONS:
        assert out == question
        out = greet(greeting, [*ANSWERS[question], "ok"])
    return out


def test_one_question_at_a_time_then_idle():
    greeting = Greeting(Patience(), 0.0)
    assert greeting.give(0.0) == b""
    assert through_the_questions(greeting) == b"?"
    assert not greeting.over
    greet(greeting, ["<Idle|MPos:0.000,0.000,0.000|FS:0,0>"])
    assert greeting.over
    assert greeting.failure is None
    assert greeting.controller.settings == {110: 1600.0, 130: 263.0}
    assert greeting.controller.offsets["G54"] == (1.0, 2.0, 3.0)


def test_noise_before_and_after_the_banner_acknowledges_nothing():
    greeting = Greeting(Patience(), 0.0)
    assert greet(greeting, ["error:7", "ok", "$0=10"]) == b""
    assert greet(greeting, [BANNER]) == b"$I\n"
    assert greet(greeting, [">:error:7", ">G21:ok", "[MSG:ok]"]) == b""


def test_a_second_banner_starts_the_questions_again():
    greeting = Greeting(Patience(), 0.0)
    greet(greeting, [BANNER, "ok"])
    assert through_the_questions(greeting) == b"?"


def test_a_board_without_banner_is_asked_and_reset_if_at_rest():
    greeting = Greeting(Patience(banner=3.0), 0.0)
    assert greeting.give(2.9) == b""
    assert greeting.give(3.0) == b"?"
    greeting.take(parse("<Idle|MPos:0,0,0|FS:0,0>"), 3.1)
    assert greeting.give(3.1) == b"\x18"
    greeting.take(parse(BANNER), 3.2)
    assert greeting.give(3.2) == b"$I\n"


def test_a_board_at_work_is_left_alone():
    greeting = Greeting(Patience(banner=3.0), 0.0)
    greeting.give(3.0)
    greeting.take(parse("<Run|MPos:0,0,0|FS:0,0>"), 3.1)
    assert greeting.give(3.1) == b""
    assert greeting.failure.fault is Fault.NOT_READY


@pytest.mark.parametrize("asked", [False, True])
def test_silence_is_a_failure(asked):
    greeting = Greeting(Patience(banner=3.0, answer=5.0), 0.0)
    if asked:
        greeting.take(parse(BANNER), 0.0)
    greeting.give(3.0)
    greeting.give(8.0)
    assert greeting.over
    assert greeting.failure.fault is (Fault.SILENT if asked else Fault.NO_GREETING)


def test_a_locked_machine_is_refused_with_what_to_do():
    greeting = Greeting(Patience(), 0.0)
    through_the_questions(greeting)
    greet(greeting, ["<Alarm|MPos:0,0,0|FS:0,0>"])
    assert greeting.failure.fault is Fault.NOT_READY
    assert "$X" in greeting.failure.hint


def test_a_refused_question_is_a_failure():
    greeting = Greeting(Patience(), 0.0)
    greet(greeting, [BANNER, "error:8"])
    assert greeting.failure.fault is Fault.NOT_READY
    assert "idle" in greeting.failure.found
