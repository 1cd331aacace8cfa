import io
import tracemalloc
from itertools import pairwise

import pytest

from relieffab.errors import InputError, MachineError
from relieffab.grbl import program as module
from relieffab.grbl.feed import Feed
from relieffab.grbl.job import Job, Resume
from relieffab.grbl.joblog import Log
from relieffab.grbl.port import open_port
from relieffab.grbl.program import prepare
from relieffab.grbl.sender import Company, send
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
        Company(show=told.append),
    )
    machine = port.device.machine
    assert report.lines == 9
    assert report.cut_mm == pytest.approx(46)
    assert report.position == (0.0, 0.0, 5.0)
    assert report.firmware == "1.1h"
    assert report.notes == ()
    assert 4.6 < report.seconds < 12
    assert machine.path[-2:] == [(0.0, 0.0, -1.0), (0.0, 0.0, 5.0)]
    assert {view.total_mm for view in told} == {46.0}
    done = [view.cut_mm for view in told]
    assert done == sorted(done)
    assert done[-1] == 46.0
    assert len(done) <= report.seconds * 5 + 3
    left = [view.left_s for view in told]
    assert left[0] == pytest.approx(report.seconds, rel=0.3)
    assert left[-1] < 1


def test_the_length_cut_agrees_with_the_machine_on_arcs_too(port):
    lines = ["G0X10Y0Z0", "F900", "G3X0Y10I-10J0", "G2X10Y0R10", "G18G2X0Z-10I-10K0", "G91G1X3Y4"]
    report = send(lines, port)
    path = [(10.0, 0.0, 0.0), *port.device.machine.path[1:]]
    driven = sum(
        sum((b - a) ** 2 for a, b in zip(p, q, strict=True)) ** 0.5 for p, q in pairwise(path)
    )
    assert driven == pytest.approx(report.cut_mm, rel=2e-3)


def test_an_offset_stored_behind_a_slow_move_is_waited_for(port):
    report = send("G21G90\nG1X3F20\nG10L20P1X0\nG1X2F600", port)
    assert report.lines == 4
    assert report.seconds > 9
    assert report.position == (5, 0, 0)


def test_a_machine_whose_offset_the_program_clears_is_not_called_astray(port):
    port.device.machine.startup[0] = "G43.1Z-4"
    report = send("G21G90\nG49\nG0X1Y1Z5\nG1X9F600", port)
    assert report.position == (9, 1, 5)


@pytest.mark.parametrize("offset", ["", "G92X5"])
def test_work_zero_that_the_reset_forgot_is_told(port, offset):
    port.device.machine.startup[0] = offset
    with pytest.raises(MachineError, match="--from-line") as caught:
        send("G0X9\nG1X2Y1X3\n", port)
    told = ("set work zero again" in str(caught.value), "--zero-set" in str(caught.value))
    assert told == (bool(offset), bool(offset))


def test_a_spindle_left_on_is_switched_off(port):
    send("M3S1000\nG1X1F600", port)
    assert port.device.machine.spindle == 0


def test_a_spindle_that_turned_before_the_job_is_switched_off_behind_it(port):
    port.device.machine.startup[0] = "M3S1000"
    seen = []
    send("G1X5F600", port, Company(show=seen.append))
    assert {view.speed for view in seen if view.state == "Run"} == {1000.0}
    assert port.device.machine.spindle == 0


def test_the_error_tells_line_meaning_and_what_became_of_the_machine(port):
    with pytest.raises(MachineError) as caught:
        send("G21\n(note)\nM3S1000\nG1X1F600\nX2Y1X3\nG1X2", port)
    text = str(caught.value)
    assert caught.value.exit_status == 3
    assert "line 5: X2Y1X3" in text
    assert "error:25" in text
    assert "on the line twice" in text
    assert "its spindle is off" in text
    assert port.device.machine.spindle == 0


def test_a_program_that_must_not_be_sent_moves_nothing(port):
    with pytest.raises(InputError, match="line 2"):
        send("G0X5\nG1X1!", port)
    assert port.now() == 0.0


