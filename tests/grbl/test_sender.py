from itertools import pairwise

import pytest

from relieffab.errors import InputError, MachineError
from relieffab.grbl.port import open_port
from relieffab.grbl.program import prepare
from relieffab.grbl.sender import send
from relieffab.grbl.stage import Patience

FAST = "sim://?speed=max&boot=0.1"


@pytest.fixture
def port():
    with open_port(FAST) as opened:
        yield opened


def raster(count):
    return "M3S1000\nG0X0Y0\n" + "".join(
        f"G1X{i % 20 * 0.2:.3f}Y{i // 20 * 0.2:.3f}Z{-0.01 * (i % 7):.3f}F900\n"
        for i in range(count)
    )


def test_a_job_is_cut_and_reported(port):
    told = []
    report = send(
        "(square)\nG0Z5\nG0X0Y0\nG1Z-1F600\nX10\nY10\nX0\nY0\nG0Z5\nM30",
        port,
        progress=lambda *args: told.append(args),
    )
    machine = port.device.machine
    assert report.lines == 9
    assert report.cut_mm == pytest.approx(46)
    assert report.position == (0.0, 0.0, 5.0)
    assert report.firmware == "1.1h"
    assert report.notes == ()
    assert 4.6 < report.seconds < 12
    assert machine.path[-2:] == [(0.0, 0.0, -1.0), (0.0, 0.0, 5.0)]
    assert {(stage, total, unit) for stage, _, total, unit in told} == {("carving", 46.0, "mm")}
    done = [row[1] for row in told]
    assert done == sorted(done)
    assert done[-1] == 46.0
    assert len(done) <= report.seconds * 5 + 3


def test_the_length_cut_agrees_with_the_machine_on_arcs_too(port):
    lines = ["G0X10Y0Z0", "F900", "G3X0Y10I-10J0", "G2X10Y0R10", "G18G2X0Z-10I-10K0", "G91G1X3Y4"]
    report = send(lines, port)
    path = [(10.0, 0.0, 0.0), *port.device.machine.path[1:]]
    driven = sum(
        sum((b - a) ** 2 for a, b in zip(p, q, strict=True)) ** 0.5 for p, q in pairwise(path)
    )
    assert driven == pytest.approx(report.cut_mm, rel=2e-3)


def test_a_spindle_left_on_is_noted(port):
    assert "1000 rpm" in send("M3S1000\nG1X1F600", port).notes[0]


def test_the_error_tells_line_meaning_and_what_became_of_the_machine(port):
    with pytest.raises(MachineError) as caught:
        send("G21\n(note)\nM3S1000\nG1X1F600\nM6\nG1X2", port)
    text = str(caught.value)
    assert caught.value.exit_status == 3
    assert "line 5: M6" in text
    assert "error:20" in text
    assert "not supported" in text
    assert "spindle switched off" in text
    assert port.device.machine.spindle == 0


def test_a_program_that_must_not_be_sent_moves_nothing(port):
    with pytest.raises(InputError, match="line 2"):
        send("G0X5\nG1X1!", port)
    assert port.now() == 0.0


@pytest.mark.parametrize("stop", [KeyboardInterrupt, ValueError])
def test_ctrl_c_and_any_cancelling_stop_the_machine_and_go_on_up(port, stop):
    def progress(stage, done, total, unit=""):
        if done > 10:
            raise stop

    with pytest.raises(stop):
        send(raster(400), port, progress=progress)
    machine = port.device.machine
    assert machine.state == "Idle"
    assert machine.spindle == 0
    assert not machine.planner.running
    assert 20 < len(machine.path) < 400


def test_m0_is_refused_unless_somebody_is_asked(port):
    text = "G1X1F600\nM0\nG1X2"
    with pytest.raises(InputError, match="line 2"):
        send(text, port)
    asked = []
    report = send(text, port, on_pause=lambda: asked.append(port.device.machine.path[-1]))
    assert asked == [(1.0, 0.0, 0.0)]
    assert report.position == (2.0, 0.0, 0.0)


def test_a_locked_machine_is_not_unlocked_behind_anyones_back():
    with open_port(FAST + "&$22=1") as port, pytest.raises(MachineError, match=r"\$X"):
        send("G0X1", port)


class Fraying:
    """A port that goes away after so many writes."""

    def __init__(self, port, writes):
        self.port, self.writes, self.name = port, writes, "frayed"
        self.now, self.read, self.close = port.now, port.read, port.close

    def write(self, data):
        self.writes -= 1
        if self.writes < 0:
            raise MachineError("writing to frayed failed", found="device disconnected")
        self.port.write(data)


def test_an_unplugged_machine_cannot_be_stopped_and_that_is_said(port):
    with pytest.raises(MachineError) as caught:
        send(raster(100), Fraying(port, 20))
    text = str(caught.value)
    assert "spindle on" in text
    assert "of 102 lines acknowledged" in text


def test_unplugged_before_the_start_is_just_a_port_error(port):
    with pytest.raises(MachineError, match="writing to frayed failed"):
        send(raster(100), Fraying(port, 0))


def test_nothing_there():
    class Mute:
        name, time = "mute", 0.0

        def now(self):
            return self.time

        def read(self):
            self.time += 0.05
            return b""

        def write(self, data):
            pass

    with pytest.raises(MachineError, match="no Grbl answers"):
        send("G0X1", Mute(), patience=Patience(banner=1.0, answer=1.0))


def test_a_long_program_keeps_little_in_memory():
    program = prepare(f"G1 X{i * 0.001:.3f} Y2.000 ; comment" for i in range(20_000))
    arrays = (program.ends, program.numbers, program.cut)
    size = len(program.text) + sum(len(part) * part.itemsize for part in arrays)
    assert size / len(program) < 45
