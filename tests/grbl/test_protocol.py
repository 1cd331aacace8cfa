"""The state machine against machines of the tests' own making, and under injected faults."""

import math
import random
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.grbl.program import prepare
from relieffab.grbl.protocol import Session
from relieffab.grbl.simulator import SimulatedGrbl
from relieffab.grbl.stage import Fault

BANNER = b"Grbl 1.1h ['$' for help]\r\n"


class Scripted:
    """Counts the bytes it was sent and has not acknowledged; answers when it is let."""

    def __init__(self, buffer):
        self.buffer = buffer
        self.unacknowledged, self.most = 0, 0
        self.lines, self.polls, self.rest = [], [], b""
        self.replies = [(BANNER, 0)]

    def take(self, data, now):
        for byte in data:
            if byte == ord("?"):
                self.polls.append(now)
                self.replies.append((b"<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n", 0))
                continue
            self.unacknowledged += 1
            self.most = max(self.most, self.unacknowledged)
            self.rest += bytes([byte])
            if byte == ord("\n"):
                self._answer(self.rest)
                self.rest = b""

    def _answer(self, line):
        if line == b"$I\n":
            self.replies.append((f"[OPT:V,15,{self.buffer}]\r\n".encode(), 0))
        elif not line.startswith(b"$"):
            self.lines.append(line)
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


@settings(max_examples=120, deadline=None)
@given(programs, st.sampled_from([80, 128, 1024]), st.integers(0, 2**32))
def test_never_more_unacknowledged_than_the_buffer_whatever_the_chunking(text, buffer, seed):
    """And every line is sent once, in order; and `?` no more than five times a second."""
    rng, program = random.Random(seed), prepare(text)
    machine, session, now = Scripted(buffer), Session(program, now=0.0), 0.0
    wire = b""
    while not session.over:
        now += rng.choice([0.0, 0.001, 0.05])
        if rng.random() < 0.7:
            wire += machine.give(rng.randint(0, 6))
        size = rng.randint(0, len(wire))
        chunk, wire = wire[:size], wire[size:]
        machine.take(session.advance(chunk, now), now)
    assert session.failure is None
    assert machine.lines == [program.line(i) for i in range(len(program))]
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
    text = "G21G90\nM3S1000\n" + "".join(f"G1X{x}Y{y}Z{z}F900\n" for x, y, z in points)
    return prepare(text + "M5\nM30\n"), points


def at_rest(machine):
    return not machine.planner.running and machine.spindle == 0


@pytest.mark.parametrize("buffer", [80, 128, 256])
def test_the_executed_path_is_the_program(buffer):
    program, points = zigzag(60)
    wire = Wire(Session(program, now=0.0), rx_buffer=buffer)
    session = wire.run()
    assert session.failure is None
    assert wire.machine.lost == 0
    assert wire.machine.path == [pytest.approx(p, abs=1 / 1600) for p in points]
    assert session.ended - session.started > 1.0


def test_a_wrong_belief_about_the_buffer_would_show():
    """The comparison can fail: a machine with a smaller buffer than it reports."""
    program, points = zigzag(60)
    wire = Wire(Session(program, now=0.0))
    wire.machine.wire.size = 60
    wire.spoil = lambda reply, now: reply.replace(b"V,15,60", b"V,15,128")
    wire.run()
    assert wire.machine.lost > 0
    assert wire.machine.path != [pytest.approx(p, abs=1 / 1600) for p in points]
    assert wire.session.failure is not None


@pytest.mark.parametrize("bad", [0, 7, 29])
def test_an_error_names_its_line_and_the_machine_ends_at_rest(bad):
    lines = ["M3S1000", *(f"G1X{i}F900" for i in range(1, 31))]
    lines.insert(bad, "G1X1Y2X3")
    wire = Wire(Session(prepare(lines), now=0.0))
    session = wire.run()
    assert session.failure.fault is Fault.REFUSED
    assert session.failure.line == bad
    assert "25" in session.failure.found
    assert at_rest(wire.machine)
    assert "stopped" in session.outcome
    assert wire.machine.state == "Idle"


def test_an_alarm_is_a_failure_with_its_meaning():
    wire = Wire(Session(prepare("G91\nG1X-5F900\nX-400\n"), now=0.0), settings={22: 1, 20: 1})
    wire.machine.run(0.2)
    wire.machine.write(b"$H\n")
    wire.machine.run(10.0)
    session = wire.run()
    assert session.failure.fault is Fault.ALARM
    assert "soft limit" in session.failure.found
    assert at_rest(wire.machine)


def test_a_machine_that_restarts_mid_job():
    program, _ = zigzag(200)
    wire = Wire(Session(program, now=0.0))
    wire.run(until=lambda: wire.session.acknowledged > 50)
    wire.machine.write(b"\x18")
    session = wire.run()
    assert session.failure.fault in (Fault.RESTARTED, Fault.ALARM)
    assert 50 < session.failure.line < 200
    assert at_rest(wire.machine)


