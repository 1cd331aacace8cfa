import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.grbl.simulator.profile import Profile


def test_a_trapezoid_by_hand():
    profile = Profile(100.0, 0.0, 0.0, 10.0, 10.0)
    assert profile.seconds == pytest.approx(1 + 9 + 1)
    assert profile.at(0.5) == pytest.approx((1.25, 5.0))
    assert profile.at(5.0) == pytest.approx((45.0, 10.0))
    assert profile.at(10.5) == pytest.approx((98.75, 5.0))
    assert profile.at(99.0) == (100.0, 0.0)


def test_a_triangle_by_hand():
    profile = Profile(10.0, 0.0, 0.0, 100.0, 10.0)
    assert profile.seconds == pytest.approx(2.0)
    assert profile.at(1.0) == pytest.approx((5.0, 10.0))


def test_an_end_that_cannot_be_reached_is_moved():
    assert Profile(1.0, 0.0, 50.0, 100.0, 2.0).leave == pytest.approx(2.0)
    assert Profile(1.0, 10.0, 0.0, 100.0, 2.0).leave == pytest.approx(math.sqrt(96))


speeds = st.floats(0, 100)


@given(st.floats(0.001, 100), speeds, speeds, st.floats(1, 100), st.floats(1, 1000))
def test_speed_adds_up_to_the_distance(distance, entry, leave, nominal, acceleration):
    profile = Profile(distance, entry, leave, nominal, acceleration)
    steps = 400
    dt = profile.seconds / steps
    covered = sum(profile.at((i + 0.5) * dt)[1] * dt for i in range(steps))
    assert covered == pytest.approx(distance, rel=1e-6, abs=3 * acceleration * dt**2)
    fastest = max(profile.at(i * dt)[1] for i in range(steps + 1))
    assert fastest <= max(nominal, entry, profile.leave) * (1 + 1e-9)
    places = [profile.at(i * dt)[0] for i in range(steps + 1)]
    assert all(a <= b + 1e-9 for a, b in pairwise(places))