@pytest.mark.parametrize("stop", [KeyboardInterrupt, ValueError])
def test_ctrl_c_and_any_cancelling_stop_the_machine_and_go_on_up(port, stop):
    def show(view):
        if view.cut_mm > 10:
            raise stop

    with pytest.raises(stop):
        send(raster(400), port, Company(show=show))
    machine = port.device.machine
    assert machine.state == "Idle"
    assert machine.spindle == 0
    assert not machine.planner.running
    assert 20 < len(machine.path) < 400


class Impatient:
    """A port at which somebody presses Ctrl-C again and again."""

    def __init__(self, port):
        self.port, self.reads, self.name = port, 0, "impatient"
        self.now, self.write, self.close = port.now, port.write, port.close

    def read(self):
        self.reads += 1
        if self.reads > 150 and self.reads % 3 == 0 and self.reads < 170:
            raise KeyboardInterrupt
        return self.port.read()


def test_more_ctrl_c_does_not_keep_the_machine_from_being_stopped(port):
    with pytest.raises(KeyboardInterrupt) as caught:
        send(raster(400), Impatient(port))
    assert "its spindle is off" in caught.value.__notes__[0]
    assert port.device.machine.state == "Idle"
    assert port.device.machine.spindle == 0


def test_a_soft_limit_names_the_line_that_goes_too_far():
    text = "G0X-5Y-5Z-5\nG92X0\nG1X-9F600\nX-400\nX-9"
    with open_port(FAST + "&$22=1&$20=1") as port, pytest.raises(MachineError) as caught:
        send(Job(prepare(text), home=True), port)
    assert "ALARM:2" in str(caught.value)
    assert "line 4: X-400" in str(caught.value)


def test_m0_is_refused_unless_somebody_is_there(port):
    text = "G1X1F600\nM0\nG1X2"
    with pytest.raises(InputError, match="line 2"):
        send(text, port)
    states = []

    def typed():
        return "~" if states[-1:] == ["Hold:0"] else ""

    report = send(text, port, Company(show=lambda view: states.append(view.state), typed=typed))
    assert "Hold:0" in states
    assert report.position == (2.0, 0.0, 0.0)


def test_keys_reach_the_machine_and_x_stops_it(port):
    keys = iter(["", "+", "2", "", "!", "~", "?", "x"])
    typed = {"n": 0}

    def one_now_and_then():
        typed["n"] += 1
        return next(keys, "") if typed["n"] % 150 == 0 else ""

    seen = []
    with pytest.raises(MachineError, match="cancelled"):
        send(raster(1500), port, Company(show=seen.append, typed=one_now_and_then))
    assert (110, 50, 100) in {view.overrides for view in seen}
    assert "Hold:0" in {view.state for view in seen}
    assert port.device.machine.state == "Idle"


def test_a_person_who_says_no_leaves_the_machine_alone(port):
    plans = []
    with pytest.raises(MachineError, match="cancelled"):
        send(raster(9), port, Company(confirm=lambda plan: plans.append(plan) or False))
    assert plans[0].table.total > 0
    assert port.device.machine.path == []


def test_how_far_it_came_is_kept_every_two_seconds_and_forgotten_at_the_end(port):
    kept = []
    send(raster(300), port, Company(keep=kept.append))
    lines = [record.line for record in kept[:-1]]
    assert kept[-1] is None
    assert lines == sorted(lines)
    assert 5 < len(lines) < 20
    assert not any(record.position_kept for record in kept[:-1])


def test_a_job_that_failed_says_where_to_go_on(port):
    kept = []
    with pytest.raises(MachineError, match="--from-line") as caught:
        send(raster(200) + "X1X2\n" + raster(200), port, Company(keep=kept.append))
    last = kept[-1]
    assert f"--from-line {last.line}" in str(caught.value)
    assert 180 < last.line < 203
    assert last.position_kept
    assert "refused" in last.reason


class Full(io.StringIO):
    """A disk with room for so many characters."""

    def write(self, text):
        if self.tell() + len(text) > 9000:
            raise OSError(28, "No space left on device")
        return super().write(text)