def test_cancel_stops_where_it_is_and_keeps_the_position():
    program, _ = zigzag(200)
    wire = Wire(Session(program, now=0.0))
    wire.run(until=lambda: wire.session.cut_mm > 10)
    wire.session.cancel(wire.machine.now)
    session = wire.run()
    assert session.failure.fault is Fault.CANCELLED
    assert wire.machine.state == "Idle"
    assert at_rest(wire.machine)
    assert "home" not in session.outcome


def test_cancelled_before_the_first_line_nothing_is_sent():
    session = Session(prepare("G0X1"), now=0.0)
    session.advance(BANNER, 0.1)
    session.cancel(0.2)
    assert session.over
    assert session.advance(b"", 0.3) == b""


def test_a_stop_does_not_ask_for_status_more_often_either():
    program, _ = zigzag(200)
    wire = Wire(Session(program, now=0.0))
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


def test_an_ok_that_never_comes():
    program, _ = zigzag(40)
    seen = []

    def swallow(reply, now):
        seen.append(reply)
        return b"" if seen.count(b"ok\r\n") == 20 and reply == b"ok\r\n" else reply

    wire = Wire(Session(program, now=0.0), spoil=swallow)
    session = wire.run()
    assert session.failure.fault is Fault.LOST_ACKNOWLEDGEMENT
    assert session.failure.found.endswith("1")
    assert at_rest(wire.machine)


def test_a_cut_wire_is_noticed_in_seconds():
    program, _ = zigzag(400)
    wire = Wire(Session(program, now=0.0), spoil=lambda reply, now: b"" if now > 3 else reply)
    session = wire.run(limit=60)
    assert session.failure.fault is Fault.SILENT
    assert session.ended < 3 + 6


def test_a_program_beyond_the_soft_limits_is_refused_before_it_moves():
    wire = Wire(Session(prepare("G0X1\nG1X-400F900"), now=0.0), settings={22: 1, 20: 1})
    wire.machine.run(0.2)
    wire.machine.write(b"$H\n")
    wire.machine.run(10.0)
    assert wire.run().failure.fault is Fault.MISFIT
    assert wire.machine.path == []


def test_without_soft_limits_a_large_program_is_only_noted():
    session = Wire(Session(prepare("G0X0\nG1X400F99999"), now=0.0)).run()
    assert session.failure is None
    assert session.notes == ["X spans 400.000 mm of 263.000 mm of travel"]


FAULTS = ("none", "drop", "garble", "double", "error", "banner", "reset", "noise", "split")


def faulty(kind, rng, at):
    """What a bad line or a bad machine does to the `at`-th reply."""
    count = [0]

    def spoil(reply, now):
        count[0] += 1
        if count[0] != at:
            return reply
        place = rng.randrange(len(reply))
        return {
            "drop": b"",
            "garble": reply[:place] + bytes([rng.randrange(256)]) + reply[place + 1 :],
            "double": reply + reply,
            "error": b"error:2\r\n",
            "banner": b"\r\n" + BANNER + reply,
            "noise": bytes(rng.randrange(128, 256) for _ in range(9)) + b"\r\n" + reply,
            "split": reply[:place] + b"\r\n" + reply[place:],
        }.get(kind, reply)

    return spoil


def try_schedule(kind, seed):
    """One job under one fault: either all of it is cut, or the failure is told; always safe."""
    rng = random.Random(seed)
    program, points = zigzag(rng.randint(5, 40))
    spoil = faulty(kind, rng, rng.randint(1, 120))
    wire = Wire(Session(program, now=0.0), spoil=spoil, rng=rng)
    if kind == "reset":
        stop_at = rng.randint(1, len(program))
        wire.run(until=lambda: wire.session.acknowledged >= stop_at)
        wire.machine.write(b"\x18")
    session = wire.run(limit=400.0)
    if session.failure is None:
        assert wire.machine.path == [pytest.approx(p, abs=1 / 1600) for p in points]
        assert wire.machine.lost == 0
    else:
        assert session.failure.message
    started = session.started is not None
    assert not started or at_rest(wire.machine)
    return session.failure


@settings(max_examples=80, deadline=None)
@given(st.sampled_from(FAULTS), st.integers(0, 2**32))
def test_under_any_one_fault_the_job_is_whole_or_the_failure_is_told(kind, seed):
    failure = try_schedule(kind, seed)
    assert kind != "none" or failure is None


def test_patience_is_finite():
    session, now = Session(prepare("G0X1"), now=0.0), 0.0
    while not session.over:
        session.advance(b"", now)
        now += 0.5
    assert session.failure.fault is Fault.NO_GREETING
    assert now < math.inf
