"""Running times against trapezoids worked out by hand."""

import math
from collections import deque
from math import sqrt

import numpy as np
import pytest

from relieffab import profiles
from relieffab.gcode.estimate import estimate, motion_ends, motion_seconds, move_ends, pace
from relieffab.gcode.read import read_program
from relieffab.grbl.program import prepare
from relieffab.grbl.simulator.machine import SimulatedGrbl
from relieffab.machine import Machine


def machine(**changes):
    values = {
        "max_rate": (6000.0, 6000.0, 600.0),
        "acceleration": (100.0, 100.0, 50.0),
        "junction_deviation": 0.01,
        "planner_blocks": 1000,
        "line_rate": 1e9,
        "baud": 1e12,
    }
    return Machine(
        "mill", "", (500.0,) * 3, spindle=(0.0, 1e4), spindle_max_setting=1e3, **values | changes
    )


def seconds(points, feed, **changes):
    feeds = np.full(len(points), float(feed))
    return motion_seconds(np.array(points, float), feeds, machine(**changes))


def test_a_trapezoid():
    # 10 mm/s at 100 mm/s2: 0.1 s and 0.5 mm at either end, 19 mm between.
    assert seconds([[0, 0, 0], [20, 0, 0]], 600) == pytest.approx(0.1 + 1.9 + 0.1)


def test_a_triangle():
    # Too short to reach the feed: up for half, down for half.
    assert seconds([[0, 0, 0], [1, 0, 0]], 6000) == pytest.approx(2 * sqrt(1 / 100))


def test_a_rapid_goes_as_fast_as_its_slowest_axis():
    # 100 mm/s in X.
    assert seconds([[0, 0, 0], [300, 0, 0]], np.inf) == pytest.approx(1 + 2 + 1)
    # Z alone at 10 mm/s and 50 mm/s2: 0.2 s and 1 mm at either end.
    assert seconds([[0, 0, 0], [0, 0, 12]], np.inf) == pytest.approx(0.2 + 1.0 + 0.2)
    # On a slope of 1 in 1 Z's own rate and acceleration hold along its own axis.
    assert seconds([[0, 0, 0], [12, 0, 12]], np.inf) == pytest.approx(0.2 + 1.0 + 0.2)


def test_a_straight_line_in_pieces_takes_no_longer():
    pieces = [[x, 0, 0] for x in np.linspace(0, 20, 41)]
    assert seconds(pieces, 600) == pytest.approx(2.1)


def test_a_right_angle_is_taken_at_the_junction_speed():
    # sin(45 deg) = 0.70711; acceleration along the corner's bisector 100 sqrt(2).
    half = sqrt(0.5)
    v = sqrt(100 * sqrt(2) * 0.01 * half / (1 - half))
    assert v < 10
    one = 0.1 + (10 - v) / 100 + (20 - 0.5 - (100 - v * v) / 200) / 10
    assert seconds([[0, 0, 0], [20, 0, 0], [20, 20, 0]], 600) == pytest.approx(2 * one, rel=1e-6)


def test_turning_back_stops():
    assert seconds([[0, 0, 0], [20, 0, 0], [0, 0, 0]], 600) == pytest.approx(4.2)


def test_a_short_look_ahead_holds_speed_down():
    # With 3 blocks of 0.5 mm the machine has to be able to stop within 2 of them.
    pieces = [[x, 0, 0] for x in np.arange(0, 200.1, 0.5)]
    v = sqrt(2 * 100 * 2 * 0.5)
    slow = seconds(pieces, 6000, planner_blocks=3)
    assert slow > 200 / (v * 1.5)
    assert slow == pytest.approx(200 / v, rel=0.12)
    assert seconds(pieces, 6000) == pytest.approx(1 + 1 + 1)


def test_a_slow_parser_holds_lines_up():
    pieces = [[x, 0, 0] for x in np.arange(0, 100.05, 0.1)]
    assert seconds(pieces, 6000, line_rate=100.0) == pytest.approx(10.0, rel=0.02)


def test_dwells_stop_the_machine():
    points = np.array([[0, 0, 0], [20, 0, 0], [40, 0, 0]], float)
    wait = np.array([3.0, 0.0, 0.5, 0.25])
    took = motion_seconds(points, np.full(3, 600.0), machine(), dwell=wait)
    assert took == pytest.approx(2 * 2.1 + 3.75)
    assert motion_seconds(points[:1], np.full(1, 600.0), machine(), dwell=wait[:2]) == 3.0


def test_each_move_ends_when_a_trapezoid_says():
    # From rest to rest: 2.1 s each; a point given twice takes no time.
    points = np.array([[0, 0, 0], [20, 0, 0], [20, 0, 0], [40, 0, 0]], float)
    wait = np.array([3.0, 0.0, 0.0, 0.5, 0.25])
    ends = motion_ends(points, np.full(4, 600.0), machine(), dwell=wait)
    np.testing.assert_allclose(ends, [3.0, 5.1, 5.1, 7.7])
    assert motion_seconds(points, np.full(4, 600.0), machine(), dwell=wait) == pytest.approx(7.95)


