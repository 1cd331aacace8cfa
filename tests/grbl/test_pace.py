import math

import pytest

from relieffab.grbl import pace as module
from relieffab.grbl.pace import Limits, Pace, Timetable
from relieffab.grbl.program import prepare
from relieffab.grbl.simulator import SimulatedGrbl

LIMITS = Limits((1600, 1600, 800), (30, 30, 30), 0.01, 15, 400)


def simulated_seconds(lines):
    """What the simulated machine needs, from the first line to its rest."""
    machine, pending = SimulatedGrbl(boot=0.0), 0
    machine.run(0.1)
    machine.wire.sent.clear()
    begin = machine.now
    for line in lines:
        machine.write(line.encode() + b"\n")
        pending += 1
        while pending > 4:
            machine.run(machine.now + 0.001)
            while machine.wire.sent and machine.wire.sent[0][0] <= machine.now:
                pending -= b"ok" in machine.wire.sent.popleft()[1]
    while machine.busy:
        machine.step(math.inf)
    return machine.now - begin


def relief(count):
    return ["G0X0Y0Z0", "F1200"] + [
        f"G1X{0.1 * (i % 60):.3f}Y{0.1 * (i // 60):.3f}Z{0.5 * math.sin(i * 0.1):.3f}"
        for i in range(count)
    ]


@pytest.mark.parametrize(
    ("lines", "seconds"),
    [
        (["G1X20F600"], 20 / 10 + 10 / 30),
        (["G1X0.1F600"], 2 * math.sqrt(0.1 / 30)),
        (["G0X20"], 20 * 60 / 1600 + 1600 / 60 / 30),
        (["G0Z-8"], 8 * 60 / 800 + 800 / 60 / 30),
        (["G1X20F600", "G4P3", "G1X40"], 2 * (20 / 10 + 10 / 30) + 3),
        (["G1X20F600", "G1X0"], 2 * (20 / 10 + 10 / 30)),
        (["G1X10F600", "G1X20"], 20 / 10 + 10 / 30),
        (["G93G1X10F1"], 60),
    ],
)
def test_trapezoids(lines, seconds):
    assert Timetable(prepare(["G0X0Y0Z0", *lines]), LIMITS).total == pytest.approx(
        seconds, abs=0.15
    )


def test_a_relief_takes_what_the_simulated_machine_takes():
    lines = relief(900)
    planned = Timetable(prepare(lines), LIMITS).total
    assert planned == pytest.approx(simulated_seconds(lines), rel=0.08)


def test_blocks_of_the_file_make_no_difference(monkeypatch):
    program = prepare(relief(3000))
    whole = Timetable(program, LIMITS)
    monkeypatch.setattr("relieffab.grbl.program.BLOCK", 700)
    cut = Timetable(program, LIMITS)
    assert cut.total == pytest.approx(whole.total, rel=1e-3)
    for index in (0, 1, 255, 256, 257, 1500, 3001, 3002):
        assert cut.at(index) == pytest.approx(whole.at(index), rel=1e-2, abs=0.1)


def test_seconds_and_lines_are_each_others_inverse():
    table = Timetable(prepare(relief(2000)), LIMITS)
    clock = [table.at(index) for index in range(2003)]
    assert clock == sorted(clock)
    assert clock[-1] == pytest.approx(table.total)
    for index in (5, 300, 1000, 1999):
        assert abs(table.line_at(table.at(index)) - index) <= 1
    assert table.line_at(1e9) == 2001
    assert table.line_at(0.0) == 0


def test_the_clock_corrects_the_plan():
    table = Timetable(prepare(relief(3000)), LIMITS)
    pace, half = Pace(table), 1500
    assert pace.left(0) == pytest.approx(table.total)
    for second in range(int(2 * table.at(half)) + 1):
        pace.tick(float(second), moving=True)
    expected = 2 * (table.total - table.at(half))
    assert pace.left(half) == pytest.approx(expected, rel=0.25)
    before = pace.left(half)
    pace.tick(1e5, moving=False)
    assert pace.left(half) == before
    assert pace.left(3002) == 0


def test_the_entries_of_the_timetable_stay_few():
    assert len(Timetable(prepare(relief(5000)), LIMITS)._seconds) < 5000 / module.STEP + 4
