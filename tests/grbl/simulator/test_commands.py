import pytest


def test_jogging_moves_and_leaves_the_modal_state(bench):
    before = bench.tell("$G")
    assert bench.tell("$J=G91G20X1F100", 12.0) == ["ok"]
    assert bench.machine.planner.position[0] == pytest.approx(25.4, abs=1e-3)
    assert bench.tell("$G") == before
    assert bench.tell("G0X1", 3.0) == ["ok"]
    assert bench.machine.planner.position[0] == pytest.approx(1)


@pytest.mark.parametrize(
    ("line", "code"),
    [("$J=X5", 22), ("$J=M3X5F100", 16), ("$J=G38.2Z-5F100", 16), ("$J=F100", 26)],
)
def test_what_is_no_jog(bench, line, code):
    assert bench.tell(line) == [f"error:{code}"]


def test_a_jog_stays_within_soft_limits(new_bench):
    bench = new_bench(settings={22: 1, 20: 1})
    bench.tell("$H", 10.0)
    assert bench.tell("$J=X500F100") == ["error:15"]


def test_lines_are_locked_out_while_jogging(bench):
    bench.tell("$J=X50F600", 0.2)
    assert bench.tell("$$") == ["error:8"]


def test_sleep_ends_in_a_reset_and_an_alarm(bench):
    bench.tell("M3S500")
    assert bench.tell("$SLP")[0] == "[MSG:Sleeping]"
    assert bench.state() == "Sleep"
    assert bench.machine.spindle == 0
    bench.tell(b"\x18")
    assert bench.state() == "Alarm"


@pytest.mark.parametrize(("what", "rate", "zero"), [("$", 1600, 5), ("#", 900, 0), ("*", 1600, 0)])
def test_restoring_defaults(bench, what, rate, zero):
    bench.tell("$110=900", 0.5)
    bench.tell("G10L2P1X5", 0.5)
    bench.tell(f"$RST={what}", 0.5)
    assert bench.machine.settings[110] == rate
    assert bench.machine.interpreter.coordinates.systems[54.0][0] == zero


def test_inches_are_reported_as_inches(bench):
    bench.tell("$13=1", 0.5)
    bench.tell("G0X25.4", 4.0)
    assert "MPos:1.0000,0.0000,0.0000" in bench.tell(b"?")[0]


def test_a_limit_switch_stops_at_once_and_silences(bench):
    bench.tell("M3S500\nG1X20F600", 0.5)
    bench.machine.hit_limit()
    assert "ALARM:1" in bench.wait(0.1).said
    assert bench.tell(b"?") == []
    assert bench.machine.spindle == 0