def test_the_last_move_of_a_program_ends_with_it():
    program = read_program("G21 G90\nG0 Z5\nX0 Y0\nG4 P2\nG1 X20 F600\nY9\nX3\nM30")
    ends = move_ends(program, machine())
    assert (np.diff(ends) >= 0).all()
    assert ends[-1] == pytest.approx(estimate(program, machine()))


def test_a_program():
    program = read_program("G21 G90\nG0 Z5\nX0 Y0\nM3 S1\nG4 P2\nG1 X20 F600\nM30")
    assert estimate(program, machine()) == pytest.approx(2 + 2.1)


def test_chords_of_one_arc_cost_one_line():
    head = "G21 G90\nG0 Z5\nX0 Y0\n"
    arc = read_program(head + "G2 X20 I10 F600\nM30")
    quick = estimate(arc, machine())
    assert estimate(arc, machine(line_rate=10.0)) == pytest.approx(quick + 0.1, abs=1e-3)


def test_a_slow_wire_holds_lines_up():
    text = "G21 G90\nG0 Z5\nX0 Y0\nG1 F6000\n" + "\n".join(f"X{k}.5Y0" for k in range(90))
    program = read_program(text + "\nM30")
    assert program.sent[-3:].tolist() == [8, 8, 8]
    # Ten bits a character: 8 characters in 0.5 s.
    assert estimate(program, machine(baud=160.0)) == pytest.approx(45, rel=0.02)


def dense(step, feed, deep, every_feed):
    """Rows of small moves over waves, from near where the machine stands."""
    rng = np.random.default_rng(0)
    way = np.arange(2500) * step
    x, y = way % 80, 0.3 * (way // 80)
    z = -0.5 - deep * np.sin(2 * way) + rng.normal(0, 0.01 * deep, len(way))
    feeds = [f"F{feed - k}" if every_feed else "" for k in rng.integers(0, 9, len(way))]
    moves = [f"X{a:.3f}Y{b:.3f}Z{c:.3f}{f}" for a, b, c, f in zip(x, y, z, feeds, strict=True)]
    head = ["G21 G90", "G0Z0.01", "G0X0.01Y0", "M3S1000", f"G1F{feed}"]
    return "\n".join([*head, *moves, "G0Z5", "M5", "M30"])


def simulated(text, one):
    """Seconds a simulated Grbl with the machine's figures takes, fed by counting characters."""
    settings = {11: one.junction_deviation}
    for axis in range(3):
        settings |= {100 + axis: 1000, 110 + axis: one.max_rate[axis]}
        settings |= {120 + axis: one.acceleration[axis], 130 + axis: 1000}
    grbl = SimulatedGrbl(
        settings=settings,
        rx_buffer=one.rx_buffer,
        planner_blocks=one.planner_blocks,
        line_rate=one.line_rate,
        baud=one.baud,
        boot=0.0,
    )
    grbl.run(0.01)
    start, waiting, lines = (
        grbl.now,
        deque(),
        deque(line.wire for line in prepare(text).read()),
    )
    while lines or waiting or grbl.state != "Idle":
        while lines and sum(waiting) + len(lines[0]) <= one.rx_buffer:
            waiting.append(len(lines[0]))
            grbl.write(lines.popleft())
        said = grbl.wire.sent[0][0] if grbl.wire.sent else math.inf
        grbl.step(min(grbl.next_event(), said))
        while grbl.wire.sent and grbl.wire.sent[0][0] <= grbl.now:
            assert b"error" not in grbl.wire.sent[0][1]
            if grbl.wire.sent.popleft()[1].startswith(b"ok"):
                waiting.popleft()
    return grbl.now - start


@pytest.mark.parametrize(
    "name", ["3018-prover", "shapeoko-3", "x-carve-1000", "longmill-mk2-30x30", "altmill-4x4"]
)
@pytest.mark.parametrize(
    "path", [(0.05, 3000, 0.1, False), (0.1, 3000, 0.5, True), (0.3, 4000, 0.5, False)]
)
def test_within_two_percent_of_the_simulated_controller(name, path):
    one, text = profiles.machine(name), dense(*path)
    assert estimate(read_program(text), one) == pytest.approx(simulated(text, one), rel=0.02)


def test_what_starves_a_planner():
    program = read_program(dense(0.02, 3000, 0.1, True))
    shown = pace(program, profiles.machine("shapeoko-3"))
    assert shown.seconds > 2 * shown.unhindered
    assert shown.starved == pytest.approx(1 - shown.unhindered / shown.seconds)
    assert pace(program, machine()).starved < 1e-9


def test_no_motion_takes_no_time():
    assert seconds([[0, 0, 0], [0, 0, 0]], 600) == 0
