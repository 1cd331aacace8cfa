"""The state machine against machines of the tests' own making, and under injected faults."""

import math
import random
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.grbl.job import Job, Resume
from relieffab.grbl.program import prepare
from relieffab.grbl.protocol import Session
from relieffab.grbl.record import Record
from relieffab.grbl.simulator import SimulatedGrbl
from relieffab.grbl.simulator.settings import Settings
from relieffab.grbl.stage import Failure, Fault

BANNER = b"Grbl 1.1h ['$' for help]\r\n"
NEEDED = "".join(f"{line}\r\n" for line in Settings().lines()).encode()


def session_of(program, now=0.0, **options):
    return Session(Job(program, **options), now=now)


class Scripted:
    """Counts the bytes it was sent and has not acknowledged; answers when it is let."""

    def __init__(self, buffer):
        self.buffer = buffer
        self.unacknowledged, self.most = 0, 0
        self.lines, self.polls, self.rest = [], [], b""
        self.replies = [(BANNER, 0)]
        self.work = (0.0, 0.0, 0.0)

    def take(self, data, now):
        for byte in data:
            if byte == ord("?"):
                self.polls.append(now)
                self.replies.append((b"<Idle|WPos:%.3f,%.3f,%.3f|FS:0,0>\r\n" % self.work, 0))
                continue
            if byte >= 0x80:
                continue
            self.unacknowledged += 1
            self.most = max(self.most, self.unacknowledged)
            self.rest += bytes([byte])
            if byte == ord("\n"):
                self._answer(self.rest)
                self.rest = b""

    def _answer(self, line):
        answers = {
            b"$I\n": b"[VER:1.1h:]\r\n[OPT:V,15,%d]\r\n" % self.buffer,
            b"$$\n": NEEDED,
            b"$#\n": b"[G54:0.000,0.000,0.000]\r\n",
            b"$G\n": b"[GC:G0 G54 G17 G21 G90 G94 M5 M9]\r\n",
        }
        if line in answers:
            self.replies.append((answers[line], 0))
        else:
            self.lines.append(line)
            x, _, y = line[3:].partition(b"Y")
            self.work = (float(x), float(y.partition(b"F")[0]), 0.0)
        self.replies.append((b"ok\r\n", len(line)))

    def give(self, count):
        """The next replies, merged; what they acknowledge is free the moment they leave."""
        now, self.replies = self.replies[:count], self.replies[count:]
        self.unacknowledged -= sum(freed for _, freed in now)
        return b"".join(reply for reply, _ in now)


words = st.builds(
    lambda g, x, y: f"G{g}X{x:.3f}Y{y:.3f}F600",
    st.sampled_from([0, 1]),
    st.floats(-99, 99),
    st.floats(-9, 9),
)
programs = st.lists(words, min_size=1, max_size=30).map("\n".join)


@settings(max_examples=150, deadline=None)
@given(programs, st.sampled_from([80, 128, 1024]), st.integers(0, 2**32))
def test_never_more_unacknowledged_than_the_buffer_whatever_the_chunking(text, buffer, seed):
    """And every line is sent once, in order; and `?` no more than five times a second."""
    rng, program = random.Random(seed), prepare(text)
    machine, session, now = Scripted(buffer), session_of(program), 0.0
    wire = b""
    while not session.over:
        now += rng.choice([0.0, 0.001, 0.05])
        if session.ready:
            session.go(now)
        if rng.random() < 0.7:
            wire += machine.give(rng.randint(0, 6))
        size = rng.randint(0, len(wire))
        chunk, wire = wire[:size], wire[size:]
        machine.take(session.advance(chunk, now), now)
    assert session.failure is None
    assert machine.lines == [line.wire for line in program.read()]
    assert machine.most <= buffer
    gaps = [b - a for a, b in zip(machine.polls[1:], machine.polls[2:], strict=False)]
    assert all(gap >= 0.2 - 1e-9 for gap in gaps)


