import pytest

from relieffab.grbl.messages import parse
from relieffab.grbl.stage import Fault, Patience
from relieffab.grbl.stop import SafeStop

BANNER = "Grbl 1.1h ['$' for help]"


def report(state):
    return parse(f"<{state}|MPos:0,0,0|FS:0,0>")


def test_hold_wait_reset_spindle_off():
    stop = SafeStop(Fault.REFUSED, Patience(), 0.0)
    assert stop.give(0.0) == b"!"
    assert stop.give(0.2) == b"?"
    for state in ("Run", "Hold:1", "Hold:1"):
        stop.take(report(state), 0.2)
        assert b"\x18" not in stop.give(0.2)
    stop.take(parse("ok"), 0.2)
    stop.take(report("Hold:0"), 0.3)
    assert stop.give(0.3) == b"\x18"
    stop.take(parse("ok"), 0.4)
    assert not stop.over
    stop.take(parse(BANNER), 0.4)
    assert stop.give(0.4) == b"M5\n"
    stop.take(parse("ok"), 0.5)
    assert stop.over
    assert "home" not in stop.outcome


def test_after_an_alarm_only_a_reset_is_heard():
    stop = SafeStop(Fault.ALARM, Patience(), 0.0)
    assert stop.give(0.0) == b"\x18"
    stop.take(parse(BANNER), 0.1)
    stop.give(0.1)
    stop.take(parse("error:9"), 0.2)
    assert stop.over


@pytest.mark.parametrize("during", [False, True])
def test_after_a_restart_the_position_is_doubted(during):
    stop = SafeStop(Fault.CANCELLED if during else Fault.RESTARTED, Patience(), 0.0)
    assert stop.give(0.0) == b"!"
    stop.take(parse(BANNER) if during else report("Hold:0"), 0.1)
    assert stop.give(0.1) == b"\x18"
    stop.take(parse(BANNER), 0.2)
    assert stop.give(0.2) == b"M5\n"
    stop.take(parse("ok"), 0.3)
    assert "home" in stop.outcome


@pytest.mark.parametrize("answers", [True, False])
def test_an_endless_or_silent_hold_ends_in_a_reset_all_the_same(answers):
    stop, sent, now = SafeStop(Fault.SILENT, Patience(answer=5, hold=30), 0.0), b"", 0.0
    while b"\x18" not in sent and now < 60:
        sent += stop.give(now)
        if answers:
            stop.take(report("Hold:1"), now)
        now += 0.5
    assert now == pytest.approx(30.5 if answers else 6, abs=0.6)


def test_a_machine_that_does_not_answer_is_said_to_carry_on():
    stop, now = SafeStop(Fault.SILENT, Patience(), 0.0), 0.0
    while not stop.over:
        stop.give(now)
        now += 0.5
    assert now < 20
    assert "spindle on" in stop.outcome