def test_a_full_disk_stops_the_job_and_says_so(port):
    disk, kept = Full(), []
    company = Company(log=lambda digest, now: Log(disk, digest, now), keep=kept.append)
    with pytest.raises(MachineError, match="No space left") as caught:
        send(raster(400), port, company)
    assert "its spindle is off" in str(caught.value)
    assert port.device.machine.spindle == 0
    assert kept[-1].position_kept


def test_a_disk_too_full_for_the_record_stops_it_as_well(port):
    def keep(record):
        raise OSError(28, "No space left on device")

    with pytest.raises(MachineError, match="No space left") as caught:
        send(raster(400), port, Company(keep=keep))
    assert "could not be recorded" in str(caught.value)
    assert "--from-line" in str(caught.value)
    assert port.device.machine.spindle == 0


def test_what_grbl_does_not_know_is_refused_before_it_moves(port):
    with pytest.raises(MachineError, match=r"line 3: M6 is error:20"):
        send("M3S900\nG1X5F600\nM6\nG1X2", port)
    assert port.device.machine.path == []


def test_a_machine_that_homes_is_homed_if_told_to():
    with open_port(FAST + "&$22=1&$20=1") as port:
        report = send(Job(prepare("G0X-5\nG1X-9F600"), home=True), port)
        assert report.position == pytest.approx((-9, -1, -1))
        assert port.device.machine.path[0] == (-5.0, -1.0, -1.0)


def test_an_alarm_is_ended_if_told_to(port):
    port.device.machine.at(0.2, lambda: port.device.machine.alarm(3))
    report = send(Job(prepare("G1X2F600"), unlock=True), port)
    assert report.position == (2.0, 0.0, 0.0)


def test_after_homing_a_job_goes_on_whatever_the_power_did():
    kept, text = [], "G0X-30Y-30Z-2\n" + raster(200).replace("X", "X-").replace("Y", "Y-")
    text = text.replace("Z-0", "Z-5") + "G0Z2\n"
    with open_port(FAST + "&$22=1&$20=1&reboot_at=20") as port:
        port.device.machine.interpreter.coordinates.systems[54.0] = [0.0, 0.0, -10.0]
        with pytest.raises(MachineError, match="restarted"):
            send(Job(prepare(text), home=True), port, Company(keep=kept.append))
    record = kept[-1]
    assert not record.position_kept
    with open_port(FAST + "&$22=1&$20=1") as port:
        port.device.machine.interpreter.coordinates.systems[54.0] = [0.0, 0.0, -10.0]
        send(Job(prepare(text), home=True, resume=Resume(record)), port)
        assert len(port.device.machine.path) < 202


def test_a_locked_machine_is_not_unlocked_behind_anyones_back():
    with open_port(FAST + "&$22=1") as port, pytest.raises(MachineError, match="--unlock"):
        send("G0X1", port)


class Fraying:
    """A port that goes away after so many writes."""

    def __init__(self, port, writes):
        self.port, self.writes, self.name = port, writes, "frayed"
        self.now, self.read, self.close = port.now, port.read, port.close
        self.back = False

    def reopen(self, patience):
        self.writes = 1000 if self.back else 0
        return self.back

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


def test_a_machine_plugged_in_again_is_stopped_and_its_position_doubted(port):
    frayed, kept = Fraying(port, 20), []
    frayed.back = True
    with pytest.raises(MachineError, match="connection to the machine was lost") as caught:
        send(raster(100), frayed, Company(keep=kept.append))
    assert "its spindle is off" in str(caught.value)
    assert "not to be trusted" in str(caught.value)
    assert port.device.machine.spindle == 0
    assert not kept[-1].position_kept


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


def test_a_long_program_takes_no_more_memory_than_a_short_one(monkeypatch):
    monkeypatch.setattr(module, "IN_MEMORY", 1 << 14)
    monkeypatch.setattr(module, "BLOCK", 1 << 10)

    def most(count):
        tracemalloc.start()
        program = prepare(f"G1 X{i * 0.001:.3f} Y2.000 ; comment" for i in range(count))
        feed = Feed(program, (0.0, 0.0, 0.0))
        while feed.next is not None:
            feed.take()
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return peak

    short, long = most(4000), most(12_000)
    assert long < 1.1 * short
