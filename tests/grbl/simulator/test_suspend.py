BANNER = "Grbl 1.1h ['$' for help]"


def test_the_door_stops_the_spindle_and_waits_to_be_closed_and_resumed(bench):
    bench.tell("M3S500\nG1X20F600", 0.8)
    bench.machine.at(bench.machine.now, lambda: bench.machine.open_door(3.0))
    assert "[MSG:Check Door]" in bench.wait(0.02).said
    assert bench.state() == "Door:2"
    bench.wait(1.0)
    assert bench.state() == "Door:1"
    assert bench.machine.spindle == 0
    assert bench.tell(b"~", 0.5) == []
    bench.wait(3.0)
    assert bench.state() == "Door:0"
    bench.tell(b"~")
    assert bench.state() == "Door:3"
    bench.wait(4.0)
    assert bench.state() == "Run"
    assert bench.machine.spindle == 500
    bench.wait(5.0)
    assert bench.machine.path[-1] == (20.0, 0.0, 0.0)


def test_a_door_opened_while_held_is_a_door(bench):
    bench.tell("M3S500\nG1X20F600", 0.8)
    bench.tell(b"!", 1.0)
    bench.tell(b"\x84")
    assert bench.state() == "Door:0"
    assert bench.machine.spindle == 0


def test_the_spindle_can_be_stopped_while_held_and_only_then(bench):
    bench.tell("M3S500\nG1X20F600", 0.5)
    bench.tell(b"\x9e")
    assert bench.machine.spindle == 500
    bench.tell(b"!", 1.0)
    bench.tell(b"\x9e")
    assert bench.machine.spindle == 0
    bench.tell(b"~", 4.5)
    assert bench.machine.spindle == 500


def test_a_hold_ends_a_jog(bench):
    assert bench.tell("$J=G91X50F600", 0.5) == ["ok"]
    assert bench.state() == "Jog"
    bench.tell(b"!", 1.5)
    assert bench.state() == "Idle"
    assert 2 < bench.machine.planner.position[0] < 20
