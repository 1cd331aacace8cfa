import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relieffab.grbl.simulator.planner import Planner
from relieffab.grbl.simulator.settings import Settings

A, VMAX, DEVIATION = 30.0, 1600 / 60, 0.01


def planner(size=15, **changes):
    values = {112: 1600.0} | {int(key[1:]): value for key, value in changes.items()}
    return Planner(Settings(values), size)


def drive(queue, *, until=math.inf):
    """Run all moves; the time of the end and the speed at the end of each."""
    now, leaves = 0.0, []
    queue.start(0.0)
    while queue.end < until:
        now = queue.end
        leaves.append(queue.motion(now)[1])
        queue.finish(now)
    return now, leaves


def test_one_move_takes_what_the_trapezoid_says():
    queue = planner()
    queue.add((100.0, 0.0, 0.0), 10.0, 0.0)
    seconds, _ = drive(queue)
    assert seconds == pytest.approx(100 / 10 + 10 / A)
    assert queue.position == (100.0, 0.0, 0.0)


def test_the_slowest_axis_limits_the_rapid_and_the_acceleration():
    queue = planner(_112=600.0, _122=10.0)
    queue.add((30.0, 0.0, 40.0), math.inf, 0.0)
    block = queue.blocks[0]
    assert block.nominal == pytest.approx(10.0 / 0.8)
    assert block.acceleration == pytest.approx(10.0 / 0.8)


def test_straight_on_goes_through_at_full_speed_and_back_stops():
    queue = planner()
    for x in (50.0, 100.0, 50.0):
        queue.add((x, 0.0, 0.0), 10.0, 0.0)
    _, leaves = drive(queue)
    assert leaves == pytest.approx([10.0, 0.0, 0.0], abs=1e-6)


def test_a_corner_is_taken_at_the_junction_speed():
    queue = planner()
    queue.add((50.0, 0.0, 0.0), 20.0, 0.0)
    queue.add((50.0, 50.0, 0.0), 20.0, 0.0)
    _, leaves = drive(queue)
    half = math.sqrt(0.5)
    along_corner = A / half
    assert leaves[0] == pytest.approx(math.sqrt(along_corner * DEVIATION * half / (1 - half)))


def test_the_look_ahead_limits_short_moves():
    """Grbl's ceiling: v = sqrt(2 a (N - 1) L) for N moves of length L known."""
    queue, length, now, fastest = planner(), 0.1, 0.0, 0.0
    for i in range(400):
        while queue.full:
            now = queue.end
            queue.finish(now)
        queue.add(((i + 1) * length, 0.0, 0.0), 25.0, now)
        if queue.full:
            queue.start(now)
        fastest = max(fastest, queue.motion(now)[1])
    assert fastest == pytest.approx(math.sqrt(2 * A * 14 * length), rel=0.05)


moves = st.lists(
    st.tuples(*[st.floats(-5, 5).map(lambda v: round(v, 2))] * 3, st.floats(1, 40)),
    min_size=1,
    max_size=24,
)


@settings(max_examples=25, deadline=None)
@given(moves)
def test_no_speed_jumps_and_none_is_above_what_is_allowed(points):
    """Watched in steps of 3 ms: acceleration along the path within the limit of its move."""
    queue, now = planner(), 0.0
    todo = list(points)
    speeds = []
    while todo or queue.blocks:
        while todo and not queue.full:
            x, y, z, feed = todo.pop(0)
            queue.add((x, y, z), feed, now)
        queue.start(now)
        if not queue.blocks:
            break
        limit, before = queue.blocks[0], queue.motion(now)[1]
        target = min(queue.end, now + 0.003)
        speeds.append((before, queue.motion(target)[1], target - now, limit.acceleration))
        assert queue.motion(now)[1] <= limit.nominal + 1e-6
        now = target
        if queue.end <= now:
            queue.finish(now)
    for before, after, dt, acceleration in speeds:
        assert abs(after - before) <= acceleration * dt + 1e-6
    x, y, z, _ = points[-1]
    assert queue.position == pytest.approx((x, y, z), abs=1 / 800)


def test_a_hold_brakes_within_the_acceleration_and_resume_ends_at_the_target():
    queue = planner()
    queue.add((20.0, 0.0, 0.0), 20.0, 0.0)
    queue.add((40.0, 0.0, 0.0), 20.0, 0.0)
    queue.start(0.0)
    queue.hold(1.0)
    before = queue.motion(1.0)[0][0]
    assert queue.end == pytest.approx(1.0 + 20.0 / A)
    stopped = queue.end
    while queue.running:
        stopped = queue.end
        queue.finish(queue.end)
    assert queue.motion(stopped) == (pytest.approx((before + 400 / (2 * A), 0, 0)), 0.0)
    queue.resume(stopped + 5)
    while queue.running:
        queue.finish(queue.end)
    assert queue.position == (40.0, 0.0, 0.0)


def test_a_hold_may_brake_across_the_end_of_a_move():
    queue = planner()
    for x in range(1, 14):
        queue.add((float(x), 0.0, 0.0), 20.0, 0.0)
    queue.start(0.0)
    while queue.motion(queue.end)[1] < 15:
        queue.finish(queue.end)
    now = queue.end - 1e-3
    place, speed = queue.motion(now)
    queue.hold(now)
    while queue.running:
        end = queue.end
        queue.finish(end)
    assert queue.motion(end)[0][0] - place[0] == pytest.approx(speed**2 / (2 * A), rel=1e-6)
    assert end - now == pytest.approx(speed / A, rel=1e-6)


def test_an_override_slows_the_move_that_runs():
    queue = planner()
    queue.add((100.0, 0.0, 0.0), 20.0, 0.0)
    queue.start(0.0)
    queue.override(0.5, 1.0, 2.0)
    assert queue.motion(3.0)[1] == pytest.approx(10.0)
    assert drive(queue)[0] > 8.0


def test_positions_are_whole_steps_and_less_than_one_is_no_move():
    queue = planner(_100=10.0)
    assert not queue.add((0.04, 0.0, 0.0), 10.0, 0.0)
    assert queue.add((0.06, 0.0, 0.0), 10.0, 0.0)
    drive(queue)
    assert queue.position == (0.1, 0.0, 0.0)
