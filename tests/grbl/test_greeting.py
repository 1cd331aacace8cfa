import pytest

from relieffab.grbl.greeting import QUESTIONS, TRIES, Greeting
from relieffab.grbl.messages import parse
from relieffab.grbl.stage import Fault, Patience

BANNER = "Grbl 1.1h ['$' for help]"
SETTINGS = [f"${number}={number}.000" for number in (*range(20), 110, 130)]
ANSWERS = {
    b"$I\n": ["[VER:1.1h.20190825:]", "[OPT:V,15,128]"],
    b"$$\n": SETTINGS,
    b"$#\n": ["[G54:1.000,2.000,3.000]"],
    b"$G\n": ["[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]"],
}
IDLE = "<Idle|MPos:0.000,0.000,0.000|FS:0,0>"


def greet(greeting, lines, now=0.0):
    """Feed lines; what is sent in return."""
    for line in lines:
        greeting.take(parse(line), now)
    return greeting.give(now)


def answer(greeting, out):
    """Answer questions until something else is asked."""
    while out in ANSWERS:
        out = greet(greeting, [*ANSWERS[out], "ok"])
    return out


def test_every_question_twice_then_idle():
    greeting = Greeting(Patience(), 0.0)
    assert greeting.give(0.0) == b""
    out = greet(greeting, [BANNER])
    for question in QUESTIONS:
        for _ in range(2):
            assert out == question
            out = greet(greeting, [*ANSWERS[question], "ok"])
    assert out == b"?"
    assert not greeting.over
    greet(greeting, [IDLE])
    assert greeting.over
    assert greeting.failure is None
    assert greeting.controller.settings[130] == 130.0
    assert greeting.controller.offsets["G54"] == (1.0, 2.0, 3.0)


def test_noise_before_and_after_the_banner_acknowledges_nothing():
    greeting = Greeting(Patience(), 0.0)
    assert greet(greeting, ["error:7", "ok", "$0=10"]) == b""
    assert greet(greeting, [BANNER]) == b"$I\n"
    assert greet(greeting, [">:error:7", ">G21:ok", "[MSG:ok]"]) == b""


def test_an_altered_answer_is_asked_again_and_never_believed():
    greeting = Greeting(Patience(), 0.0)
    greet(greeting, [BANNER])
    for size in (928, 128, 929):
        assert greet(greeting, [f"[OPT:V,15,{size}]", "ok"]) == b"$I\n"
    assert greet(greeting, ["[OPT:V,15,128]", "ok"]) == b"$$\n"
    assert greeting.controller.buffer == 128


def test_what_changes_by_itself_need_not_agree():
    greeting = Greeting(Patience(), 0.0)
    greet(greeting, [BANNER])
    for free in (102, 101):
        out = greet(greeting, ["[OPT:V,100,1024]", f"[FREE MEMORY:{free}K]", "[MSG:hello]", "ok"])
    assert out == b"$$\n"


def test_half_an_answer_is_no_answer():
    greeting = Greeting(Patience(), 0.0)
    out = greet(greeting, [BANNER])
    while out == b"$I\n":
        out = greet(greeting, [*ANSWERS[out], "ok"])
    for _ in range(TRIES):
        assert out == b"$$\n"
        out = greet(greeting, [*SETTINGS[:5], "ok"])
    assert greeting.failure.fault is Fault.GARBLED


def test_a_second_banner_starts_the_questions_again():
    greeting = Greeting(Patience(), 0.0)
    greet(greeting, [BANNER, "ok"])
    assert answer(greeting, greet(greeting, [BANNER])) == b"?"


def test_a_board_without_banner_is_asked_and_not_reset():
    greeting = Greeting(Patience(banner=3.0), 0.0)
    assert greeting.give(2.9) == b""
    assert greeting.give(3.0) == b"?"
    greeting.take(parse(IDLE), 3.1)
    assert answer(greeting, greeting.give(3.1)) == b"?"
    greet(greeting, [IDLE])
    assert greeting.over
    assert greeting.controller.version == "1.1h"


def test_a_board_at_work_is_left_alone():
    greeting = Greeting(Patience(banner=3.0), 0.0)
    greeting.give(3.0)
    greeting.take(parse("<Run|MPos:0,0,0|FS:0,0>"), 3.1)
    assert greeting.give(3.1) == b""
    assert greeting.failure.fault is Fault.NOT_READY


@pytest.mark.parametrize("asked", [False, True])
def test_silence_is_a_failure(asked):
    greeting, now = Greeting(Patience(banner=3.0, answer=5.0), 0.0), 0.0
    if asked:
        greeting.take(parse(BANNER), 0.0)
    sent = b""
    while not greeting.over:
        sent += greeting.give(now)
        now += 0.5
    assert now < 15
    assert sent == (b"$I\n" * 3 if asked else b"??")
    assert greeting.failure.fault is (Fault.SILENT if asked else Fault.NO_GREETING)


@pytest.mark.parametrize("line", ["<Alarm|MPos:0,0,0|FS:0,0>", "ALARM:1"])
def test_a_locked_machine_is_refused_with_what_to_do(line):
    greeting = Greeting(Patience(), 0.0)
    answer(greeting, greet(greeting, [BANNER]))
    greet(greeting, [line])
    assert greeting.failure.fault is Fault.NOT_READY
    assert "--unlock" in greeting.failure.hint


def test_a_refused_question_is_asked_again_and_then_a_failure():
    greeting = Greeting(Patience(), 0.0)
    greet(greeting, [BANNER, *["error:8"] * (TRIES - 1)])
    assert greeting.failure is None
    greet(greeting, ["error:8"])
    assert greeting.failure.fault is Fault.NOT_READY
    assert "idle" in greeting.failure.found