class Wire:
    """A simulated machine at the end of a wire that can be made faulty.

    `spoil(reply, now)` changes what the machine says; None unplugs it.
    """

    def __init__(self, session, *, spoil=lambda reply, now: reply, rng=None, **options):
        self.session, self.spoil, self.rng = session, spoil, rng
        self.machine = SimulatedGrbl(**{"boot": 0.1} | options)
        self.coming = b""

    def run(self, limit=3000.0, until=lambda: False):
        machine, session = self.machine, self.session
        machine.write(session.advance(b"", machine.now))
        while not session.over and not until():
            tick = machine.now + 0.05
            while machine.now < tick and not self._ready():
                machine.step(tick)
            while self._ready():
                self.coming += self.spoil(machine.wire.sent.popleft()[1], machine.now)
            size = self.rng.randint(0, len(self.coming)) if self.rng else len(self.coming)
            chunk, self.coming = self.coming[:size], self.coming[size:]
            if session.ready:
                session.go(machine.now)
            out = session.advance(chunk, machine.now)
            if out:
                machine.write(out)
            assert machine.now < limit, "the session never ends"
        machine.run(machine.now + 1.0)
        return session

    def _ready(self):
        sent = self.machine.wire.sent
        return bool(sent) and sent[0][0] <= self.machine.now


