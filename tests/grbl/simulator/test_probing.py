import pytest


def test_the_plate_is_found_and_kept(new_bench):
    bench = new_bench(plate=-4.0)
    assert bench.tell("G91G38.2Z-10F300", 3.0) == ["[PRB:0.000,0.000,-4.000:1]", "ok"]
    assert bench.machine.planner.position[2] == pytest.approx(-4)
    assert "[PRB:0.000,0.000,-4.000:1]" in bench.tell("$#")
    assert bench.tell("G0Z1", 2.0) == ["ok"]
    assert bench.machine.planner.position[2] == pytest.approx(-3)


def test_away_from_the_plate_it_lets_go(new_bench):
    bench = new_bench(plate=-4.0)
    bench.tell("G91G38.2Z-10F300", 3.0)
    assert bench.tell("G38.4Z2F60", 5.0)[-1] == "ok"


@pytest.mark.parametrize(("code", "alarm"), [("38.2", True), ("38.3", False)])
def test_a_plate_that_is_not_there(bench, code, alarm):
    said = bench.tell(f"G91G{code}Z-5F600", 3.0)
    assert ("ALARM:5" in said) is alarm
    assert bench.machine.planner.position[2] == pytest.approx(-5)


def test_a_probe_that_touches_already_is_an_alarm(new_bench):
    bench = new_bench(plate=1.0)
    assert "ALARM:4" in bench.tell("G91G38.2Z-5F600", 1.0)


def test_a_probe_needs_a_feed_and_a_way(bench):
    assert bench.tell("G38.2Z-5") == ["error:22"]
    assert bench.tell("G38.2Z0F50") == ["error:33"]
