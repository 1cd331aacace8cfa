import pytest

from relieffab.grbl.messages import parse
from relieffab.grbl.stage import Failure, Fault, Patience
from relieffab.grbl.stop import RESETS, SafeStop

BANNER = "Grbl 1.1h ['$' for help]"


def report(state, speed=0):
    return parse(f"<{state}|MPos:0.000,0.000,0.000|FS:0,{speed}>")


def stopping(fault, alarm=None, **patience):
    failure = None if fault is None else Failure(fault, "why", alarm=alarm)
    return SafeStop(failure, Patience(**patience), 0.0)


def test_hold_wait_reset_spindle_off_and_believe_only_a_report():
    stop = stopping(Fault.REFUSED)
    assert stop.give(0.0) == b"!"
    assert stop.give(0.2) == b"?"
    for state in ("Run", "Hold:1", "Hold:1"):
        stop.take(report(state), 0.2)
        assert stop.give(0.2) == b""
    stop.take(parse("ok"), 0.2)
    stop.take(report("Hold:0", 900), 0.3)
    assert stop.give(0.3) == b"\x18"
    stop.take(parse("ok"), 0.4)
    stop.take(parse(BANNER), 0.4)
    assert stop.give(0.4) == b"M5\nM9\n?"
    stop.take(report("Idle", 900), 0.5)
    assert not stop.over
    stop.take(report("Idle", 0), 0.6)
    assert stop.over
    assert stop.safe
    assert stop.position_kept


def test_a_hold_that_was_lost_is_sent_again():
    stop, sent = stopping(Fault.CANCELLED), b""
    for tick in range(21):
        sent += stop.give(tick * 0.1)
        stop.take(report("Run"), tick * 0.1)
    assert 3 <= sent.count(b"!") <= 4  # 0.6 s apart
    assert b"\x18" not in sent


def test_a_reset_that_was_lost_is_sent_again():
    stop, sent, now = stopping(Fault.CANCELLED), b"", 0.0
    while not stop.over and now < 60:
        sent += stop.give(now)
        stop.take(report("Hold:0", 900), now)
        now += 0.2
    assert sent.count(b"\x18") == RESETS
    assert not stop.safe


def test_a_banner_that_was_lost_does_not_matter():
    stop = stopping(Fault.CANCELLED)
    stop.take(report("Hold:0"), 0.1)
    assert stop.give(0.1).endswith(b"\x18")
    stop.take(report("Idle"), 0.3)
    assert stop.give(0.3).startswith(b"M5\nM9\n")
    stop.take(report("Idle"), 0.4)
    assert stop.safe


@pytest.mark.parametrize(
    ("alarm", "kept"), [(1, False), (2, True), (3, False), (5, True), (None, False)]
)
def test_after_an_alarm_only_a_reset_is_heard(alarm, kept):
    stop = stopping(Fault.ALARM, alarm)
    assert stop.give(0.0) == b"\x18"
    stop.take(parse(BANNER), 0.1)
    stop.give(0.1)
    stop.take(report("Alarm"), 0.2)
    assert stop.safe
    assert stop.position_kept is kept
    assert ("home it" in stop.outcome) is not kept


def test_a_reset_that_met_motion_loses_the_position():
    stop = stopping(Fault.CANCELLED)
    stop.take(report("Hold:0"), 0.1)
    for line in ("ALARM:3", BANNER):
        stop.take(parse(line), 0.2)
    stop.take(report("Alarm"), 0.3)
    assert stop.safe
    assert not stop.position_kept


@pytest.mark.parametrize("during", [False, True])
def test_after_a_restart_the_position_is_doubted(during):
    stop = stopping(Fault.CANCELLED if during else Fault.RESTARTED)
    assert stop.give(0.0) == b"!"
    stop.take(parse(BANNER) if during else report("Hold:0"), 0.1)
    assert stop.give(0.1) == b"\x18"
    stop.take(parse(BANNER), 0.2)
    stop.take(report("Idle"), 0.3)
    assert "home" in stop.outcome


@pytest.mark.parametrize("answers", [True, False])
def test_an_endless_or_silent_hold_ends_in_a_reset_all_the_same(answers):
    stop, sent, now = stopping(Fault.SILENT, answer=5, hold=30), b"", 0.0
    while b"\x18" not in sent and now < 60:
        sent += stop.give(now)
        if answers:
            stop.take(report("Hold:1"), now)
        now += 0.5
    assert now == pytest.approx(30.5 if answers else 6, abs=0.6)


def test_a_machine_that_does_not_answer_is_said_to_carry_on():
    stop, now = stopping(Fault.SILENT), 0.0
    while not stop.over:
        stop.give(now)
        now += 0.5
    assert now < 20
    assert "spindle on" in stop.outcome
    assert not stop.safe


def test_leaving_check_mode_is_a_reset():
    stop = stopping(None)
    assert stop.give(0.0) == b"\x18"
    stop.take(parse(BANNER), 0.1)
    stop.take(report("Idle"), 0.2)
    assert stop.safe