def zigzag(count):
    points = [(round(1.0 + (i % 5) * 0.4, 3), round((i // 5) * 0.3, 3), -0.5) for i in range(count)]
    text = "G21G90\nM3S1000\nG0Z5\n" + "".join(f"G1X{x}Y{y}Z{z}F900\n" for x, y, z in points)
    return prepare(text + "M5\nM30\n"), points


def at_rest(machine):
    return not machine.planner.running and machine.spindle == 0


@pytest.mark.parametrize("buffer", [80, 128, 256])
def test_the_executed_path_is_the_program(buffer):
    program, points = zigzag(60)
    wire = Wire(session_of(program), rx_buffer=buffer)
    session = wire.run()
    assert session.failure is None
    assert wire.machine.lost == 0
    assert wire.machine.path[1:] == [pytest.approx(p, abs=1 / 1600) for p in points]
    assert session.ended - session.started > 1.0


def test_a_wrong_belief_about_the_buffer_would_show():
    """The comparison can fail: a machine with a smaller buffer than it reports."""
    program, points = zigzag(60)
    wire = Wire(session_of(program))
    wire.machine.wire.size = 60
    wire.spoil = lambda reply, now: reply.replace(b"V,15,60", b"V,15,128")
    wire.run()
    assert wire.machine.lost > 0
    assert wire.machine.path[1:] != [pytest.approx(p, abs=1 / 1600) for p in points]
    assert wire.session.failure is not None


@pytest.mark.parametrize("bad", [0, 7, 29])
def test_an_error_names_its_line_and_the_machine_ends_at_rest(bad):
    lines = ["M3S1000", *(f"G1X{i}F900" for i in range(1, 31))]
    lines.insert(bad, "G1X1Y2X3")
    wire = Wire(session_of(prepare(lines)))
    session = wire.run()
    assert session.failure.fault is Fault.REFUSED
    assert session.failure.where.startswith(f"line {bad + 1}:")
    assert "25" in session.failure.found
    assert at_rest(wire.machine)
    assert "stopped" in session.outcome
    assert session.position_kept
    assert wire.machine.state == "Idle"


def test_an_alarm_is_a_failure_with_its_meaning():
    wire = Wire(session_of(prepare("G91\nG1X-5F900\nX-400\n")), settings={22: 1, 20: 1})
    wire.machine.run(0.2)
    wire.machine.write(b"$H\n")
    wire.machine.run(10.0)
    session = wire.run()
    assert session.failure.fault is Fault.ALARM
    assert "soft limit" in session.failure.found
    assert at_rest(wire.machine)


def test_a_machine_that_restarts_mid_job():
    program, _ = zigzag(200)
    wire = Wire(session_of(program))
    wire.run(until=lambda: wire.session.acknowledged > 50)
    wire.machine.write(b"\x18")
    session = wire.run()
    assert session.failure.fault in (Fault.RESTARTED, Fault.ALARM)
    assert 20 < session.reached.number < 200
    assert at_rest(wire.machine)


def test_cancel_stops_where_it_is_and_keeps_the_position():
    program, _ = zigzag(200)
    wire = Wire(session_of(program))
    wire.run(until=lambda: wire.session.cut_mm > 10)
    wire.session.cancel(wire.machine.now)
    session = wire.run()
    assert session.failure.fault is Fault.CANCELLED
    assert wire.machine.state == "Idle"
    assert at_rest(wire.machine)
    assert "home" not in session.outcome


def test_cancelled_before_the_first_line_nothing_is_sent():
    session = session_of(prepare("G0X1"))
    session.advance(BANNER, 0.1)
    session.cancel(0.2)
    assert session.over
    assert session.advance(b"", 0.3) == b""


def test_a_stop_does_not_ask_for_status_more_often_either():
    program, _ = zigzag(200)
    wire = Wire(session_of(program))
    asked = []
    write = wire.machine.write
    wire.machine.write = lambda data: (
        asked.extend([wire.machine.now] * data.count(b"?")),
        write(data),
    )
    wire.run(until=lambda: wire.session.acknowledged > 50)
    wire.session.cancel(wire.machine.now)
    wire.run()
    assert len(asked) > 5
    assert min(b - a for a, b in pairwise(asked)) >= 0.2 - 1e-9


@pytest.mark.parametrize(("mask", "found"), [(3, "not in the machine's buffer"), (1, "idle")])
def test_an_ok_that_never_comes(mask, found):
    """By the machine's count of bytes within a second, without it once the machine is idle."""
    program, _ = zigzag(40)
    seen = []

    def swallow(reply, now):
        seen.append(reply)
        return b"" if seen.count(b"ok\r\n") == 20 and reply == b"ok\r\n" else reply

    wire = Wire(session_of(program), spoil=swallow, settings={10: mask})
    session = wire.run()
    assert session.failure.fault is Fault.LOST_ACKNOWLEDGEMENT
    assert found in session.failure.found
    assert (session.acknowledged < 40) is (mask == 3)
    assert at_rest(wire.machine)


def test_a_cut_wire_is_noticed_in_seconds():
    program, _ = zigzag(400)
    wire = Wire(session_of(program), spoil=lambda reply, now: b"" if now > 3 else reply)
    session = wire.run(limit=60)
    assert session.failure.fault is Fault.SILENT
    assert session.ended < 3 + 6


def test_a_program_beyond_the_soft_limits_is_refused_before_it_moves():
    wire = Wire(session_of(prepare("G0X1\nG1X-400F900")), settings={22: 1, 20: 1})
    wire.machine.run(0.2)
    wire.machine.write(b"$H\n")
    wire.machine.run(10.0)
    assert wire.run().failure.fault is Fault.MISFIT
    assert wire.machine.path == []


def test_without_soft_limits_a_large_program_is_only_noted():
    session = Wire(session_of(prepare("G0X0\nG1X400F99999"))).run()
    assert session.failure is None
    assert session.plan.notes == ("X spans 400.000 mm of 263.000 mm of travel",)


def test_a_stray_ok_is_seen_before_it_overruns_the_buffer():
    program, _ = zigzag(300)
    wire = Wire(session_of(program))
    wire.run(until=lambda: wire.session.acknowledged > 60)
    wire.machine.say("ok")
    session = wire.run()
    assert session.failure.fault is Fault.STRAY_ACKNOWLEDGEMENT
    assert session.acknowledged < 120
    assert at_rest(wire.machine)


def test_nothing_moves_before_it_is_told_to():
    session, machine = session_of(prepare("G0X1")), SimulatedGrbl(boot=0.1)
    while not session.ready:
        machine.write(session.advance(b"".join(d for _, d in machine.wire.sent), machine.now))
        machine.wire.sent.clear()
        machine.run(machine.now + 0.05)
    for _ in range(100):
        assert session.advance(b"", machine.now) == b""
        machine.run(machine.now + 0.05)
    assert session.plan.first == 0
    assert machine.path == []
    with pytest.raises(RuntimeError):
        session_of(prepare("G0X1")).go(0.0)


def test_a_spindle_left_on_by_the_program_is_switched_off():
    wire = Wire(session_of(prepare("M3S1000\nM8\nG1X1F600")))
    assert wire.run().failure is None
    assert at_rest(wire.machine)
    assert wire.machine.interpreter.coolant == 9


def test_modal_state_left_by_others_is_put_right():
    wire = Wire(session_of(prepare("G1X2F600")))
    wire.machine.run(0.2)
    wire.machine.write(b"G91G20\n")
    wire.machine.run(0.5)
    wire.machine.wire.sent.clear()
    wire.run()
    assert wire.session.failure is None
    assert wire.machine.path == [(2.0, 0.0, 0.0)]


def test_check_mode_finds_every_error_and_moves_nothing():
    program = prepare("M3S1000\nG1X1F600\nG1X2Y1X3\nM6\nG1X5")
    wire = Wire(session_of(program, check=True))
    session = wire.run()
    assert session.failure is None
    assert [error.split(":")[0] for error in session.errors] == ["line 3", "line 4"]
    assert (wire.machine.path, wire.machine.state) == ([], "Idle")
    assert session.record() is None


def test_a_machine_that_reports_inches_or_work_positions_is_understood():
    program, points = zigzag(60)
    for mask, inches in ((2, 0), (0, 0), (3, 1)):
        wire = Wire(session_of(program), settings={10: mask, 13: inches})
        assert wire.run().failure is None
        assert wire.session.cut_mm == pytest.approx(program.cut_mm, abs=0.2)
        assert wire.session.position == pytest.approx(points[-1], abs=0.02)


@pytest.mark.parametrize("seed", range(8))
def test_on_a_sound_line_no_machine_is_called_astray(seed):
    """Arcs in all planes, helices, inches, relative moves, coarse steps, work offsets."""
    rng = random.Random(seed)
    lines = ["G0X0Y0Z5", "F3000"]
    for _ in range(16):
        radius = 10 ** rng.uniform(0, 2)
        lines += rng.choice(
            [
                [f"G1X{rng.uniform(-200, 200):.3f}Y{rng.uniform(-90, 90):.3f}"],
                ["G17", f"G91G2X{radius:.3f}Y{radius:.3f}I{radius:.3f}J0", "G90"],
                ["G17", f"G91G3X0Y0Z{rng.uniform(-3, 3):.2f}I{radius:.3f}", "G90"],
                ["G18", f"G91G2X{radius:.3f}Z{-radius:.3f}I0K{-radius:.3f}", "G90G17"],
                ["G19", f"G91G3Y{radius:.3f}Z{radius:.3f}R{radius * 1.2:.3f}", "G90G17"],
                [f"G20G91G1X{rng.uniform(-2, 2):.4f}F100", "G90G21F3000"],
                [f"G0Z{rng.uniform(0, 9):.2f}"],
            ]
        )
    wire = Wire(
        session_of(prepare(lines)),
        settings={100: 40, 101: 40, 102: 40, 110: 9000, 111: 9000, 112: 9000, 10: seed % 4,
                  120: 400, 121: 400, 122: 400, 13: seed % 2},
    )  # fmt: skip
    wire.machine.interpreter.coordinates.systems[54.0] = [12.345, -6.789, 3.21]
    session = wire.run()
    assert session.failure is None
    assert session.cut_mm == pytest.approx(session.view().total_mm)


def test_a_byte_altered_on_the_way_to_the_machine_is_seen_by_where_it_goes():
    program, _ = zigzag(100)
    wire = Wire(session_of(program))
    write, hit = wire.machine.write, []

    def alter(data):
        if b"X2.6Y3.0" in data and not hit:
            hit.append(data)
            data = data.replace(b"X2.6Y3.0", b"X2.6Y9.0")
        write(data)

    wire.machine.write = alter
    session = wire.run()
    assert hit
    assert session.failure.fault is Fault.OFF_COURSE
    assert at_rest(wire.machine)
    assert session.position_kept
    assert 40 < session.reached.number < 59  # the altered line is 58


def test_an_interrupted_job_is_taken_up_again_where_it_stopped():
    program, points = zigzag(120)
    wire = Wire(session_of(program))
    wire.run(until=lambda: wire.session.cut_mm > 20)
    wire.session.cancel(wire.machine.now)
    record = wire.run().record()
    assert record.position_kept
    first = record.line - 4
    assert 0 < first < 110
    again = Wire(session_of(program, now=wire.machine.now, resume=Resume(record)))
    again.machine = wire.machine
    again.machine.wire.sent.clear()
    session = again.run()
    assert session.failure is None
    assert at_rest(again.machine)
    path = again.machine.path
    assert path[-(len(points) - first) :] == [
        pytest.approx(p, abs=1 / 1600) for p in points[first:]
    ]
    up, across, plunge = path[-(len(points) - first) - 3 : -(len(points) - first)]
    assert up[2] == across[2] == pytest.approx(5.0)
    assert up[:2] == pytest.approx(record.position[:2], abs=1e-3)
    assert across[:2] == plunge[:2]


def turning(count):
    """A program that goes round and round, 9 degrees a move, by inverse time."""
    points = [(1.0 + i * 0.02, 0.0, -0.5 - (i % 3) * 0.1, -9.0 * i) for i in range(count)]
    cuts = "".join(f"G1X{x:.3f}A{a:g}Z{z:g}F240\n" for x, _, z, a in points)
    return prepare(f"G21G90G94\nG93\nM3S1000\nG0Z5\nG0X1A0\n{cuts}G0Z5\nM5\nG94\nM30\n"), points


def test_work_that_turns_is_followed_and_taken_up_again():
    program, points = turning(100)
    wire = Wire(session_of(program), axes=4)
    wire.run(until=lambda: wire.session.cut_mm > 300)
    assert len(wire.session.view().position) == 4
    wire.session.cancel(wire.machine.now)
    record = wire.run().record()
    assert record.position_kept and record.position[3] < -250
    first = record.line - 6
    again = Wire(session_of(program, now=wire.machine.now, resume=Resume(record)))
    again.machine = wire.machine
    again.machine.wire.sent.clear()
    session = again.run()
    assert session.failure is None and at_rest(again.machine)
    steps = [800, 800, 800, 88.889]
    path = again.machine.path[:-1]
    for made, wanted in zip(path[-(len(points) - first) :], points[first:], strict=True):
        assert np.abs(np.subtract(made, wanted) * steps).max() <= 0.51
    # Up, then round, then along, and only then down.
    before = path[-(len(points) - first) - 4 : -(len(points) - first)]
    up, round_to, along, plunge = before
    assert up[2] == round_to[2] == along[2] == pytest.approx(5.0)
    assert up[3] == pytest.approx(record.position[3], abs=0.01)
    assert round_to[0] == up[0] and round_to[3] == along[3] == plunge[3]
    assert round_to[3] == pytest.approx(points[first - 1][3], abs=0.01)


def test_homing_does_not_take_y_from_the_axis_of_work_that_turns():
    program, _ = turning(3)
    wire = Wire(session_of(program, home=True), axes=4, settings={22: 1})
    session = wire.run()
    assert (
        session.failure.fault is Fault.MISFIT and "Y away from the axis" in session.failure.message
    )
    assert wire.machine.path == []


def test_an_altered_angle_stops_the_machine():
    """One wrong digit of A shows as a machine off the programmed way."""
    program, _ = turning(60)
    wire = Wire(session_of(program), axes=4)
    write = wire.machine.write
    wire.machine.write = lambda data: write(data.replace(b"A-180Z", b"A-100Z"))
    assert wire.run().failure.fault is Fault.OFF_COURSE


def test_a_lost_zero_is_not_carved_from():
    program, _ = zigzag(20)
    record = Record(program.digest, 9, None, (0.0, 0.0, 0.0), False, "the machine restarted")
    wire = Wire(session_of(program, resume=Resume(record)))
    assert wire.run().failure.fault is Fault.MISFIT
    assert wire.machine.path == []
    told = Wire(session_of(program, resume=Resume(record, zero_set=True)))
    assert told.run().failure is None


def test_a_reason_of_the_drivers_stops_the_machine_too():
    program, _ = zigzag(100)
    wire = Wire(session_of(program))
    wire.run(until=lambda: wire.session.cut_mm > 5)
    wire.session.abort(Failure(Fault.UNRECORDED, "the disk is full"), wire.machine.now)
    session = wire.run()
    assert session.failure.fault is Fault.UNRECORDED
    assert session.position_kept
    assert at_rest(wire.machine)


def test_what_a_person_sees_while_it_runs():
    program, _ = zigzag(100)
    wire = Wire(session_of(program))
    assert wire.session.view() is None
    wire.run(until=lambda: wire.session.cut_mm > 10)
    view = wire.session.view()
    assert view.state == "Run"
    assert 10 < view.cut_mm < view.total_mm
    assert 0 < view.left_s < 60
    assert view.speed == 1000
    assert 0.5 < view.fill <= 1
    wire.session.command(b"!")
    wire.run(until=lambda: wire.session.held)
    assert "held" in wire.session.view().meaning
    wire.session.command(b"~")
    assert wire.run().failure is None


def test_patience_is_finite():
    session, now = session_of(prepare("G0X1")), 0.0
    while not session.over:
        session.advance(b"", now)
        now += 0.5
    assert session.failure.fault is Fault.NO_GREETING
    assert now < math.inf
