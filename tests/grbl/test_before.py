import pytest

from relieffab.errors import InputError, MachineError
from relieffab.grbl.before import outline, touch
from relieffab.grbl.job import Job
from relieffab.grbl.port import open_port
from relieffab.grbl.program import prepare
from relieffab.grbl.sender import Company, send

FAST = "sim://?speed=max&boot=0.1"


def test_the_outline_is_traced_above_the_stock_with_the_spindle_off():
    program = prepare("M3S900\nG0Z5\nG0X2Y3\nG1Z-1F300\nX42\nY33\nX2Y3\nG0Z5\nM5")
    with open_port(FAST) as port:
        send(outline(program), port)
        machine = port.device.machine
    assert {point[2] for point in machine.path} == {5.0}
    corners = [(2, 3), (42, 3), (42, 33), (2, 33), (2, 3)]
    assert [point[:2] for point in machine.path[1:]] == [pytest.approx(c) for c in corners]


def test_the_outline_of_work_that_turns_is_turned():
    program = prepare("G93\nG0Z5\nG0X2A-30\nG1Z-1F300\nX42F9\nA60F9\nX2F9\nG0Z5\nM5")
    with open_port(FAST + "&axes=4") as port:
        send(outline(program), port)
        path = port.device.machine.path
    assert {point[1:3] for point in path} == {(0.0, 5.0)}
    corners = [(2, -30), (42, -30), (42, 60), (2, 60), (2, -30)]
    assert [point[::3] for point in path[1:]] == [pytest.approx(c, abs=0.01) for c in corners]


@pytest.mark.parametrize("text", [outline(prepare("G0X2Y3Z5\nG1X9Y9F300")), touch(15.0)])
def test_a_spindle_that_turns_is_switched_off_first(text):
    seen = []
    with open_port(FAST + "&plate=-7.5") as port:
        port.device.machine.startup[0] = "M3S1000"
        send(text, port, Company(show=seen.append))
    assert {view.speed for view in seen if view.state == "Run"} == {0.0}


@pytest.mark.parametrize("text", ["G0Z5\nG0X1", "G0X1Y1Z-1\nG0X2Y2", "G0X1Y1Z5\nG55\nX2"])
def test_an_outline_that_is_not_known_is_not_traced(text):
    with pytest.raises(InputError):
        outline(prepare(text))


def test_a_touch_plate_sets_z():
    with open_port(FAST + "&plate=-7.5") as port:
        report = send(touch(15.0), port)
        machine = port.device.machine
    assert machine.probed.touched
    assert machine.interpreter.coordinates.systems[54.0][2] == pytest.approx(-7.5 - 15, abs=0.01)
    assert report.position[2] == pytest.approx(-7.5 + 10, abs=0.01)


def test_a_plate_that_is_not_there_is_an_alarm_by_name():
    job = Job(prepare(touch(15.0)), resumable=False)
    with open_port(FAST) as port, pytest.raises(MachineError, match="probe found") as caught:
        send(job, port)
    assert "--from-line" not in str(caught.value)
    with pytest.raises(InputError):
        touch(-1)
