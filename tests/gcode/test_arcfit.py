"""Arcs are found where there are any, and lie where the chords lay."""

from itertools import pairwise

import numpy as np
import pytest

from relieffab.gcode import arcfit


def fit(points, feed=None, tolerance=2.0):
    points = np.array(points, float)
    feed = np.full(len(points), 600.0) if feed is None else np.array(feed, float)
    turn, centre = np.zeros(len(points), np.int64), np.zeros((len(points), 2))
    arcfit.fit(points, feed, tolerance, turn, centre)
    return turn, centre


def circle(radius, sweep, count, z=-500.0, at=(300.0, -200.0)):
    t = np.linspace(0, sweep, count + 1)
    points = np.column_stack([at[0] + radius * np.cos(t), at[1] + radius * np.sin(t), 0 * t + z])
    return np.rint(points)


@pytest.mark.parametrize("sweep", [0.5, 2.0, -2.0, 5.0, -5.0])
@pytest.mark.parametrize("radius", [800.0, 5000.0, 90000.0])
def test_one_arc_for_a_whole_run(radius, sweep):
    count = int(np.ceil(abs(sweep) / (2 * np.arccos(1 - 0.4 / radius)))) + 4
    turn, centre = fit(circle(radius, sweep, count))
    assert (turn[1:-1] == 2).all()
    assert turn[-1] == np.sign(sweep)
    assert np.hypot(*(centre[-1] - [300, -200])) < max(5, 3e-3 * radius / abs(sweep) ** 2)


def test_a_whole_turn_takes_two():
    turn, _ = fit(circle(4000.0, 2 * np.pi, 200))
    assert sorted(turn[turn != 2].tolist()) == [0, 1, 1]


@pytest.mark.parametrize(
    "points",
    [
        [[0, 0, 0], [100, 0, 0], [200, 0, 0], [300, 0, 0], [400, 0, 0], [500, 0, 0]],
        circle(5000.0, 0.3, 3),
        circle(5000.0, 2.0, 20) + np.arange(21)[:, None] * [0, 0, -1],
        circle(5000.0, 2.0, 5),
    ],
    ids=["straight", "few", "sloping", "coarse"],
)
def test_what_is_no_arc(points):
    assert not fit(points)[0].any()


def test_feeds_and_rapids_part_arcs():
    points = circle(5000.0, 2.0, 60)
    feed = np.full(61, 600.0)
    feed[31:] = 300.0
    turn, _ = fit(points, feed)
    assert (turn == 1).sum() == 2 and turn[30] == 1
    assert not fit(points, np.full(61, np.inf))[0].any()


def test_no_vertex_and_no_chord_is_further_than_the_tolerance():
    rng = np.random.default_rng(2)
    angle = np.cumsum(rng.uniform(-0.06, 0.1, 3000))
    step = rng.uniform(20, 80, 3000)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.rint(np.column_stack([np.cumsum(step, axis=0), np.full(3000, -100.0)]))
    turn, centre = fit(points, tolerance=2.0)
    ends = np.flatnonzero(turn != 2)
    arcs = 0
    for a, b in pairwise(ends):
        if turn[b] == 0:
            assert b == a + 1
            continue
        arcs += 1
        middle = 0.5 * (points[a:b, :2] + points[a + 1 : b + 1, :2])
        start, end = (np.hypot(*(points[k, :2] - centre[b])) for k in (a, b))
        for place in (*points[a : b + 1, :2], *middle):
            away = np.hypot(*(place - centre[b]))
            assert min(start, end) - 2.0 <= away <= max(start, end) + 2.0
    assert arcs > 20
